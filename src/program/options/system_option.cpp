#include "options/system_option.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "answers/planar_system.hpp"

namespace contensou::program {

void SystemOption::add(CLI::App& app) {
  app.option_defaults()->group("Another system");
  system_.add(app, "--system", "\"u' = F; v' = G\"",
              "in place of (2.6): formulas in u and v with + - * / ^, |x|, hypot, sqrt, sign, exp, ...; "
              "--u0 and --v0 of either sign are its start");
}

reduction::PlanarField SystemOption::read(const ParameterOptions& parameters) const {
  try {
    return parse_planar_system(system_.text(), parameters.read());
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("--system: {}", error.what()));
  }
}

std::optional<reduction::PlanarReduction> SystemOption::solve(const reduction::PlanarField& field,
                                                              const Eigen::Vector2d& around) const {
  using Verdict = reduction::PlanarSymmetries::Verdict;
  const reduction::PlanarSymmetries found = reduction::find_symmetries(field, around);
  if (found.scaling) return reduction::PlanarReduction(field, *found.scaling, around, found.residual);
  fmt::print(
      stderr,
      "contensou: --system: {}: nothing to draw orbits by. The least singular value of the determining equations is "
      "{:.1e} of the largest, and below {:.1e} it counts as 0. Without a picture, 'contensou reduce' tells more\n",
      found.verdict == Verdict::found       ? "there are symmetries, but no scaling among them"
      : found.verdict == Verdict::undecided ? "the field's noise, or its kinks, hide whether it has a scaling"
                                            : "no scaling was found",
      found.singular_values[0], found.level);
  return std::nullopt;
}

}  // namespace contensou::program
