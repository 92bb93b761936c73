#pragma once

#include "answers/input/errors.hpp"
#include "platform/file_failure.hpp"

/// Makes of words what answers hold, and writes them.
namespace contensou::program {

using namespace answers;
using namespace platform;

/// What the program tells its caller.
enum class ExitStatus {
  done = 0,
  check_failed = 1,
  bad_input = 2,
  numerical_failure = 3,
  file_failure = 4,
};

}  // namespace contensou::program
