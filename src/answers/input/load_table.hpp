#pragma once

#include <string>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/experiment.hpp"
#include "contensou/si/load_history.hpp"

namespace contensou::answers {

/// Reads a changing load from a CSV file with columns t (s) and load (N). Headings may name other units.
/// @throws BadLine      if the table does not describe a load
/// @throws FileFailure  if the file cannot be read
si::LoadHistory read_load_history(const std::string& path);

/// Throws if a changing load changes more than the time scale of a motion. This is so if the load changes the patch, or
/// if a force is not proportional to the load.
/// @param others  names of given options that need a constant load, between commas; empty if there are none
/// @return  a remark on the patch, for people; empty for a body that lies flat
/// @throws BadInput  with the reason, and the option that the user must leave out
std::string require_load_alone(const si::Experiment& experiment, const reduction::Law& law, std::string others = "");

}  // namespace contensou::answers
