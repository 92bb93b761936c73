#pragma once

#include <optional>
#include <string>
#include <vector>

#include "answers/equation/solution.hpp"

namespace contensou::answers {

/// The reduction of an equation as formulas in its own letters. A part that is not certain is empty.
struct Steps {
  std::vector<std::string> names;  ///< the two variables, then q and p
  std::vector<std::string> kinds = {};
  std::optional<Coordinates> coordinates = {};
  std::optional<IntegralFormula> integral = {};
  std::string where = {};  ///< quadrant in which H was checked, such as "x > 0, y > 0"; empty for the plane
  std::optional<Expression> branch = {};  ///< y as a formula in x along the orbit of the start, for y' = F(x, y)
  std::optional<Expression> factor = {};  ///< inverse integrating factor V, that of H if H is known
  std::vector<Expression> parts = {};     ///< the right sides

  std::string text(const Expression& e, int digits = 0) const { return e.text(names, digits); }

  /// Returns the separated equation, such as "dq/dp = tan(q)"; empty without coordinates.
  std::string separated(int digits = 0) const;

  /// Returns the formulas at whose zeros H may jump, so that C has another value on the other side: the denominators of
  /// arguments of atan, and cos(z) for tan(z) in these arguments.
  std::vector<Expression> jumps() const;

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
