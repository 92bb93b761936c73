#pragma once

#include <optional>
#include <string>
#include <vector>

#include "answers/equation/equation.hpp"
#include "contensou/reduction/symmetries.hpp"

namespace contensou::answers {

/// Coordinates in which a symmetry of the equation only shifts p, and the equation in them. Formulas contain x and y
/// with the indices 0 and 1, and q with the index 2.
struct Coordinates {
  std::string symmetry;                    ///< the map and its generator as text
  Expression q, p;                         ///< as formulas in x and y
  std::optional<Expression> dq_dp, dp_dq;  ///< one of them, as a formula in q
  std::optional<Expression> dt_dp;         ///< for a system, as a formula in q and p (index 3)
  bool changes_q = true;                   ///< false for q = x, in which the equation is separated by p alone
  /// The symmetry, if it is a shift or a turn of the plane about the origin.
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
  bool quadrant = false;   ///< true: checked only in the quadrant of the start
};

/// Returns H as a formula if one is found and checked; the search is bounded.
/// @param factor  inverse integrating factor V as a formula, if it is known
std::optional<IntegralFormula> integral_of(const Equation& equation, const std::optional<Coordinates>& coordinates,
                                           const std::optional<Expression>& factor);

/// Returns y as a formula in x along the orbit through the start, solved from H = C; empty if H has no such branch.
std::optional<Expression> solved_for_y(const Equation& equation, const Expression& H);

}  // namespace contensou::answers
