#pragma once

#include "contensou/reduction/terminal_chart.hpp"

namespace contensou::reduction {

/// The one orbit that all motions which approach the terminal ratio from one side are scaled copies of, as functions of
/// their nearness xi (TerminalChart): ln k itself where k -> 0, which is every ball.
///
/// Scaling symmetry leaves nothing else to compute: orbits, stop times, the state at a given time and the regularised
/// time follow by exponentials and sums (Orbit). k = v/w, w = mu |u|, s is the scaled time of README (R1). m, n
/// and c are bounded however small r is; b too, but for its value 1/(128 r Psi(0)) at k = 0. With a drive rho, m, n and o
/// grow like 1/k as k -> 0, where v times them is finite. xi may be any finite number: v underflows long before ln v does.
class SimilarityCurve {
 public:
  virtual ~SimilarityCurve() = default;

  /// ln w along the curve, up to a constant; grows with xi (README (R2)).
  virtual double ln_w(double xi) const = 0;

  /// m: the time left is  P + m S  (README (R4)); 1/(1 - rho) in the limit of pure sliding.
  virtual double sliding_coefficient(double xi) const = 0;

  /// n: the length of slip that is left, the integral of v ds, is  v (v/(2 (1 - rho)) + n w)  (README (R13), (R50)).
  virtual double slip_length_coefficient(double xi) const = 0;

  /// o: the angle that is left, the integral of w ds, is  w (w/(2 r Psi(0)) + o v)  (README (R31)).
  virtual double angle_coefficient(double xi) const = 0;

  /// b: the regularised time is  b/(w + v), up to its scale and a constant  (README (R7)).
  virtual double beta_coefficient(double xi) const = 0;

  /// c: the time left grows with xi at the rate  c (w + v)  (README (R3)).
  virtual double time_rate(double xi) const = 0;

  /// Bound of the relative error of a stop time with this sliding_coefficient.
  virtual double accuracy() const = 0;

  /// How often the law was called for sliding_coefficient.
  virtual long evaluations() const { return 0; }

  /// r = gamma mu^2/chi.
  double r() const { return r_; }

  /// rho.
  double drive() const { return drive_; }

  const TerminalChart& chart() const { return chart_; }

  /// Below this xi ln w is linear and the other functions are constant, to the last bit.
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
