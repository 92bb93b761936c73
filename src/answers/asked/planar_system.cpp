#include "answers/asked/planar_system.hpp"

#include <algorithm>
#include <array>

#include "answers/input/message.hpp"

namespace contensou::answers {

FormulaField parse_planar_system(const std::string& text, const std::map<std::string, double>& parameters) {
  using Equations = FormulaField::Equations;
  const std::vector<std::string> lefts = left_sides(text);
  const auto has = [&](std::string_view left) { return std::ranges::count(lefts, left) > 0; };
  const auto read = [&](Equations equations, const FormulaShape& shape) {
    return FormulaField{equations, Formulas(shape, text, parameters)};
  };
  if (has("x''")) return read(Equations::second, {{"x''"}, {"x", "x'"}, "an equation of second order is \"x'' = F\""});
  if (has("y'") && !has("x'")) return read(Equations::first, {{"y'"}, {"x", "y"}, "an equation is \"y' = F\""});
  if (has("x'")) return read(Equations::system, {{"x'", "y'"}, {"x", "y"}, "a system is \"x' = F; y' = G\""});
  return read(Equations::system, {{"u'", "v'"}, {"u", "v"}, "a system is \"u' = F; v' = G\""});
}

Eigen::Vector2d FormulaField::operator()(const Eigen::Vector2d& x) const {
  const auto [first, second] = formulas({x[0], x[1]});
  switch (equations) {
    case Equations::first:
      return {1, first};
    case Equations::second:
      return {x[1], first};
    default:
      return {first, second};
  }
}

Eigen::Matrix2d FormulaField::jacobian(const Eigen::Vector2d& x) const {
  const auto [first, second] = formulas.with_slopes(std::array{x[0], x[1]});
  const Eigen::RowVector2d slopes(first[1], first[2]);
  Eigen::Matrix2d all;
  switch (equations) {
    case Equations::first:
      all << 0, 0, slopes;
      break;
    case Equations::second:
      all << 0, 1, slopes;
      break;
    default:
      all << slopes, second[1], second[2];
  }
  return all;
}

FormulaField::operator reduction::SmoothField() const {
  return {*this, [*this](const Eigen::Vector2d& x) { return jacobian(x); }};
}

bool is_centre(const reduction::Generator& scaling, const Eigen::Vector2d& start) {
  constexpr double rounding = 1e-12;
  return (start - scaling.centre()).stableNorm() <= rounding * start.stableNorm();
}

namespace {

SolvedPlane solve_by_scaling(const reduction::PlanarField& field, const reduction::PlanarSymmetries& found,
                             const Eigen::Vector2d& start) {
  using Verdict = reduction::PlanarSymmetries::Verdict;
  if (found.scaling) {
    const bool at_centre = is_centre(*found.scaling, start);
    const Eigen::Vector2d around = at_centre ? Eigen::Vector2d(2 * start) : start;
    try {
      return {reduction::PlanarReduction(field, *found.scaling, around, found.residual), ""};
    } catch (const std::domain_error& refused) {
      return {std::nullopt, words_of(refused.what())};
    }
  }
  if (found.verdict == Verdict::none) return {std::nullopt, "no scaling was found"};
  if (found.verdict == Verdict::undecided) {
    return {std::nullopt, "the field's noise, or its kinks, hide whether it has a scaling"};
  }
  const bool everywhere = std::ranges::all_of(found.generators, &reduction::Generator::everywhere);
  return {std::nullopt, everywhere ? "no generator is a scaling"
                                   : "no scaling holds throughout, only within sectors in which the field is smooth: "
                                     "across their borders orbits are no copies of one another"};
}

}  // namespace

SolvedPlane solve_planar(const reduction::SmoothField& field, const reduction::PlanarSymmetries& found,
                         const Eigen::Vector2d& start) {
  SolvedPlane solved = solve_by_scaling(field.value, found, start);
  if (solved.plane) return solved;
  const reduction::FactorReduction by_factor(field, start);
  solved.tried = by_factor.tried();
  if (by_factor.found()) {
    solved.plane = by_factor.reduction();
  } else {
    solved.why_not += ", and no inverse integrating factor of the forms that are tried";
  }
  return solved;
}

}  // namespace contensou::answers
