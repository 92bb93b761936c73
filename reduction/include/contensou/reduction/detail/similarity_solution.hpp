#pragma once

#include <concepts>
#include <memory>
#include <utility>
#include <vector>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// A coordinate xi of k = v/(mu |u|) between two neighbouring invariant ratios: the terminal ratio k*, which is the
/// limit of k at the stop, and k_far, from which k comes. Each of the two is 0, the k of an invariant ray, or infinity.
///
/// xi is the argument of every SimilarityCurve (numerics.md (R38)). It falls to -infinity at the stop and grows to
/// infinity at k_far.
///   from above:  xi = ln[(k - k*)/(1 - k/k_far)]          (k* = 0, k_far = infinity: ln k)
///   from below:  xi = ln[(1/k - 1/k*)/(1 - k_far/k)]      (k* = infinity, k_far = 0: -ln k)
/// Next to k* and k_far the double k has lost the digits of its distance from k* or k_far; xi keeps these digits.
class TerminalChart {
 public:
  enum class Side { above, below };

  /// Makes the chart with the farthest k_far on this side of k*: infinity above k*, 0 below k*.
  /// @param ln_k_star  ln of the terminal ratio: -infinity is only reached from above, +infinity only from below
  /// @throws std::domain_error  if ln_k_star is not a number; +infinity with Side::above, -infinity with Side::below
  TerminalChart(Side side, double ln_k_star);

  /// Makes the chart from k_far, above or below k*, to k*.
  /// @throws std::domain_error  if the two are equal or not numbers
  static TerminalChart between(double ln_k_star, double ln_k_far);

  /// Returns the chart from infinity to 0, in which xi is ln k.
  static TerminalChart to_zero();

  Side side() const { return sign_ > 0 ? Side::above : Side::below; }

  /// Returns ln k*.
  double log_terminal_ratio() const { return sign_ * end_; }

  /// Returns ln k_far.
  double log_far_ratio() const { return sign_ * far_; }

  /// Returns true if k lies between k* and k_far or equals one of them.
  bool reaches(double ln_k) const { return sign_ * ln_k >= end_ && sign_ * ln_k <= far_; }

  /// Returns xi of a k between k* and k_far. Let y be ln k (from below -ln k). At k* the result is y(k*) +
  /// min_coordinate, and at k_far it is y(k_far) - min_coordinate.
  double coordinate(double ln_k) const;

  /// Returns ln k.
  double log_ratio(double xi) const;

  /// Returns d ln k/d xi: positive from above, negative from below. It is 0 at an end, unless the end is 0 or infinity.
  double log_ratio_rate(double xi) const;

  /// Difference xi - ln k* (from below xi + ln k*) at which exp(xi) is negligible compared with k* (from below 1/k*).
  static constexpr double min_coordinate = -745;

 private:
  TerminalChart(double sign, double end, double far);

  double sign_;  ///< 1 or -1, the sign of d ln k/d xi
  double end_;   ///< sign_ ln k*; exp(xi) = (exp(y) - exp(end_))/(1 - exp(y - far_)) on both sides, y = sign_ ln k
  double far_;   ///< sign_ ln k_far
};

/// A curve in the plane of w and v. Its scaled copies are all motions whose k = v/w tends to one limit from one side.
/// Its functions depend on xi, a coordinate of k (TerminalChart). If k -> 0 at the stop, as for balls under the exact
/// law and the Pade law, xi is ln k.
///
/// Orbits, stop times, the state at a time and the regularised time follow from the functions by exponentials and sums
/// (Orbit). w is mu |u|, s is the scaled time of theory.md (R1). m, n and c are bounded for all r; so is b,
/// except at k = 0, where b is 1/(128 r Psi(0)). Under a drive rho, m, n and o grow like 1/k as k -> 0, but their
/// products with v stay finite. v underflows long before ln v.
class SimilarityCurve {
 public:
  virtual ~SimilarityCurve() = default;

  /// Returns ln w along the curve, up to a constant; it grows with xi (theory.md (R2)).
  virtual double ln_w(double xi) const = 0;

  /// Returns m: the time left is P + m S (theory.md (R4)), with the stop times P of pure pivoting and S of pure
  /// sliding. In the limit of pure sliding, m is 1/(1 - rho).
  virtual double sliding_coefficient(double xi) const = 0;

  /// Returns n: the slip length left is v (v/(2 (1 - rho)) + n w) (theory.md and numerics.md (R30), (R26)).
  virtual double slip_length_coefficient(double xi) const = 0;

  /// Returns o: the angle left, the integral of w ds, is w (w/(2 r Psi(0)) + o v) (theory.md (R8)).
  virtual double angle_coefficient(double xi) const = 0;

  /// Returns b: the regularised time is b/(w + v), up to its unit and a constant (numerics.md (R39)).
  virtual double beta_coefficient(double xi) const = 0;

  /// Returns c: the derivative of the time left by xi is c (w + v) (theory.md (R3)).
  virtual double time_rate(double xi) const = 0;

  /// Returns a bound of the relative error of stop times computed with sliding_coefficient.
  virtual double accuracy() const = 0;

  /// Returns the number of calls of the law that were needed to compute sliding_coefficient.
  virtual long evaluations() const { return 0; }

  /// Returns r = gamma mu^2/chi.
  double r() const { return r_; }

  /// Returns rho, the drive.
  double drive() const { return drive_; }

  const TerminalChart& chart() const { return chart_; }

  /// Returns an xi below which, to the last bit, ln w is linear and the other functions are constant.
  virtual double linear_below() const = 0;

  SimilarityCurve(const SimilarityCurve&) = delete;
  SimilarityCurve& operator=(const SimilarityCurve&) = delete;

 protected:
  SimilarityCurve(double r, const TerminalChart& chart, double drive = 0) : r_(r), drive_(drive), chart_(chart) {}

 private:
  double r_, drive_;
  TerminalChart chart_;
};

/// All motions of a law and an r = gamma mu^2/chi: one curve for each interval of k between two neighbours among 0, the
/// invariant rays and infinity. A solution never changes and is cheap to copy. It is empty if it has no curves.
class SimilaritySolution {
 public:
  using Curve = std::shared_ptr<const SimilarityCurve>;

  SimilaritySolution() = default;

  /// Makes a solution of one curve that covers every k.
  SimilaritySolution(Curve only)  // NOLINT(google-explicit-constructor)
      : SimilaritySolution(std::vector{std::move(only)}) {}

  template <std::derived_from<SimilarityCurve> C>
  SimilaritySolution(std::shared_ptr<C> only)  // NOLINT(google-explicit-constructor)
      : SimilaritySolution(Curve(std::move(only))) {}

  /// Makes a solution of curves that together cover every k.
  explicit SimilaritySolution(std::vector<Curve> curves) : curves_(std::move(curves)) {}

  explicit operator bool() const { return !curves_.empty(); }

  /// Returns the curve of the motions with this k; ln_k may be infinite. For a ray the result is a curve beside it.
  /// @throws std::domain_error  if no curve covers this k
  const Curve& through(double ln_k) const;

  const std::vector<Curve>& curves() const { return curves_; }

 private:
  std::vector<Curve> curves_;
};

/// Finds the solution by quadrature, for any law and r (theory.md (R2), (R7), (R9), (R8)).
/// @param ratios  terminal_ratios(law, r, drive)
/// @throws std::domain_error   unless r is positive and finite
/// @throws std::runtime_error  if the law has an invariant ray that terminal_ratios did not find
SimilaritySolution quadrature_solution(const Law& law, double r, const TerminalRatios& ratios, double drive = 0);

/// Returns the solution in closed form, by the type of the law: PadeCurve (numerics.md (R40) to (R43)) for PadeLaw if r
/// <= PadeCurve::max_r; else empty. No other code depends on which laws have a closed form.
SimilaritySolution closed_solution(const Law& law, double r, double drive = 0);

}  // namespace contensou::reduction
