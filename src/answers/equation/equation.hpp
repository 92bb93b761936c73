#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "answers/asked/planar_system.hpp"
#include "answers/input/expression.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "contensou/reduction/symmetries.hpp"

namespace contensou::answers {

/// A part of the plane: for each axis, true if only the side of the start belongs to it.
using Sides = std::array<bool, 2>;

/// A planar system as formulas: x' = f[0], y' = f[1], and the equation of its orbits, dy/dx = slope. The variables
/// have the indices 0 and 1.
struct Equation {
  FormulaField::Equations type;
  std::array<Expression, 2> f;
  Expression slope;
  std::vector<std::string> names;  ///< names of the variables
  Eigen::Vector2d start;           ///< sets the scale of the points at which formulas are compared
  /// Points on both sides of places where the slope jumps or has a kink, wherever they lie.
  std::vector<Eigen::Vector2d> beside_kinks = {};

  /// Returns a point of the quadrant of the start. If the start lies on an axis, motion goes into this quadrant.
  Eigen::Vector2d quadrant() const;

  /// Returns 100 random points at which all formulas have values, fewer if they are hard to find, and beside_kinks.
  /// @param within  part of the plane in which they lie
  std::vector<Eigen::Vector2d> points(const std::vector<Expression>& formulas, const Sides& within = {}) const;

  /// Returns the largest part of the plane in which a condition holds; empty if there is none.
  static std::optional<Sides> largest(const std::function<bool(const Sides&)>& holds);

  bool contains(const Sides& within, const Eigen::Vector2d& x) const;

  /// Returns a part of the plane as text, such as "x > 0, y > 0"; empty for the plane.
  std::string text_of(const Sides& within) const;

  /// Returns true if the formula vanishes, relative to the sum of the sizes of its terms, at 100 random points.
  bool vanishes(const Expression& formula, double error = 1e-10) const;

  /// Returns true if the formula does not change with the variable, also not by a jump, as that of sign(x).
  bool is_free_of(const Expression& formula, std::size_t variable) const;

  /// Returns true if the slope is a function of x times a function of y, also across its jumps and kinks.
  bool is_separable() const;

  /// Returns the constant that the formula equals at 100 random points, as a fraction if it is one.
  std::optional<Number> constant(const Expression& formula) const;

  /// Returns true if f . grad H = 0 to 1e-12 at 100 random points, at which H is not constant, and if no orbit crosses
  /// a jump of H.
  bool is_integral(const Expression& H, const Sides& within = {}) const;
};

/// Returns the fraction n/m with m <= 60 for which m times the value is n up to the error; else the value.
Number snapped(double value, double error = 1e-9);

/// Returns the arguments z of all parts sign(z) of a formula.
std::vector<Expression> signs_in(const Expression& e);

/// Returns the arguments z of all parts sign(z) and abs(z) of a formula.
std::vector<Expression> borders_in(const Expression& e);

/// A formula with the two choices of sign(z) and abs(z): its continuations from z > 0 and from z < 0.
struct Continuations {
  Expression above, below;
};
Continuations continuations_of(const Expression& e, const Expression& z);

/// Returns points at which the formula jumps because it contains sign(z) with z = 0; empty if it does not.
std::vector<Eigen::Vector2d> jumps_at(const Expression& e, const Expression& z);

/// Returns true if the curves on which the formula jumps consist of orbits of a vector field X. Derivatives do not see
/// jumps: a formula with X e = 0 is constant along the orbits of X only if it also keeps its jumps.
bool keeps_jumps(const Expression& e, const std::array<Expression, 2>& X);

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

/// Returns an antiderivative by a variable; other variables are constants. Empty if the bounded search finds none.
///
/// The search knows rational functions whose denominator has rational roots and quadratic factors, products of
/// polynomials, exp, sin, cos and logarithms, roots of linear and quadratic functions, and substitutions by a part of
/// the formula. A formula that jumps where a linear function vanishes is integrated on both sides. The logarithms are
/// those of absolute values. The caller checks the result: no step is proved.
std::optional<Expression> antiderivative(const Expression& f, std::size_t variable);

/// Coordinates in which a symmetry of the equation only shifts p, and the equation in them. Formulas contain x and y
/// with the indices 0 and 1, and q with the index 2.
struct Coordinates {
  std::string symmetry;                    ///< the map and its generator as text
  Expression q, p;                         ///< as formulas in x and y
  std::optional<Expression> dq_dp, dp_dq;  ///< one of them, as a formula in q
  std::optional<Expression> dt_dp;         ///< for a system, as a formula in q and p (index 3)
  bool changes_q = true;                   ///< false for q = x, in which the equation is separated by p alone
  Sides within = {};                       ///< part of the plane in which the formulas hold
  /// The symmetry, if it is a scaling, a shift, or a turn of the plane about the origin.
  std::optional<reduction::Generator> motion = {};
};

/// Returns the coordinates of the first symmetry that the equation has: a scaling, a shift or a turn of the plane, or
/// the symmetry of a linear equation or of Bernoulli's.
/// @param found  symmetries of the field, from which a centre and a matrix are taken as fractions
std::optional<Coordinates> coordinates_of(const Equation& equation, const reduction::PlanarSymmetries& found);

/// Returns the shortest of a formula, its expansion, its form as one fraction, and a product with common factors.
Expression tidied(const Expression& e);

/// A function H of x and y that is constant along orbits, as a formula.
struct IntegralFormula {
  Expression H;
  Expression solvable;     ///< H in the form that was found, which solved_for_y solves
  std::string after = {};  ///< "separable after q = ...", if the equation has no symmetry with this q
  Sides within = {};       ///< part of the plane in which it was checked
};

/// Returns H as a formula if one is found and checked; the search is bounded.
/// @param factor  inverse integrating factor V as a formula, if it is known
std::optional<IntegralFormula> integral_of(const Equation& equation, const std::optional<Coordinates>& coordinates,
                                           const std::optional<Expression>& factor);

/// Returns y as a formula in x along the orbit through the start, solved from H = C; empty if H has no such branch.
std::optional<Expression> solved_for_y(const Equation& equation, const Expression& H);

/// A solution y = c of y' = F(x, y).
struct ConstantSolution {
  double y;
  std::string_view stability;  ///< what neighbouring solutions do, if F does not contain x; empty if it is not known
};

struct Constants {
  std::vector<ConstantSolution> all = {};
  bool complete = true;  ///< false: there may be more, farther from the start
};

/// Solutions y(x) as formulas in x.
struct Curves {
  std::vector<Expression> all = {};
  bool complete = true;  ///< as in Constants
};

/// Returns a number as a fraction or as (k + sqrt(n))/m with small whole numbers, if it equals one up to rounding.
Expression exact(double value);

/// The values of x between which a formula y(x) satisfies y' = F(x, y); infinite where no end is found.
struct Extent {
  double from, until;
};

/// The reduction of an equation as formulas in its own letters. A part that is not certain is empty.
struct Steps {
  std::vector<std::string> names;  ///< the two variables, then q and p
  std::optional<Equation> equation = {};
  std::vector<std::string> kinds = {};
  std::optional<Coordinates> coordinates = {};
  std::optional<IntegralFormula> integral = {};
  std::optional<Expression> branch = {};  ///< y as a formula in x along the orbit of the start, for y' = F(x, y)
  std::optional<Expression> factor = {};  ///< inverse integrating factor V, that of H if H is known
  Constants constants = {};               ///< those that were found of y' = F(x, y)
  Curves lost = {};                       ///< solutions with dq/dp = 0 that no C gives

  std::string text(const Expression& e, int digits = 0) const { return e.text(names, digits); }

  /// Returns the separated equation, such as "dq/dp = tan(q)", and where it holds; empty without coordinates.
  std::string separated(int digits = 0) const;

  /// Returns the part of the plane in which H was checked, such as "x > 0, y > 0"; empty for the plane.
  std::string where() const { return equation->text_of(integral->within); }
  bool holds_at(const Eigen::Vector2d& x) const { return equation->contains(integral->within, x); }

  /// Returns where the branch through the start comes to a pole, or its slope leaves the equation, as that of a root
  /// does beyond its zero.
  /// @param end  x at which the orbit ends, or infinity
  Extent extent(const Eigen::Vector2d& start, double end) const;

  /// Returns the formulas at whose zeros H may jump, so that C has another value on the other side: the denominators of
  /// arguments of atan, cos(z) for tan(z) in these arguments, and arguments of sign.
  std::vector<Expression> jumps() const;

  /// Returns C of the orbit from a start. If H jumps there, C is that of the side to which the motion goes.
  /// @param orbit  used only if H jumps at the start
  /// @return NaN if the motion stays where H jumps
  double constant(const Eigen::Vector2d& start, const std::function<reduction::PlanarOrbit()>& orbit) const;

  /// Returns the reason why the right sides have no value next to a point, such as "tan(y/x) has a pole"; empty if
  /// none is found.
  std::string broken_at(const Eigen::Vector2d& x) const;
};

/// @param factor   inverse integrating factor as PlanarReduction::formula; empty if none is known
/// @param cleared  true if `factor` still has to be divided by the denominator of the field
/// @param start   start of the orbit; if empty, the branch of the solution stays empty
/// @param around  point that sets the scale of the points at which formulas are compared
Steps steps_of(const FormulaField& system, const reduction::PlanarSymmetries& found, const std::string& factor,
               bool cleared, const std::optional<Eigen::Vector2d>& start, const Eigen::Vector2d& around);

}  // namespace contensou::answers
