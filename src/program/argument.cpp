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

double Argument::number() const {
  try {
    return parse_number(text());
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("{}: {}", name(), error.what()));
  }
}

std::vector<double> Argument::numbers(Infinity infinity) const {
  try {
    return parse_numbers(text(), infinity);
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("{}: {}", name(), error.what()));
  }
}

long Argument::integer(long lowest, long highest) const {
  try {
    return parse_integer(text(), lowest, highest);
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("{}: {}", name(), error.what()));
  }
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
