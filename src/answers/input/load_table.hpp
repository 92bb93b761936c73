#pragma once

#include <string>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/experiment.hpp"
#include "contensou/si/load_history.hpp"

namespace contensou::answers {

/// A load that changes, from a CSV with columns t (s) and load (N), or in other units by their headings.
/// @throws BadLine      for what is no such load
/// @throws FileFailure  if the file cannot be read
si::LoadHistory read_load_history(const std::string& path);

/// Rejects a motion that is not that of a constant load at other times: with a patch that the load widens, and with
/// what is not in proportion to it.
/// @param others  options that are of a constant load, between commas; empty: none
/// @return  what is to be known of the patch, for people; empty for a body that lies flat
/// @throws BadInput  saying why, and what to leave out
std::string require_load_alone(const si::Experiment& experiment, const reduction::Law& law, std::string others = "");

}  // namespace contensou::answers
