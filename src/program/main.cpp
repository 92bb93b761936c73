#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "contensou/si/nearest_name.hpp"
#include "contensou/si/run_file.hpp"
#include "output/output.hpp"

namespace contensou::program {

namespace {

using Commands = std::vector<std::unique_ptr<Command>>;

std::string help(const Commands& commands) {
  std::string text =
      "A ball that slides and spins on a plane under combined dry friction.\n\n"
      "Usage: contensou VERB [options]\n\n";
  for (const auto& command : commands) text += fmt::format("  {:<10}{}\n", command->name(), command->summary());
  text += "\nExamples:\n";
  for (const auto& command : commands) text += fmt::format("  {}\n", command->example());
  text +=
      "\n'contensou VERB --help' lists the options of a verb, 'contensou --version' names the version.\n"
      "Exit status: 0 done, 1 a check failed, 2 bad input, 3 numerical failure, 4 a file or gnuplot failed.\n";
  return text;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// An option whose value was forgotten takes the next option for it.
void reject_forgotten_values(const CLI::App& app) {
  const std::vector<std::string> names = option_names(app);
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& value : option->results()) {
      if (std::ranges::find(names, value) == names.end()) continue;
      throw BadInput(fmt::format("{} needs a value before '{}'", option->get_name(), value));
    }
  }
}

/// What CLI11 could not place: an option that does not exist or a word too many.
void reject_extras(const CLI::App& app) {
  if (app.remaining_size() == 0) return;
  const std::string typed = app.remaining().front();
  const std::string option = typed.substr(0, typed.find('='));
  if (!option.starts_with('-')) throw BadInput(fmt::format("unexpected argument '{}'", typed));
  throw BadInput(fmt::format("unknown option '{}'{}", option, si::suggestion(option, option_names(app))));
}

ExitStatus run(Command& command, std::vector<std::string> arguments) {
  CLI::App app(command.summary(), "contensou " + command.name());
  app.footer("Example:\n  " + command.example());
  app.allow_extras();
  command.add_options(app);
  try {
    std::ranges::reverse(arguments);  // as CLI11 wants them
    app.parse(std::move(arguments));
  } catch (const CLI::CallForHelp&) {
    write_output("-", app.help());
    return ExitStatus::done;
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string message = error.what();
    throw BadInput(fmt::format("{} needs a value", message.substr(0, message.find(':'))));
  } catch (const CLI::ParseError& error) {
    throw BadInput(error.what());
  }
  reject_forgotten_values(app);
  reject_extras(app);
  return command.run();
}

/// @param help  the command line that helps with what was typed so far
ExitStatus dispatch(const std::vector<std::string>& arguments, std::string& help_line) {
  const Commands commands = make_commands();
  std::vector<std::string> names;
  for (const auto& command : commands) names.push_back(command->name());

  if (arguments.empty()) throw BadInput(fmt::format("a verb is missing; verbs: {}", fmt::join(names, ", ")));
  const std::string& verb = arguments.front();
  if (verb == "--help" || verb == "-h" || verb == "help") {
    write_output("-", help(commands));
    return ExitStatus::done;
  }
  if (verb == "--version") {
    write_output("-", "contensou " CONTENSOU_VERSION "\n");
    return ExitStatus::done;
  }
  const auto command = std::ranges::find(commands, verb, &Command::name);
  if (command == commands.end()) {
    throw BadInput(fmt::format("unknown {} '{}'{}; verbs: {}", verb.starts_with('-') ? "option" : "verb", verb,
                               si::suggestion(verb, names), fmt::join(names, ", ")));
  }
  help_line = fmt::format("contensou {} --help", verb);
  return run(**command, {arguments.begin() + 1, arguments.end()});
}

ExitStatus complain(ExitStatus status, const std::string& message) {
  std::fputs((message + "\n").c_str(), stderr);
  return status;
}

ExitStatus guarded(const std::vector<std::string>& arguments) {
  std::string help_line = "contensou --help";
  try {
    return dispatch(arguments, help_line);
  } catch (const BadLine& error) {
    return complain(ExitStatus::bad_input, error.what());
  } catch (const si::RunFileError& error) {
    return complain(ExitStatus::bad_input, error.what());
  } catch (const std::domain_error& error) {
    return complain(ExitStatus::bad_input, fmt::format("contensou: {}\nTry '{}'.", error.what(), help_line));
  } catch (const FileFailure& error) {
    return complain(ExitStatus::file_failure, fmt::format("contensou: {}", error.what()));
  } catch (const std::system_error& error) {
    return complain(ExitStatus::file_failure, fmt::format("contensou: {}", error.what()));
  } catch (const std::exception& error) {
    return complain(ExitStatus::numerical_failure, fmt::format("contensou: {}", error.what()));
  }
}

}  // namespace

}  // namespace contensou::program

int main(int argc, char** argv) {
  return static_cast<int>(contensou::program::guarded({argv + std::min(argc, 1), argv + argc}));
}
