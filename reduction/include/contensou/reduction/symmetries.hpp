#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The right side f of x' = f(x) in the plane. At a point without a value, f throws or the result is not finite.
using PlanarField = std::function<Eigen::Vector2d(const Eigen::Vector2d& x)>;

/// The functions whose sums are tried for the inverse integrating factor V, a solution of f . grad V = V div f.
struct Basis {
  std::vector<std::string> names;
  /// Returns the values of all functions at x. Row i belongs to names[i]; the columns are value, d/du and d/dv.
  std::function<Eigen::MatrixX3d(const Eigen::Vector2d& x)> values = {};
  static constexpr int most = 45;
};

/// A field f with its Jacobian. At a point without a value the field throws or returns a number that is not finite.
struct SmoothField {
  SmoothField() = default;
  /// A field that is given by a function of a point, and perhaps by its Jacobian.
  template <class Function>
  requires(std::is_invocable_r_v<Eigen::Vector2d, const Function&, const Eigen::Vector2d&> &&
           !requires(const Function& f) { f.operator SmoothField(); })
      SmoothField(  // NOLINT(google-explicit-constructor): a function is a field
          Function f, std::function<Eigen::Matrix2d(const Eigen::Vector2d& x)> slopes = {})
      : value(std::move(f)), jacobian(std::move(slopes)) {}

  Eigen::Vector2d operator()(const Eigen::Vector2d& x) const { return value(x); }

  PlanarField value;
  /// The derivatives of f, exact except for rounding; row 0 belongs to u'. If empty, differences replace the Jacobian.
  std::function<Eigen::Matrix2d(const Eigen::Vector2d& x)> jacobian = {};
  /// The denominator D with its derivatives by u and v, if f is a quotient N/D. V D can have a form even if V has none.
  std::function<Eigen::RowVector3d(const Eigen::Vector2d& x)> denominator = {};
  /// If the basis is not empty, V is sought only among sums of these functions.
  Basis basis = {};
  /// The coefficients of u' and v', if f is a polynomial: that of u^i v^j stands in row i and column j. Else empty.
  std::vector<Eigen::MatrixXd> polynomials = {};
  /// The switching functions with their derivatives, one row each: value, d/du, d/dv. Between their zeros f is smooth.
  /// Their number is the same at every point. A value is NaN where the function has none. Where a switching function
  /// changes its sign or touches 0, f may jump, have a kink or end. If empty, the places are found by comparing sides.
  std::function<Eigen::MatrixX3d(const Eigen::Vector2d& x)> switches = {};
  /// Returns the field that equals f about x and continues f smoothly beyond the zeros of the switching functions:
  /// there abs, sign, min, max and comparisons keep the choice that they make at x. If empty, f is its own
  /// continuation.
  std::function<SmoothField(const Eigen::Vector2d& x)> branch = {};
};

/// The generator X = c t d/dt + (A x + b) . d/dx of a one-parameter group that acts on time and plane.
struct Generator {
  double time;             ///< c
  Eigen::Matrix2d matrix;  ///< A
  Eigen::Vector2d shift;   ///< b

  /// True if X maps the field onto itself in the whole plane. Otherwise X does so within each sector between the lines
  /// at which the field is not smooth, but not across these lines. A combination of several such X can hold in the
  /// whole plane; `scaling` is such a combination.
  bool everywhere = true;

  /// Returns the smaller real part of the eigenvalues of A, the least rate at which points leave the centre.
  double growth() const;

  /// Returns true if X is a scaling, also with turns, and false if it is a shift or a turn alone.
  bool scales() const { return !matrix.diagonal().isZero(0); }

  /// Returns the centre, the point at which A x + b vanishes; the one nearest to 0 if there are several.
  Eigen::Vector2d centre() const;

  /// Returns true if x equals the centre up to rounding.
  bool fixes(const Eigen::Vector2d& x) const;
};

/// The generators (Generator) that a field admits. Every x' = f(x) also admits d/dt.
struct PlanarSymmetries {
  enum class Verdict {
    found,
    none,      ///< no generator: the smallest singular value is larger than the errors
    undecided  ///< the errors of the derivatives hide whether there is a generator
  };

  Verdict verdict = Verdict::none;

  /// A basis of the generators. The largest entry of each is 1. A scaling is the first generator and is as accurate as
  /// the field. The other generators are accurate to about `level`.
  std::vector<Generator> generators = {};

  /// Singular values of the determining equations (planar.md (R63)), increasing, relative to the largest.
  std::array<double, 7> singular_values = {};

  /// Singular values below this level count as 0. It is eight times the error that the derivatives cause.
  double level = 0;

  /// Separation of the singular values: the smallest that does not count as 0, divided by the larger of `level` and the
  /// largest that counts as 0.
  double gap = 0;

  /// The generator for the reduction, if there is one. It holds in the whole plane, also across jumps of the field. All
  /// eigenvalues of A have positive real parts, and A x + b vanishes at one point. The simplest such generator is
  /// taken: first with its centre at the origin and A = 1, then another centre, then a diagonal A, then any. The
  /// largest entry is 1 or -1, and the trace of A is positive.
  std::optional<Generator> scaling = {};

  /// Largest |exp(s (c - A)) f(exp(s A) x) - f(x)|/|f(x)| of the scaling; x is relative to the centre and s = ln 2.
  double residual = infinity;

  int points = 0;                                    ///< number of points at which the equations were sampled
  Eigen::Vector2d within = Eigen::Vector2d::Zero();  ///< largest |u| and |v| of these points
};

/// Finds the generators by a singular value decomposition of the determining equations at up to 96 points.
///
/// Derivatives are those of the field's Jacobian, exact except for rounding. Without a Jacobian they are extrapolated
/// differences (Ridders) with an estimate of their error. Differences never cross the axes u = 0 and v = 0, at which
/// dry friction is not smooth. Points next to other kinks are left out.
///
/// @param around  point whose |u| and |v| set the scale. Sample points lie at 1/3 to 3 times its distance from
///                the origin, in evenly spaced directions, denser towards the axes
/// @throws std::domain_error  if `around` is not finite or 0; if the field is 0; if the field has values at too few
///                            points, with the message of the field's first exception
PlanarSymmetries find_symmetries(const SmoothField& field, const Eigen::Vector2d& around);

/// Returns the right side of the equations of motion (2.6) as a field of x = (u, v); v < 0 is the mirror image.
PlanarField planar_field(const ReducedSystem& system);

}  // namespace contensou::reduction
