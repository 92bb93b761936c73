#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::reduction {

/// Functions that V may be a sum of.
struct Basis {
  std::vector<std::string> names;
  /// Returns the functions, as many as names, with their derivatives: rows of the value, d/du and d/dv.
  std::function<Eigen::MatrixX3d(const Eigen::Vector2d& x)> values = {};
  static constexpr int most = 45;
};

/// A field with its Jacobian. Where it has no value it throws or returns what is not finite.
struct SmoothField {
  PlanarField value;
  /// The derivatives, exact except for rounding; row 0 belongs to u'. If it is empty, differences take their place.
  std::function<Eigen::Matrix2d(const Eigen::Vector2d& x)> jacobian = {};
  /// D with its derivatives by u and v, if the field is a quotient N/D: V D may have a form where V has none.
  std::function<Eigen::RowVector3d(const Eigen::Vector2d& x)> denominator = {};
  /// If it is not empty, V is looked for among sums of these functions only.
  Basis basis = {};
};

/// A form of V that was tried, and how well the best V of this form satisfies (R64).
struct TriedForm {
  std::string_view form;
  double singular_value;  ///< the least: mean square of (R66) over the points of the fit
  double gap;             ///< ratio of the least singular value that counts as large to the largest that counts as 0
  double residual;        ///< largest (R66) at other points
  bool cleared = false;   ///< true if V times the denominator of the field has the form
};

/// V and H as formulas in u and v, as people write them; empty where the numbers are not recognised.
struct FactorFormula {
  std::string factor, integral;
};

/// x' = f(x) solved by an inverse integrating factor V, f . grad V = V div f, README (R64) to (R68).
///
///     const FactorReduction reduction({field, jacobian}, start);
///     if (reduction.found()) reduction.reduction().orbit(start).at(0.5);
///
/// A value; copies share what is solved.
///
/// Accuracy  relative 1e-12 of states and times, where the motion does not amplify rounding.
class FactorReduction {
 public:
  /// Looks for V in a box of 30 % about the start, or about (1.25 u, 0.8 v) if the start (u, v) is an equilibrium. It
  /// tries form after form and takes the first that holds. If the field has a denominator D and V has no form, V D
  /// follows, which is a factor of D f.
  /// @throws std::domain_error  unless the start is finite and the field has a value there
  FactorReduction(SmoothField field, const Eigen::Vector2d& start);

  bool found() const { return !form().empty(); }

  /// Returns "constant" (div f = 0), "affine" (V = f ^ X, X affine), "polynomial" (degree 4 or less), "linear in v",
  /// "quadratic in v", "linear in u", "quadratic in u" (coefficients are functions of the other coordinate), "product"
  /// (V = A(u) B(v)) or "basis" (a sum of functions of the field's basis); empty if none was found.
  std::string_view form() const;

  /// Returns the forms in the order in which they were tried.
  const std::vector<TriedForm>& tried() const;

  /// Returns V, up to a constant factor, and H, up to constants, if V has rational coefficients: their residual (R66)
  /// is below 1e-12. V of degree 4 or less is shown in factors. H is shown if it is a sum of functions of u and of v.
  FactorFormula formula() const;

  /// Returns the solved system. V is 1 at the start unless the start lies on V = 0. V and H have values in the box of
  /// the start, H only where V does not vanish in between. V of an affine generator has values everywhere. Orbits go
  /// on beyond the box, for which V is fitted anew.
  /// @throws std::domain_error  if no factor was found
  PlanarReduction reduction() const;

 private:
  struct Solved;
  std::shared_ptr<const Solved> solved_;
};

}  // namespace contensou::reduction
