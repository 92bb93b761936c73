#pragma once

#include <stdexcept>

namespace contensou::platform {

/// A file that cannot be read or written, or a gnuplot that is missing or failed; the message names it and the reason.
struct FileFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace contensou::platform
