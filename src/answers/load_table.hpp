#pragma once

#include <string>

#include "contensou/si/load_history.hpp"

namespace contensou::answers {

/// A load that changes, from a CSV with columns t (s) and load (N), or in other units by their headings.
/// @throws BadLine      for what is no such load
/// @throws FileFailure  if the file cannot be read
si::LoadHistory read_load_history(const std::string& path);

}  // namespace contensou::answers
