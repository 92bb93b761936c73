#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contensou::portraits {

/// The way in which a program ended, and its output.
struct ProgramRun {
  enum class End { exited, not_run, out_of_time, ended_by_signal };

  End end;
  int number;  ///< exit status, or signal number
  std::string output, messages;

  bool succeeded() const { return end == End::exited && number == 0; }
};

/// Name of a file that is the standard input of a program.
extern const char* const standard_input;

/// Runs a program found on PATH, in the locale C.UTF-8. The program ends if its caller ends. No shell or disk is used.
/// @param command  name and arguments
/// @param input    standard input of the program
/// @param seconds  time limit
/// @throws std::system_error  if memory cannot hold the program's input or output
ProgramRun run_program(std::vector<const char*> command, std::string_view input, unsigned seconds);

}  // namespace contensou::portraits
