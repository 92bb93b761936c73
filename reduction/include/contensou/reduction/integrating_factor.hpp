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

class FactorOrbit;

/// x' = f(x) solved by an inverse integrating factor V, f . grad V = V div f, README (R64) to (R68).
///
///     const FactorReduction reduction({field, jacobian}, start);
///     if (reduction.found()) reduction.orbit(start).at(0.5);
///
/// A value; copies share what is solved.
///
/// Accuracy  relative 1e-12 of states and times, where the motion does not amplify rounding.
class FactorReduction {
 public:
  /// Looks for V in a box of 30 % about the start: form after form, the first that holds. If the field has a
  /// denominator D and V has no form, V D follows, which is a factor of D f.
  /// @throws std::domain_error  unless the start is finite and the field has a value there
  FactorReduction(SmoothField field, const Eigen::Vector2d& start);

  bool found() const { return !form().empty(); }

  /// Returns "constant" (div f = 0), "affine" (V = f ^ X, X affine), "polynomial" (degree 4 or less), "linear in v",
  /// "quadratic in v", "linear in u", "quadratic in u" (coefficients are functions of the other coordinate), "product"
  /// (V = A(u) B(v)) or "basis" (a sum of functions of the field's basis); empty if none was found.
  std::string_view form() const;

  /// Returns the forms in the order in which they were tried.
  const std::vector<TriedForm>& tried() const;

  /// Returns V, which is 1 at the start unless the start lies on V = 0.
  /// @throws std::domain_error  if none was found; outside the box, unless V is affine
  double factor(const Eigen::Vector2d& x) const;

  /// Returns V in the parts of the rectangle [low, high] in which V may vanish: see PlanarReduction::factor_pieces.
  /// @throws std::domain_error  if none was found
  std::vector<FactorPiece> factor_pieces(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const;

  /// Returns V, up to a constant factor, and H, up to constants, if V has rational coefficients: their residual (R66)
  /// is below 1e-12. V of degree 4 or less is shown in factors. H is shown if it is a sum of functions of u and of v.
  FactorFormula formula() const;

  /// Returns H, dH = (F dv - G du)/V, which is constant along orbits and 0 at the start.
  /// @throws std::domain_error  as factor; and if V vanishes between the start and x
  double first_integral(const Eigen::Vector2d& x) const;

  /// Returns the system whose motions go the other way, with the same V.
  FactorReduction reversed() const;

  /// Returns the solved system.
  /// @throws std::domain_error  if no factor was found
  PlanarReduction reduction() const;

  /// Returns the orbit of another start, or of this one. V is fitted anew from box to box.
  /// @param most_parts  number of parts after which the end is left open
  /// @throws std::domain_error  if none was found; unless the start is finite and the field has a value there
  FactorOrbit orbit(const Eigen::Vector2d& start, int most_parts = 32000) const;
  static constexpr int parts_of_a_picture = 150;

 private:
  struct Solved;
  std::shared_ptr<const Solved> solved_;
};

/// One motion of a system with an inverse integrating factor.
class FactorOrbit {
 public:
  struct Motion;  // planar/factor_orbit.cpp
  explicit FactorOrbit(std::shared_ptr<const Motion> motion) : motion_(std::move(motion)) {}

  /// Returns its end: equilibrium, infinity, border, periodic, cycle or undecided.
  PlanarEnd end() const;

  /// Returns the time of the end; infinity if it takes for ever, NaN if it is not decided.
  double end_time() const;

  /// Returns the period of a periodic orbit.
  std::optional<double> period() const;

  /// Returns the reason why the end is not decided; empty if it is.
  const std::string& undecided() const;

  /// Returns the state at a time after the start.
  /// @throws std::domain_error  unless time >= 0; from the end time on, and for an undecided end beyond the last time
  ///                            followed
  Eigen::Vector2d at(double time) const;

 private:
  std::shared_ptr<const Motion> motion_;
};

}  // namespace contensou::reduction
