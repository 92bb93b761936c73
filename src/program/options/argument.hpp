#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "answers/input/parse.hpp"
#include "exit_status.hpp"
#include "text/nearest_name.hpp"

namespace contensou::program {

/// A value that can be read but is not allowed. An Argument puts the value before such a message. A message of another
/// BadInput already quotes the text that cannot be read.
struct NotAllowed : BadInput {
  using BadInput::BadInput;
};

class Argument;
using Arguments = std::vector<const Argument*>;

/// An option whose value is kept as the text that was typed.
class Argument {
 public:
  /// Reads a value when the command line is parsed.
  /// @throws NotAllowed, BadInput  for a bad value; the argument puts its own name before the message
  using Take = std::function<void(const std::string& typed)>;

  /// @param names       as CLI11 takes them, such as "-o,--output"; without dashes, a positional argument
  /// @param value_name  name of the value in the help
  /// @param repeatable  true if the option may be given more than once
  CLI::Option* add(CLI::App& app, const std::string& names, const std::string& value_name, const std::string& help,
                   Take take = {}, bool repeatable = false);

  /// Forbids other arguments beside this one. The message is "THIS and OTHERS exclude each other: REASON".
  void excludes(const Arguments& others, const std::string& reason = "give one of them") {
    exclusions_.emplace_back(others, reason);
  }

  /// Requires another argument beside this one. The message is "THIS REASON: add OTHER".
  void needs(const Argument& other, const std::string& reason) { needs_.push_back({&other, reason, nullptr}); }
  /// The same, unless `instead` is given. `instead` may be this argument.
  void needs(const Argument& other, const std::string& reason, const Argument& instead) {
    needs_.push_back({&other, reason, &instead});
  }

  /// Returns true if the argument was given. Returns false also for a verb without this argument.
  bool given() const { return option_ != nullptr && option_->count() > 0; }

  /// Returns the first name of the argument; messages use this name.
  const std::string& name() const { return name_; }

  const std::string& text() const { return option_->results().front(); }

  /// Returns name and value in the form in which messages quote them.
  std::string typed() const { return typed(text()); }

  /// Throws BadInput with the option and its value before the message.
  [[noreturn]] void reject(const std::string& message) const;

 protected:
  CLI::Option* keep(const std::string& names, CLI::Option* option);
  void require_rules(const CLI::App& app) const;

 private:
  void accept(const CLI::App& app, const std::vector<std::string>& values, const Take& take, bool repeatable) const;
  std::string typed(const std::string& value) const;

  CLI::Option* option_ = nullptr;
  std::string name_;
  std::vector<std::pair<Arguments, std::string>> exclusions_;
  struct Need {
    const Argument* other;
    std::string reason;
    const Argument* instead;  ///< may be null
  };
  std::vector<Need> needs_;
};

/// An option without a value.
class Flag : public Argument {
 public:
  CLI::Option* add(CLI::App& app, const std::string& name, const std::string& help) {
    return keep(name, app.add_flag_callback(
                          name, [this, &app] { require_rules(app); }, help));
  }
  operator bool() const { return given(); }  // NOLINT(google-explicit-constructor): a flag is true or false
};

/// An option whose value is read when the command line is parsed, so that mistakes are found at once.
template <class Value>
class ArgumentOf : public Argument {
 public:
  using Read = std::function<Value(const std::string& typed)>;  ///< throws as Take

  CLI::Option* add(CLI::App& app, const std::string& names, const std::string& value_name, const std::string& help,
                   Read read, bool repeatable = false) {
    const Take take = [this, read = std::move(read)](const std::string& typed) { values_.push_back(read(typed)); };
    return Argument::add(app, names, value_name, help, take, repeatable);
  }

  const Value& operator*() const { return values_.front(); }
  const Value* operator->() const { return &values_.front(); }
  Value value_or(Value standard) const { return given() ? values_.front() : std::move(standard); }
  std::optional<Value> optional() const { return given() ? std::optional(values_.front()) : std::nullopt; }

  /// Returns the values of all occurrences of the option.
  const std::vector<Value>& all() const { return values_; }

 private:
  std::vector<Value> values_;
};

/// Returns the names of those arguments that were given, joined for a message; empty if there are none.
std::string names_given(const Arguments& arguments);
/// Returns the lists as one list.
Arguments united(std::initializer_list<Arguments> lists);

/// Returns true if a value is the path of a file: it contains a / or ends with one of these endings.
bool names_a_file(const std::string& typed, const std::vector<std::string>& endings);

/// Read a number, which may be a formula of numbers such as 2/3, and a whole number, for an ArgumentOf.
double number(const std::string& typed);
inline auto whole_number(long lowest, long highest) {
  return [=](const std::string& typed) { return parse_integer(typed, lowest, highest); };
}

/// Reads a number and returns it in a unit. Behind the typed number, any unit of the same kind may stand.
/// @param symbol  symbol of the unit (si::dimensions); empty for a pure number
double parse_quantity(const std::string& typed, std::string_view symbol);
/// @throws std::logic_error  unless the text is a symbol in si::dimensions
std::string_view known_unit(std::string_view symbol);
inline auto quantity(std::string_view symbol) {
  return [unit = known_unit(symbol)](const std::string& typed) { return parse_quantity(typed, unit); };
}

/// Returns a reader of numbers that refuses a number for which a condition is false.
/// @param read     reads the number, such as quantity("m")
/// @param holds    condition, such as is_positive
/// @param message  sentence that says which numbers are allowed
template <class Read, class Holds>
auto checked(Read read, Holds holds, const std::string& message) {
  return [=](const std::string& typed) {
    const double value = read(typed);
    if (!holds(value)) throw NotAllowed(message);
    return value;
  };
}
inline bool is_positive(double value) { return value > 0; }
inline bool is_not_negative(double value) { return value >= 0; }

/// Reads each text as parse_quantity. If only the last number has a unit, this unit applies to all numbers.
std::vector<double> parse_quantities(std::vector<std::string> texts, std::string_view symbol);

/// Reads `count` numbers that are separated by commas.
/// @param names   names of the numbers in messages, such as U,V
/// @param symbol  symbol of the unit, as in parse_quantity
std::vector<double> numbers(const std::string& typed, std::size_t count, const std::string& names,
                            std::string_view symbol = "");

/// Names, and for each name the value that it stands for.
template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// Reads the value that a name stands for. Messages do not list the empty name.
/// @param kind  noun for the named things, such as "law"; if empty, the message asks for one of the names
template <class Value>
std::function<Value(const std::string&)> one_of(Choices<Value> choices, std::string kind = "") {
  return [choices = std::move(choices), kind = std::move(kind)](const std::string& typed) {
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) {
      if (name == typed) return value;
      if (!name.empty()) names.push_back(name);
    }
    if (!kind.empty()) throw NotAllowed(no_such(kind, typed, names, false));
    throw NotAllowed("one of {} is needed{}", fmt::join(names, ", "), suggestion(typed, names));
  };
}

}  // namespace contensou::program
