#include "options/system_option.hpp"

#include <fmt/format.h>

#include "answers/asked/planar_system.hpp"
#include "contensou/reduction/planar_steps.hpp"

namespace contensou::program {

void SystemOption::add(CLI::App& app) {
  app.option_defaults()->group("Another system");
  system_.add(app, "--system", "\"u' = F; v' = G\"",
              "another system in place of (2.6), or \"y' = F(x, y)\", \"x'' = F(x, x')\": formulas in u and v with + - "
              "* / ^, |x|, hypot, sqrt, sign, exp, ...; "
              "--u0 and --v0 of either sign are its start");
}

reduction::SmoothField SystemOption::read(const ParameterOptions& parameters) const {
  try {
    return parse_planar_system(system_.text(), parameters.read());
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("--system: {}", error.what()));
  }
}

reduction::PlanarReduction SystemOption::solve(const reduction::SmoothField& field,
                                               const Eigen::Vector2d& around) const {
  SolvedPlane solved = solve_planar(field, reduction::find_symmetries(field.value, around), around);
  return solved.plane ? *std::move(solved.plane) : reduction::by_steps(field.value);
}

}  // namespace contensou::program
