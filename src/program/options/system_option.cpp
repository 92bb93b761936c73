#include "options/system_option.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace contensou::program {

void SystemOption::add(CLI::App& app) {
  app.option_defaults()->group("Another system");
  system_.add(
      app, "--system", "\"x' = F; y' = G\"",
      "equations in any letters, instead of (2.6); \"y' = F(x, y)\", \"x'' = F(x, x')\" and more: 'contensou help "
      "formulas'");
  basis_.add(app, "--basis", "\"1; u; v; exp(u)\"",
             "functions, for --system; sums of them are tried as inverse integrating factor V");
  start_.add(app, "--start", "\"x=1, x'=0\"", "start, as in x=pi/2; also --x0 1 --y0 0 or --u0 1 --v0 0",
             [](const std::string& typed) {
               std::vector<std::pair<std::string, double>> values;
               for (const std::string& part : split(typed, ',')) {
                 const std::size_t equals = part.find('=');
                 std::string letter = part.substr(0, equals);
                 std::erase(letter, ' ');
                 if (equals == std::string::npos || letter.empty())
                   throw NotAllowed("two values with their letters are needed, such as \"x=1, y=0\"");
                 values.emplace_back(letter, number(part.substr(equals + 1)));
               }
               return values;
             });
  app.option_defaults()->group("");  // the help of --start names them
  x0_.add(app, "--x0", "X", "value of the letter x at the start of --system", number);
  y0_.add(app, "--y0", "Y", "value of the letter y, or of x' in x'' = F, at the start of --system", number);
  for (Argument* each : {static_cast<Argument*>(&x0_), static_cast<Argument*>(&y0_), static_cast<Argument*>(&start_)}) {
    each->needs(system_, "is in the letters of typed equations");
  }
}

TypedSystem SystemOption::read(const std::map<std::string, double>& parameters) const {
  const Argument* reading = &system_;
  try {
    const FormulaField field = parse_planar_system(system_.text(), parameters);
    TypedSystem typed{field, field};
    reading = &basis_;
    if (basis_.given()) typed.field.basis = parse_basis(basis_.text(), field, parameters);
    return typed;
  } catch (const BadInput& error) {
    throw BadInput("{}: {}", reading->name(), error.what());
  }
}

std::optional<Eigen::Vector2d> SystemOption::read_start(const TypedSystem& typed, const StartOptions& options) const {
  const auto letters = typed.variables();
  const std::string way_out = fmt::format("a start is --start \"{}=VALUE, {}=VALUE\"", letters[0], letters[1]);
  std::array<std::optional<double>, 2> values;
  const auto set = [&](const Argument& argument, std::size_t place, double value) {
    if (place == letters.size())
      argument.reject(fmt::format("the equations have the letters {} and {}; {}", letters[0], letters[1], way_out));
    if (values.at(place)) argument.reject(fmt::format("{} stands there twice; {}", letters.at(place), way_out));
    values.at(place) = value;
  };
  const auto place_of = [&](std::string_view letter) {
    return static_cast<std::size_t>(std::ranges::find(letters, letter) - letters.begin());
  };
  for (std::size_t i = 0; i < 2; ++i) {
    if (const auto& speed = *options.speeds().at(i); speed.given()) set(speed, i, *speed);
  }
  if (x0_.given()) set(x0_, place_of("x"), *x0_);
  if (y0_.given()) set(y0_, place_of(letters[1] == "x'" ? "x'" : "y"), *y0_);
  if (start_.given()) {
    for (const auto& [letter, value] : *start_) set(start_, place_of(letter), value);
  }
  if (!values[0] && !values[1]) return std::nullopt;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!values.at(i)) throw BadInput("{} missing at the start; {}", letters.at(i), way_out);
  }
  return Eigen::Vector2d(*values[0], *values[1]);
}

Eigen::Vector2d SystemOption::require_start(const TypedSystem& typed, const StartOptions& options) const {
  if (const auto start = read_start(typed, options)) return *start;
  throw BadInput("a start is missing: give --start \"{}=VALUE, {}=VALUE\"", typed.variables()[0], typed.variables()[1]);
}

}  // namespace contensou::program
