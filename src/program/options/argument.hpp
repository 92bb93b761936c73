#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "input/number.hpp"

namespace contensou::program {

/// One option with a value. The value stays the text as typed until a reader below asks for more, so that messages can
/// quote it.
class Argument {
 public:
  /// @param names       as CLI11 takes them, such as "-o,--output"; without dashes, a positional argument
  /// @param value_name  what the help calls the value
  void add(CLI::App& app, const std::string& names, const std::string& value_name, const std::string& help);

  /// An option that may stand without its value, whose text is then empty.
  void add_optional(CLI::App& app, const std::string& names, const std::string& value_name, const std::string& help);

  /// False for an argument that a verb does not have.
  bool given() const { return option_ != nullptr && option_->count() > 0; }
  std::string name() const { return option_->get_name(); }

  /// @throws BadInput  if the option was given more than once
  const std::string& text() const;

  /// @throws BadInput  naming the option and quoting its value, for these three
  double number() const;
  std::vector<double> numbers(Infinity infinity = Infinity::forbidden) const;
  long integer(long lowest, long highest) const;

  /// The numbers of each time that an option was given, which may be often.
  std::vector<std::vector<double>> number_lists() const;

  /// Throws BadInput with the option and its value before the message.
  [[noreturn]] void reject(const std::string& message) const;

 private:
  /// Puts the option's name before what a parser complains about.
  template <class Parse>
  auto read(Parse parse) const;

  CLI::Option* option_ = nullptr;
};

/// The names that were given, joined for a message; empty if none was.
std::string names_given(const std::vector<const Argument*>& arguments);

}  // namespace contensou::program
