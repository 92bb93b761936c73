#pragma once

#include "contensou/reduction/terminal_chart.hpp"

namespace contensou::reduction {

/// A curve in the plane of w and v. Its scaled copies are all motions whose k = v/w tends to one limit from one side.
/// Its functions depend on xi, a coordinate of k (TerminalChart). If k -> 0 at the stop, as for balls under the exact
/// law and the Pade law, xi is ln k.
///
/// Orbits, stop times, the state at a time and the regularised time follow from the functions by exponentials and sums
/// (Orbit). w is mu |u|, s is the scaled time of reduction/README.md (R1). m, n and c are bounded for all r; so is b,
/// except at k = 0, where b is 1/(128 r Psi(0)). Under a drive rho, m, n and o grow like 1/k as k -> 0, but their
/// products with v stay finite. v underflows long before ln v.
class SimilarityCurve {
 public:
  virtual ~SimilarityCurve() = default;

  /// Returns ln w along the curve, up to a constant; it grows with xi (README (R2)).
  virtual double ln_w(double xi) const = 0;

  /// Returns m: the time left is P + m S (README (R4)), with the stop times P of pure pivoting and S of pure sliding.
  /// In the limit of pure sliding, m is 1/(1 - rho).
  virtual double sliding_coefficient(double xi) const = 0;

  /// Returns n: the slip length left is v (v/(2 (1 - rho)) + n w) (README (R13), (R50)).
  virtual double slip_length_coefficient(double xi) const = 0;

  /// Returns o: the angle left, the integral of w ds, is w (w/(2 r Psi(0)) + o v) (README (R31)).
  virtual double angle_coefficient(double xi) const = 0;

  /// Returns b: the regularised time is b/(w + v), up to its unit and a constant (README (R7)).
  virtual double beta_coefficient(double xi) const = 0;

  /// Returns c: the derivative of the time left by xi is c (w + v) (README (R3)).
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

}  // namespace contensou::reduction
