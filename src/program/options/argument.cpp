#include "options/argument.hpp"

#include <fmt/format.h>

#include "exit_status.hpp"

namespace contensou::program {

void Argument::add(CLI::App& app, const std::string& names, const std::string& value_name, const std::string& help) {
  option_ = app.add_option(names)->description(help)->type_name(value_name);
  option_->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void Argument::add_optional(CLI::App& app, const std::string& names, const std::string& value_name,
                            const std::string& help) {
  add(app, names, value_name, help);
  option_->expected(0, 1);
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

std::vector<std::vector<double>> Argument::number_lists() const {
  std::vector<std::vector<double>> lists;
  if (!given()) return lists;
  for (const std::string& typed : option_->results()) {
    try {
      lists.push_back(parse_numbers(typed, Infinity::forbidden));
    } catch (const BadInput& error) {
      throw BadInput(fmt::format("{}: {}", name(), error.what()));
    }
  }
  return lists;
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
