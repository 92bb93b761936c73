#include "options/system_option.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "answers/asked/planar_system.hpp"

namespace contensou::program {

void SystemOption::add(CLI::App& app) {
  app.option_defaults()->group("Another system");
  system_.add(app, "--system", "\"u' = F; v' = G\"",
              "in place of (2.6): formulas in u and v with + - * / ^, |x|, hypot, sqrt, sign, exp, ...; "
              "--u0 and --v0 of either sign are its start");
}

reduction::SmoothField SystemOption::read(const ParameterOptions& parameters) const {
  try {
    return parse_planar_system(system_.text(), parameters.read());
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("--system: {}", error.what()));
  }
}

std::optional<reduction::PlanarReduction> SystemOption::solve(const reduction::SmoothField& field,
                                                              const Eigen::Vector2d& around) const {
  const reduction::PlanarSymmetries found = reduction::find_symmetries(field.value, around);
  SolvedPlane solved = solve_planar(field, found, around);
  if (solved.plane) return std::move(solved.plane);
  fmt::print(
      stderr,
      "contensou: --system: {}: nothing to draw orbits by. The least singular value of the determining equations is "
      "{:.1e} of the largest, and below {:.1e} it counts as 0. Without a picture, 'contensou reduce' tells more\n",
      solved.why_not, found.singular_values[0], found.level);
  return std::nullopt;
}

}  // namespace contensou::program
