#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "answers/input/errors.hpp"
#include "answers/input/parse.hpp"
#include "contensou/si/run_file.hpp"
#include "output/help.hpp"
#include "platform/descriptor.hpp"
#include "platform/interruption.hpp"
#include "platform/output_file.hpp"
#include "text/nearest_name.hpp"
#include "verb.hpp"

namespace contensou::program {

std::vector<VerbEntry>& verbs() {
  static std::vector<VerbEntry> entries;
  return entries;
}

namespace {

std::string heading(Purpose purpose) {
  switch (purpose) {
    case Purpose::compute:
      return "Verbs that compute";
    case Purpose::draw:
      return "Verbs that draw";
    case Purpose::check:
      return "Verbs that reduce and check";
    case Purpose::bodies:
      return "Verbs for real bodies";
    case Purpose::help:
      break;
  }
  return "Verbs that help";
}

std::string footer() {
  std::string text = "Examples:\n";
  for (const VerbEntry& entry : verbs()) text += fmt::format("  {}\n", entry.example);
  return text + "\n" +
         help_paragraph(
             "'contensou help VERB' lists the options of a verb. 'contensou help "
             "ball|laws|formulas|picture|output|views|units|files|fields|theory' explains a topic.") +
         help_paragraph(exit_statuses);
}

/// The verbs of the program's command line. The options of a verb are added when they are needed.
class Verbs {
 public:
  explicit Verbs(CLI::App& root) {
    std::ranges::sort(verbs(), {}, [](const VerbEntry& entry) { return std::tie(entry.purpose, entry.name); });
    for (const VerbEntry& entry : verbs()) {
      CLI::App* app = root.add_subcommand(entry.name, entry.summary)->allow_extras()->group(heading(entry.purpose));
      parts_.push_back({&entry, app, nullptr});
      names_.push_back(entry.name);
    }
    std::ranges::sort(names_);
  }

  const std::vector<std::string>& names() const { return names_; }
  bool has(const std::string& name) const { return std::ranges::find(names_, name) != names_.end(); }

  /// Returns the verb with a name, after its options have been added.
  Verb& complete(const std::string& name) {
    Part& part = *std::ranges::find(parts_, name, [](const Part& of) { return of.entry->name; });
    if (!part.verb) {
      part.app->footer("Example:\n  " + part.entry->example);
      part.verb = part.entry->make();
      part.verb->add_options(*part.app);
      part.app->set_help_flag();  // removed and added again, so that it is the last option
      part.app->set_help_flag("-h,--help", "print this help");
    }
    return *part.verb;
  }
  void complete_all() {
    for (const std::string& name : names_) complete(name);
  }

 private:
  struct Part {
    const VerbEntry* entry;
    CLI::App* app;
    std::unique_ptr<Verb> verb;
  };
  std::vector<Part> parts_;
  std::vector<std::string> names_;
};

/// Throws for words that CLI11 could not assign: an unknown verb or option, or a superfluous word.
/// @param names  names of all verbs if a verb was expected, else empty
/// @throws BadInput  if there is such a word
void reject_extras(const CLI::App& app, Verbs& all, const std::vector<std::string>& names) {
  if (app.remaining_size() == 0) return;
  const std::string typed = app.remaining().front();
  const std::string option = typed.substr(0, typed.find('='));
  if (option.starts_with('-') && option != "--") {
    std::vector<std::string> options;
    for (const CLI::Option* known : app.get_options()) {
      for (const std::string& name : known->get_lnames()) options.push_back("--" + name);
    }
    std::vector<std::string> others;
    if (const CLI::App* root = app.get_parent()) {
      all.complete_all();
      for (const CLI::App* verb : root->get_subcommands([](const CLI::App*) { return true; })) {
        if (verb->get_option_no_throw(option) != nullptr) others.push_back(verb->get_name());
      }
    }
    const std::string hint =
        others.empty() ? suggestion(option, options) : fmt::format(": it is an option of {}", fmt::join(others, ", "));
    throw BadInput("unknown option {}{}", quotation(option), hint);
  }
  if (names.empty()) throw BadInput("unexpected argument {}", quotation(typed));
  throw BadInput("unknown verb {}{}; verbs: {}", quotation(typed), suggestion(typed, names), fmt::join(names, ", "));
}

/// Throws for two uses that CLI11 accepts although they have no meaning: a value of a flag, and -- as the last word.
void reject_what_means_nothing(const CLI::App& app, const std::vector<std::string>& arguments) {
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_items_expected_max() > 0) continue;
    for (const std::string& typed : arguments) {
      if (!typed.starts_with(option->get_name() + "=")) continue;
      throw BadInput("{}: {} takes no value", quotation(typed), option->get_name());
    }
  }
  if (!arguments.empty() && arguments.back() == "--") throw BadInput("unexpected argument '--'");
}

void parse(CLI::App& app, std::vector<std::string> arguments) {
  std::ranges::reverse(arguments);  // CLI11 expects the words in reverse order
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string message = error.what();
    throw BadInput("{} needs a value", message.substr(0, message.find(':')));
  }
}

/// @param verb  receives the name of the verb as soon as it is known
ExitStatus run(const std::vector<std::string>& arguments, std::string& verb) {
  CLI::App app("Motion of a ball or puck that slides and spins on a plane with dry friction.\n", "contensou");
  app.formatter(std::make_shared<HelpFormatter>());
  Verbs all(app);
  app.set_version_flag("--version", "contensou " CONTENSOU_VERSION, "print the version");
  app.footer(footer);
  app.require_subcommand(0, 1)->allow_extras();
  const bool known = !arguments.empty() && all.has(arguments.front());
  if (known) verb = arguments.front();
  if (known && verb != "help") {
    all.complete(verb);
  } else if (std::ranges::any_of(arguments, [&](const std::string& word) { return all.has(word); })) {
    all.complete_all();  // help, or a verb behind another word
  }
  try {
    reject_what_means_nothing(known ? *app.get_subcommand(verb) : app, arguments);
    parse(app, arguments);
  } catch (const CLI::CallForHelp&) {
    reject_extras(app, all, all.names());
    write_output("-", app.help());
    return ExitStatus::done;
  } catch (const CLI::CallForVersion& version) {
    reject_extras(app, all, all.names());
    write_output("-", version.what() + std::string("\n"));
    return ExitStatus::done;
  } catch (const CLI::ParseError& error) {
    throw BadInput(error.what());
  }
  reject_extras(app, all, all.names());
  if (app.get_subcommands().empty()) throw BadInput("a verb is missing; verbs: {}", fmt::join(all.names(), ", "));
  reject_extras(*app.get_subcommands().front(), all, {});
  return all.complete(verb).run();
}

ExitStatus complain(ExitStatus status, const std::string& message) {
  std::fputs((message + "\n").c_str(), stderr);
  return status;
}

std::string as_typed(const std::vector<std::string>& arguments) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-_=.,:/@%";
  std::string line = "contensou";
  for (const std::string& argument : arguments) {
    const bool is_plain = !argument.empty() && argument.find_first_not_of(plain) == std::string::npos;
    line += is_plain ? ' ' + argument : " '" + argument + '\'';
  }
  return line;
}

ExitStatus guarded(const std::vector<std::string>& arguments) {
  std::string verb;
  try {
    return run(arguments, verb);
  } catch (const BadLine& error) {
    return complain(ExitStatus::bad_input, error.what());
  } catch (const si::RunFileError& error) {
    return complain(ExitStatus::bad_input, error.what());
  } catch (const std::domain_error& error) {
    return complain(ExitStatus::bad_input, fmt::format("contensou: {}\nTry 'contensou {}{}--help'.",
                                                       words_of(error.what()), verb, verb.empty() ? "" : " "));
  } catch (const FileFailure& error) {
    return complain(ExitStatus::file_failure, fmt::format("contensou: {}", error.what()));
  } catch (const std::system_error& error) {
    return complain(ExitStatus::file_failure, fmt::format("contensou: {}", error.what()));
  } catch (const std::bad_alloc&) {
    return complain(
        ExitStatus::file_failure,
        "contensou: out of memory: ask for less at once, or allow more (ulimit -v, or the container's limit)");
  } catch (const std::exception& error) {
    return complain(ExitStatus::numerical_failure,
                    fmt::format("contensou: {}", message_of(error, as_typed(arguments))));
  }
}

}  // namespace

}  // namespace contensou::program

int main(int argc, char** argv) {
  contensou::platform::prepare_standard_streams();
  contensou::platform::handle_ending_signals();
  return static_cast<int>(contensou::program::guarded({argv + std::min(argc, 1), argv + argc}));
}
