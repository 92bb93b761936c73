#pragma once

#include <stdexcept>

#include "answers/errors.hpp"

/// Makes of words what answers hold, and writes them.
namespace contensou::program {

using namespace answers;

/// What the program tells its caller.
enum class ExitStatus {
  done = 0,
  check_failed = 1,
  bad_input = 2,
  numerical_failure = 3,
  file_failure = 4,
};

/// A file that cannot be read or written, or a gnuplot that is missing or failed; the message names it and the reason.
struct FileFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace contensou::program
