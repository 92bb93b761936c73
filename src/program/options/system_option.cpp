#include "options/system_option.hpp"

#include "answers/asked/planar_system.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::program {

void SystemOption::add(CLI::App& app) {
  app.option_defaults()->group("Another system");
  system_.add(
      app, "--system", "\"u' = F; v' = G\"",
      "equations in u and v, instead of (2.6); in x and y: \"y' = F(x, y)\"; in x and x': \"x'' = F(x, x')\". --u0 and "
      "--v0 are the start of both, of either sign");
  basis_.add(app, "--basis", "\"1; u; v; exp(u)\"",
             "functions of u and v, for --system. Sums of them are tried as inverse integrating factor, a function V "
             "that gives a constant of the motion");
}

TypedSystem SystemOption::read(const std::map<std::string, double>& parameters) const {
  const Argument* reading = &system_;
  try {
    const FormulaField field = parse_planar_system(system_.text(), parameters);
    TypedSystem typed{field, {field.variables.at(0), field.variables.at(1)}};
    reading = &basis_;
    if (basis_.given()) typed.field.basis = parse_basis(basis_.text(), field, parameters);
    return typed;
  } catch (const BadInput& error) {
    throw BadInput("{}: {}", reading->name(), error.what());
  }
}

}  // namespace contensou::program
