#include "options/argument.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "answers/input/formulas.hpp"
#include "contensou/si/quantity.hpp"

namespace contensou::program {

CLI::Option* Argument::add(CLI::App& app, const std::string& names, const std::string& value_name,
                           const std::string& help, Take take, bool repeatable) {
  const auto accepted = [this, &app, take = std::move(take), repeatable](const CLI::results_t& values) {
    accept(app, values, take, repeatable);
    return true;
  };
  keep(names, app.add_option(names, accepted, help));
  return option_->type_name(value_name)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

CLI::Option* Argument::keep(const std::string& names, CLI::Option* option) {
  name_ = names.substr(0, names.find(','));
  return option_ = option;
}

void Argument::require_rules(const CLI::App& app) const {
  if (app.get_help_ptr()->count() > 0) return;
  for (const auto& [others, reason] : exclusions_) {
    if (const std::string names = names_given(others); !names.empty())
      throw BadInput("{} and {} exclude each other: {}", name_, names, reason);
  }
  for (const auto& [other, reason, instead] : needs_) {
    if (!other->given() && !(instead != nullptr && instead->given()))
      throw BadInput("{} {}: add {} {}", name_, reason, other->name_, other->option_->get_type_name());
  }
}

void Argument::accept(const CLI::App& app, const std::vector<std::string>& values, const Take& take,
                      bool repeatable) const {
  for (const std::string& value : values) {
    // If the value of an option was forgotten, the next option stands in place of this value.
    if (value.starts_with('-') && app.get_option_no_throw(value) != nullptr) {
      throw BadInput("{} needs a value before '{}'", name_, value);
    }
  }
  if (values.size() > 1 && !repeatable) throw BadInput("{} is given {} times; once is allowed", name_, values.size());
  for (const std::string& value : values) {
    try {
      if (take) take(value);
    } catch (const BadLine&) {
      throw;  // the message already names the file
    } catch (const NotAllowed& error) {
      throw BadInput("{}: {}", typed(value), error.what());
    } catch (const BadInput& error) {
      throw BadInput("{}: {}", name_, error.what());
    }
  }
  require_rules(app);
}

void Argument::reject(const std::string& message) const { throw BadInput("{}: {}", typed(), message); }

std::string Argument::typed(const std::string& value) const {
  const std::string quoted = quotation(value);
  return fmt::format("{} {}", name_, quoted.substr(1, quoted.size() - 2));
}

std::string names_given(const Arguments& arguments) {
  std::vector<std::string> names;
  for (const Argument* argument : arguments) {
    if (argument->given()) names.push_back(argument->name());
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

Arguments united(std::initializer_list<Arguments> lists) {
  Arguments all;
  for (const Arguments& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

bool names_a_file(const std::string& typed, const std::vector<std::string>& endings) {
  return typed.find('/') != std::string::npos ||
         std::ranges::any_of(endings, [&](const std::string& ending) { return typed.ends_with(ending); });
}

std::string_view known_unit(std::string_view symbol) {
  if (si::find_dimension(symbol) == nullptr) throw std::logic_error(fmt::format("no unit '{}'", symbol));
  return symbol;
}

double number(const std::string& typed) { return parse_constant(typed); }

double parse_quantity(const std::string& typed, std::string_view symbol) {
  const si::Dimension* dimension = si::find_dimension(symbol);
  if (dimension == nullptr || is_number(typed)) return number(typed);
  const double value = si::parse_quantity(typed, *dimension).value_or(NAN);
  if (std::isfinite(value)) return value;
  const bool degrees = symbol == "deg";  // whoever types pi/4 means radians
  if (!degrees && is_constant(typed)) return number(typed);
  std::size_t size = typed.size();
  while (size > 0 && (typed[size - 1] == ' ' || !is_number(typed.substr(0, size)))) --size;
  if (size > 0 && decimal_hint(typed)[0] == '\0') {
    parse_number(typed.substr(0, size));  // throws for numbers that do not fit a double
    const std::string unit = typed.substr(std::min(typed.find_first_not_of(' ', size), typed.size()));
    throw BadInput("{} has the unit {}, which is none of {}", quotation(typed), quotation(unit),
                   si::units_of(*dimension));
  }
  throw BadInput("{} is not a number; write it like 0.1, -5 or 1e-3, in {}, or with {} behind it{}", quotation(typed),
                 symbol, si::units_of(*dimension), decimal_hint(typed));
}

std::vector<double> parse_quantities(std::vector<std::string> texts, std::string_view symbol) {
  const std::string& last = texts.back();
  std::size_t size = is_constant(last) ? 0 : last.size();
  while (size > 0 && !is_number(last.substr(0, size))) --size;
  const std::string unit = size > 0 ? last.substr(size) : "";
  std::vector<double> values;
  for (std::string& text : texts) {
    const bool is_plain = is_constant(text);
    values.push_back(parse_quantity(is_plain ? text + unit : text, symbol));
    if (unit.empty() && !is_plain) throw NotAllowed("give each number a unit, or one behind the last for all of them");
  }
  return values;
}

std::vector<double> numbers(const std::string& typed, std::size_t count, const std::string& names,
                            std::string_view symbol) {
  std::vector<double> values = parse_quantities(split(typed, ','), symbol);
  if (values.size() != count) throw NotAllowed("{} numbers are needed, {}", count, names);
  return values;
}

}  // namespace contensou::program
