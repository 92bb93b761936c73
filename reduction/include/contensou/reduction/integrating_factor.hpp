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

/// Returns the point whose coordinates set the scale of the samples of a field: the start. If the start lies at the
/// origin, or a million times nearer to it than the first change of the field, the point is (s, s) with the distance s
/// of this change, or 1 without a change. There a component or a switching function changes its sign, or f differs from
/// f(0) by half of f(0).
Eigen::Vector2d sampled_about(const SmoothField& field, const Eigen::Vector2d& start);

/// A form of V that was tried, and the error of the best V of this form in README (R64), f . grad V = V div f.
struct TriedForm {
  std::string_view form;
  double singular_value;  ///< smallest singular value: root mean square of the misfit (R66) over the points of the fit
  double gap;             ///< smallest singular value that does not count as 0, divided by the largest that does
  double residual;        ///< largest misfit (R66) at points that the fit did not use
  bool cleared = false;   ///< true if V D, V times the denominator of the field, has the form
};

/// V and the first integral H as formulas in u and v; empty if the coefficients are not recognised as rational numbers.
struct FactorFormula {
  std::string factor, integral;
};

/// x' = f(x) solved by an inverse integrating factor V, f . grad V = V div f, README (R64) to (R68).
///
///     const FactorReduction reduction({field, jacobian}, start);
///     if (reduction.found()) reduction.reduction().orbit(start).at(0.5);
///
/// A value type; copies share the solution.
///
/// Accuracy  relative 1e-12 of states and times, unless the motion amplifies rounding.
class FactorReduction {
 public:
  /// Searches for V in a box, +-30 % about the start or, if the start (u, v) is an equilibrium, about (1.25 u, 0.8 v).
  /// The forms are tried in turn; the search ends at the first form that satisfies the equation. If the field f has a
  /// denominator D and no form fits V, the forms are tried for V D, an inverse integrating factor of D f.
  /// @throws std::domain_error  unless the start is finite and the field has a value there
  FactorReduction(const SmoothField& field, const Eigen::Vector2d& start);

  bool found() const { return !form().empty(); }

  /// Returns "constant" (div f = 0), "affine" (V = f ^ X, X affine), "polynomial" (degree 4 or less), "linear in v",
  /// "quadratic in v", "linear in u", "quadratic in u" (coefficients are functions of the other coordinate), "product"
  /// (V = A(u) B(v)) or "basis" (V is a sum of functions of the field's basis); empty if no V was found.
  std::string_view form() const;

  /// Returns the forms in the order in which they were tried.
  const std::vector<TriedForm>& tried() const;

  /// Returns V, up to a constant factor, and H, up to constants. Both are empty unless V has rational coefficients with
  /// which the misfit (R66) is below 1e-12. V of degree 4 or less is factorised. H is a sum of functions of u and of v.
  FactorFormula formula() const;

  /// Returns the solved system. V is 1 at the start unless V vanishes there. V has values in the box of the start; V of
  /// form "affine" or "basis" everywhere. H has values in this box up to the nearest curve V = 0. Orbits continue
  /// beyond the box, because V is fitted anew there.
  /// @throws std::domain_error  if no V was found
  PlanarReduction reduction() const;

 private:
  struct Solved;
  std::shared_ptr<const Solved> solved_;
};

}  // namespace contensou::reduction
