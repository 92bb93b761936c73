#pragma once

#include <memory>
#include <vector>

#include "command.hpp"

namespace contensou::program {

std::unique_ptr<Command> make_stop_command();
std::unique_ptr<Command> make_orbit_command();
std::unique_ptr<Command> make_roll_command();
std::unique_ptr<Command> make_law_command();
std::unique_ptr<Command> make_check_command();
std::unique_ptr<Command> make_portrait_command();
std::unique_ptr<Command> make_sweep_command();
std::unique_ptr<Command> make_terminal_command();
std::unique_ptr<Command> make_paper_command();
std::unique_ptr<Command> make_balls_command();
std::unique_ptr<Command> make_explore_command();

/// Every verb, in the order of the help.
std::vector<std::unique_ptr<Command>> make_commands();

}  // namespace contensou::program
