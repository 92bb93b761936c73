#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "exit_status.hpp"

namespace contensou::program {

/// One verb of the program. A new verb is a file with a Command and a line in commands.cpp.
class Command {
 public:
  virtual ~Command() = default;

  virtual std::string name() const = 0;

  /// One line of help.
  virtual std::string summary() const = 0;

  /// A command line that works, for the help.
  virtual std::string example() const = 0;

  virtual void add_options(CLI::App& app) = 0;

  /// Does what the options say. Writes results only when all of them are there.
  /// @throws  what main.cpp turns into an exit status
  virtual ExitStatus run() = 0;
};

}  // namespace contensou::program
