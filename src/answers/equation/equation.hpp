#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "answers/asked/planar_system.hpp"
#include "answers/input/expression.hpp"

namespace contensou::answers {

/// A planar system as formulas: x' = f[0], y' = f[1], and the equation of its orbits, dy/dx = slope. The variables
/// have the indices 0 and 1.
struct Equation {
  FormulaField::Equations type;
  std::array<Expression, 2> f;
  Expression slope;
  std::vector<std::string> names;  ///< names of the variables
  Eigen::Vector2d start;           ///< sets the scale of the points at which formulas are compared

  /// Returns 100 random points at which all formulas have values, fewer if they are hard to find.
  /// @param quadrant  true: points in the quadrant of the start only
  std::vector<Eigen::Vector2d> points(const std::vector<Expression>& formulas, bool quadrant = false) const;

  /// Returns true if the formula vanishes, relative to the sum of the sizes of its terms, at 100 random points.
  bool vanishes(const Expression& formula, double error = 1e-10) const;

  /// Returns true if the formula does not change with the variable, also not by a jump, as sign(x) does.
  bool is_free_of(const Expression& formula, std::size_t variable) const;

  /// Returns the constant that the formula equals at 100 random points, as a fraction if it is one.
  std::optional<Number> constant(const Expression& formula) const;

  /// Returns true if f . grad H = 0 to 1e-12 at 100 random points, at which H is not constant.
  bool is_integral(const Expression& H, bool quadrant = false) const;
};

/// Returns the fraction n/m with m <= 60 for which m times the value is n up to the error; else the value.
Number snapped(double value, double error = 1e-9);

/// Returns the equation of a system; empty if a formula is piecewise.
std::optional<Equation> equation_of(const FormulaField& system, const Eigen::Vector2d& start);

/// Words before the kinds of dy/dx = y'/x', the equation of the orbits of a system.
constexpr std::string_view of_orbits = "orbits: ";

/// Returns the words of textbooks for all kinds of equation that hold, such as "homogeneous", "Bernoulli (n = 3)". For
/// a system the last words are those for the equation of its orbits.
std::vector<std::string> kinds_of(const Equation& equation);

/// Returns the map x -> a^k x, y -> a^m y as text.
std::string scaling_text(const std::string& x, const Number& k, const std::string& y, const Number& m);

/// The kinds of equation, each with one sentence for help.
struct EquationKind {
  std::string_view name, meaning;
};
const std::vector<EquationKind>& equation_kinds();

}  // namespace contensou::answers
