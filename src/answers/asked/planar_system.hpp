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
  std::vector<std::string> variables;  ///< typed names of u and v, such as x and x'
  std::string independent;             ///< typed letter of the time; for Equations::first the first variable

  Eigen::Vector2d operator()(const Eigen::Vector2d& x) const;

  /// Returns the derivatives of (u', v') by u and v, from Formulas::with_slopes. Row 0 belongs to u'.
  Eigen::Matrix2d jacobian(const Eigen::Vector2d& x) const;

  /// Returns the coefficients of u' and v' as in reduction::SmoothField; empty unless both are polynomials. The
  /// conversion to a SmoothField leaves them out, because the page contains no Expression.
  std::vector<Eigen::MatrixXd> polynomials() const;

  operator reduction::SmoothField() const;  // NOLINT(google-explicit-constructor): the field is smooth
};

/// Returns the field of a typed system "x' = F; y' = G", of an equation of first order "y' = F(x, y)", or of an
/// equation of second order "x'' = F(x, x')", in any letters. answers/input/formulas.hpp describes the formulas, and
/// which derivatives may be typed. An equation may be linear in its highest derivative, as x*y' + y = 0, or have
/// differentials, as y dx - x dy = 0.
///
/// The variables of a system in u and v, or in x and y, have this order; others have the order of their equations.
/// The independent letter is the one of dx/dt or x'(t). For an equation of first order it is otherwise the other letter
/// without a value, and t for systems and equations of second order.
///
/// @param given  values of parameters; e^ is read with Euler's number unless e has a value
/// @throws BadInput  as Formulas; for other numbers of equations, higher orders, and right sides that contain the time
FormulaField parse_planar_system(const std::string& typed, const std::map<std::string, double>& given);

/// Returns a basis from formulas between semicolons, such as "1; u; v; exp(u)". The formulas may contain the
/// variables of `system`, and `parameters`.
/// @throws BadInput  as Formulas; for no function, and for more functions than Basis::most
reduction::Basis parse_basis(const std::string& text, const FormulaField& system,
                             const std::map<std::string, double>& parameters);

}  // namespace contensou::answers
