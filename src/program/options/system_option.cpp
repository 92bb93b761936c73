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

reduction::SmoothField SystemOption::read(const std::map<std::string, double>& parameters) const {
  const Argument* reading = &system_;
  try {
    const FormulaField field = parse_planar_system(system_.text(), parameters);
    reduction::SmoothField smooth = field;
    reading = &basis_;
    if (basis_.given()) smooth.basis = parse_basis(basis_.text(), field, parameters);
    return smooth;
  } catch (const BadInput& error) {
    throw BadInput("{}: {}", reading->name(), error.what());
  }
}

std::array<std::string, 2> SystemOption::variables(const std::map<std::string, double>& parameters) const {
  const std::vector<std::string> names = parse_planar_system(system_.text(), parameters).variables;
  return {names.at(0), names.at(1)};
}

}  // namespace contensou::program
