#include "argument.hpp"

#include <fmt/format.h>

#include "exit_status.hpp"

namespace contensou::program {

void Argument::add(CLI::App& app, const std::string& names, const std::string& value_name, const std::string& help) {
  option_ = app.add_option(names)->description(help)->type_name(value_name);
  option_->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

const std::string& Argument::text() const {
  if (option_->count() > 1)
    throw BadInput(fmt::format("{} is given {} times; once is allowed", name(), option_->count()));
  return option_->results().front();
}

template <class Parse>
auto Argument::read(Parse parse) const {
  const std::string& typed = text();
  try {
    return parse(typed);
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("{}: {}", name(), error.what()));
  }
}

double Argument::number() const {
  return read([](const std::string& typed) { return parse_number(typed); });
}

std::vector<double> Argument::numbers(Infinity infinity) const {
  return read([infinity](const std::string& typed) { return parse_numbers(typed, infinity); });
}

long Argument::integer(long lowest, long highest) const {
  return read([=](const std::string& typed) { return parse_integer(typed, lowest, highest); });
}

void Argument::reject(const std::string& message) const {
  throw BadInput(fmt::format("{} {}: {}", name(), text(), message));
}

std::string names_given(const std::vector<const Argument*>& arguments) {
  std::string names;
  for (const Argument* argument : arguments) {
    if (!argument->given()) continue;
    if (!names.empty()) names += ", ";
    names += argument->name();
  }
  return names;
}

}  // namespace contensou::program
