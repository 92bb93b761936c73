#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "exit_status.hpp"
#include "input/number.hpp"

namespace contensou::program {

/// A value that can be read and is not allowed. An Argument quotes its value before such a message, and not before
/// another BadInput, which quotes what cannot be read itself.
struct NotAllowed : BadInput {
  using BadInput::BadInput;
};

/// An option whose value stays the text as typed.
class Argument {
 public:
  virtual ~Argument() = default;

  /// @param names       as CLI11 takes them, such as "-o,--output"; without dashes, a positional argument
  /// @param value_name  what the help calls the value
  CLI::Option* add(CLI::App& app, const std::string& names, const std::string& value_name, const std::string& help);

  /// False for an argument that a verb does not have.
  bool given() const { return option_ != nullptr && option_->count() > 0; }

  /// As messages call it: the first of its names.
  const std::string& name() const { return name_; }

  const std::string& text() const { return option_->results().front(); }

  /// Its name and its value, as messages quote them.
  std::string typed() const { return typed(text()); }

  /// Throws BadInput with the option and its value before the message.
  [[noreturn]] void reject(const std::string& message) const;

 protected:
  /// What a second value of the same option means: nothing, unless it may be given often.
  virtual bool repeatable() const { return false; }

  /// Reads one value as it is parsed.
  virtual void read(const std::string& /*typed*/) {}

 private:
  void accept(const CLI::App& app, const std::vector<std::string>& values);
  std::string typed(const std::string& value) const;

  CLI::Option* option_ = nullptr;
  std::string name_;
};

/// An option whose value is read, and its mistakes are found, when the command line is parsed.
template <class Value>
class ArgumentOf final : public Argument {
 public:
  /// @throws NotAllowed, BadInput  for a bad value; the argument puts its name before the message
  using Read = std::function<Value(const std::string& typed)>;

  CLI::Option* add(CLI::App& app, const std::string& names, const std::string& value_name, const std::string& help,
                   Read read) {
    read_ = std::move(read);
    return Argument::add(app, names, value_name, help);
  }

  /// For an option that may be given often.
  void make_repeatable() { repeatable_ = true; }

  const Value& operator*() const { return values_.front(); }
  Value value_or(Value standard) const { return given() ? values_.front() : std::move(standard); }

  /// Of each time that it was given.
  const std::vector<Value>& all() const { return values_; }

 private:
  bool repeatable() const override { return repeatable_; }
  void read(const std::string& typed) override { values_.push_back(read_(typed)); }

  Read read_;
  bool repeatable_ = false;
  std::vector<Value> values_;
};

/// The names that were given, joined for a message; empty if none was.
std::string names_given(const std::vector<const Argument*>& arguments);

/// Readers of a number, of numbers between commas, of a whole number.
inline double number(const std::string& typed) { return parse_number(typed); }
inline std::vector<double> numbers(const std::string& typed) { return parse_numbers(typed); }
inline auto whole_number(long lowest, long highest) {
  return [=](const std::string& typed) { return parse_integer(typed, lowest, highest); };
}

/// One of some names, and what it stands for.
template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// What is wrong with a name that is none of those there are.
/// @param kind  what the names are of, such as "law"; none: "one of them is needed"
NotAllowed no_such(const std::string& kind, const std::string& typed, const std::vector<std::string>& names);

/// Reads the value that a name stands for.
template <class Value>
std::function<Value(const std::string&)> one_of(Choices<Value> choices, std::string kind = "") {
  return [choices = std::move(choices), kind = std::move(kind)](const std::string& typed) {
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) {
      if (name == typed) return value;
      if (!name.empty()) names.push_back(name);
    }
    throw no_such(kind, typed, names);
  };
}

}  // namespace contensou::program
