#pragma once

#include "answers/input/errors.hpp"
#include "platform/output_file.hpp"

/// The program: it reads words of a command line and writes answers.
namespace contensou::program {

using namespace answers;
using namespace platform;

/// The exit status of the program.
enum class ExitStatus {
  done = 0,
  check_failed = 1,
  bad_input = 2,
  numerical_failure = 3,
  file_failure = 4,
};

}  // namespace contensou::program
