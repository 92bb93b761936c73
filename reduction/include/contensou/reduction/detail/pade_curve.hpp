#pragma once

#include <array>

#include "contensou/reduction/detail/similarity_solution.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The similarity curve of the Pade law in closed form: powers and one Gauss hypergeometric function.
///
/// Source    README (R8) for the orbit, (R9) for the time (it completes the solution begun by V. F. Zhuravlev, 1998),
///           (R27) to (R30) for the numerics, (R11) for the regularised time, (R14) for slip and angle.
/// Accuracy  sliding_coefficient, slip_length_coefficient, angle_coefficient and beta_coefficient about 5 eps relative;
///           ln_w eps (|ln w| + r) absolute.
class PadeCurve final : public SimilarityCurve {
 public:
  /// Largest r = gamma mu^2/chi of the closed form: every ball with mu <= 1 has r <= 5/7.
  static constexpr double max_r = 0.72;

  /// Number of terms of a power series whose argument is 1/2 or less.
  static constexpr int terms = 56;

  /// @throws std::domain_error  unless 0 < r <= max_r
  explicit PadeCurve(double r);

  double ln_w(double ln_k) const override;
  double sliding_coefficient(double ln_k) const override;
  double slip_length_coefficient(double ln_k) const override;
  double angle_coefficient(double ln_k) const override;
  double beta_coefficient(double ln_k) const override;
  double time_rate(double ln_k) const override;
  double linear_below() const override;
  double accuracy() const override { return rounding_of_stop_time(r()); }

  double A() const { return A_; }  ///< 8 (2 - r)
  double B() const { return B_; }  ///< 3 pi (5 - r)
  double a() const { return a_; }  ///< r/(2 - r): slope of ln_w for k -> 0
  double b() const { return a_ - e_; }
  double e() const { return e_; }  ///< r/(5 - r): slope of ln_w for k -> infinity

 private:
  double A_, B_, a_, e_;
  double log_ratio_;           ///< ln(B/A)
  double half_beta_;           ///< integral of (R11) from 1/2 to 1
  double sliding_connection_;  ///< constant of (R30) for the sliding coefficient m
  double angle_connection_;    ///< constant of (R30) for the angle coefficient o

  /// Terms 2, 3, ... of the integral from x = B k/(A + B k) to 1/2 in (R11): x^a far_beta_ - sum beta_terms_[n] x^n.
  std::array<double, terms> beta_terms_{};
  double far_beta_ = 0;
};

}  // namespace contensou::reduction
