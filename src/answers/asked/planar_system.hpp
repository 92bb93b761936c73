#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "answers/input/formulas.hpp"
#include "contensou/reduction/symmetries.hpp"

namespace contensou::answers {

/// A planar field (a reduction::PlanarField) whose two components are given by formulas.
struct FormulaField {
  enum class Equations {
    system,  ///< u' = F(u, v), v' = G(u, v)
    first,   ///< y' = F(x, y): u = x, u' = 1, and v = y
    second,  ///< x'' = F(x, x'): u = x and v = x'
  };
  Equations equations;
  Formulas formulas;
  std::vector<std::string> variables;

  Eigen::Vector2d operator()(const Eigen::Vector2d& x) const;

  /// Returns the derivatives of (u', v') by u and v, from Formulas::with_slopes. Row 0 belongs to u'.
  Eigen::Matrix2d jacobian(const Eigen::Vector2d& x) const;

  operator reduction::SmoothField() const;  // NOLINT(google-explicit-constructor): the field is smooth
};

/// Returns the field of "u' = F; v' = G", of "x' = F; y' = G" in x and y, of the equation "y' = F" in x and y, or of
/// "x'' = F" in x and x'. answers/input/formulas.hpp describes the formulas.
///
/// @throws BadInput  as Formulas
FormulaField parse_planar_system(const std::string& text, const std::map<std::string, double>& parameters);

/// Returns a basis from formulas between semicolons, such as "1; u; v; exp(u)". The formulas may contain the
/// variables of `system`, and `parameters`.
/// @throws BadInput  as Formulas; for no function, and for more functions than Basis::most
reduction::Basis parse_basis(const std::string& text, const FormulaField& system,
                             const std::map<std::string, double>& parameters);

}  // namespace contensou::answers
