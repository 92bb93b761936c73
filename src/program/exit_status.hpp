#pragma once

#include <stdexcept>

namespace contensou::program {

/// What the program tells its caller.
enum class ExitStatus {
  done = 0,
  check_failed = 1,
  bad_input = 2,
  numerical_failure = 3,
  file_failure = 4,
};

/// The user's mistake; the message says what is wrong, what is allowed and a way out.
struct BadInput : std::domain_error {
  using std::domain_error::domain_error;
};

/// The user's mistake in a file; the message begins with FILE:LINE.
struct BadLine : BadInput {
  using BadInput::BadInput;
};

/// A file that cannot be read or written, or a gnuplot that is missing or failed; the message names it and the reason.
struct FileFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace contensou::program
