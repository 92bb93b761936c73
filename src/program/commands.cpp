#include "commands.hpp"

namespace contensou::program {

std::vector<std::unique_ptr<Command>> make_commands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(make_stop_command());
  commands.push_back(make_sweep_command());
  commands.push_back(make_orbit_command());
  commands.push_back(make_roll_command());
  commands.push_back(make_law_command());
  commands.push_back(make_check_command());
  commands.push_back(make_portrait_command());
  commands.push_back(make_explore_command());
  commands.push_back(make_terminal_command());
  commands.push_back(make_paper_command());
  commands.push_back(make_balls_command());
  return commands;
}

}  // namespace contensou::program
