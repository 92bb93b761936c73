#pragma once

#include <stdexcept>

namespace contensou::platform {

/// Thrown if a file cannot be read or written, or gnuplot is missing or fails. The message contains name and reason.
struct FileFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace contensou::platform
