#pragma once

#include "contensou/reduction/terminal_chart.hpp"

namespace contensou::reduction {

/// The curve of which all motions with one terminal ratio, approached from one side, are scaled copies. Its functions
/// depend on xi, a coordinate of k = v/w (TerminalChart); if k -> 0, as for balls under Zh98's laws, xi is ln k.
///
/// The scaling symmetry leaves nothing else to compute. Orbits, stop times, the state at a given time and the
/// regularised time follow from these functions by exponentials and sums (Orbit). w is mu |u|, s the scaled time of
/// README (R1). m, n and c are bounded for all r; so is b except for its value 1/(128 r Psi(0)) at k = 0. With a drive
/// rho, m, n and o grow like 1/k as k -> 0, and their products with v stay finite. v underflows long before ln v.
class SimilarityCurve {
 public:
  virtual ~SimilarityCurve() = default;

  /// Returns ln w along the curve, up to a constant; grows with xi (README (R2)).
  virtual double ln_w(double xi) const = 0;

  /// Returns m, where the time left is P + m S (README (R4)), with the stop times P of pure pivoting and S of pure
  /// sliding; 1/(1 - rho) in the limit of pure sliding.
  virtual double sliding_coefficient(double xi) const = 0;

  /// Returns n, the coefficient of the slip length left, v (v/(2 (1 - rho)) + n w) (README (R13), (R50)).
  virtual double slip_length_coefficient(double xi) const = 0;

  /// Returns o, where the angle left, the integral of w ds, is w (w/(2 r Psi(0)) + o v) (README (R31)).
  virtual double angle_coefficient(double xi) const = 0;

  /// Returns b, the coefficient of the regularised time, b/(w + v) up to its scale and a constant (README (R7)).
  virtual double beta_coefficient(double xi) const = 0;

  /// Returns c, the coefficient of the derivative of the time left by xi, c (w + v) (README (R3)).
  virtual double time_rate(double xi) const = 0;

  /// Returns a bound of the relative error of a stop time that sliding_coefficient gives.
  virtual double accuracy() const = 0;

  /// Returns the number of calls of the law for sliding_coefficient.
  virtual long evaluations() const { return 0; }

  /// Returns r = gamma mu^2/chi.
  double r() const { return r_; }

  /// Returns rho, the drive.
  double drive() const { return drive_; }

  const TerminalChart& chart() const { return chart_; }

  /// Returns the xi below which, to the last bit, ln w is linear and the other functions are constant.
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
