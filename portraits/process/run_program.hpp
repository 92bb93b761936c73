#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contensou::portraits {

/// How a program ended that was run.
struct ProgramRun {
  enum class End { exited, not_run, out_of_time, ended_by_signal };

  End end;
  int number;  ///< its status, or that of the signal
  std::string output, messages;

  bool succeeded() const { return end == End::exited && number == 0; }
};

/// Runs a program, found on PATH, in no language. It ends with this one. No shell and no file on a disk is used.
/// @param command  its name and arguments
/// @param input    that it reads
/// @param seconds  that it may take
/// @throws std::system_error  if there is no room in memory for what it reads and writes
ProgramRun run_program(std::vector<const char*> command, std::string_view input, unsigned seconds);

}  // namespace contensou::portraits
