#pragma once

#include <array>
#include <memory>

#include "contensou/reduction/detail/similarity_solution.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "numerics/later.hpp"

namespace contensou::reduction {

/// The similarity curve of the Pade law in closed form: powers and one Gauss hypergeometric function.
///
/// Source    numerics.md (R40) for the orbit, (R41) for the time (it completes the solution begun by V. F. Zhuravlev,
/// 1998),
///           (R44), (R45), (R54), (R55) for the numerics, (R43) for the regularised time, (R42) for slip and angle.
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
  double sliding_connection_;  ///< constant of (R55) for the sliding coefficient m
  double angle_connection_;    ///< constant of (R55) for the angle coefficient o

  /// Parts of the integral of (R43). From x = B k/(A + B k) to 1/2, its terms 2, 3, ... are x^a far - sum terms[n] x^n.
  struct BetaIntegral {
    BetaIntegral(double a, double e);
    double half;  ///< integral from 1/2 to 1
    double far = 0;
    std::array<double, PadeCurve::terms> terms{};
  };
  Later<BetaIntegral> beta_integral_;  ///< stop times do not need it; it takes as long as one
};

/// The similarity curve of any friction law, by quadrature of the separated equation (theory.md (R2)).
///
/// A stop time needs the sliding coefficient m alone. m is found as a function of ln k, from the stop outwards
/// (RegularSolution). The other functions of SimilarityCurve are found at their first use: n, o and b like m; ln w and
/// c as functions of xi by (R53). The range of k is cut into panels. On each panel the equation is solved as a Legendre
/// series through Gauss points. Panels meet at the law's kinks and are halved until the series converge. They reach
/// from k = 4e-18 to 1e19; beyond, limits are exact to the last bit. Panels towards a ray end where Phi - r k Psi is
/// only rounding.
///
/// Accuracy  sliding_coefficient 3 eps for a law that is smooth between its kinks, also on and next to rays
///           (tests/reference/rays.csv); the other functions 1e-13, less accurate next to a ray.
/// Cost      about 1 300 calls of the law for m, as many for each of n, o and b, and 2 000 for ln w and c; then about
///           30 ns for each value. Noise in the law raises the number of calls to a million and shows in truncation().
class QuadratureCurve final : public SimilarityCurve {
 public:
  /// @param r         gamma mu^2/chi
  /// @param chart     chart from the limit of k at the stop to its neighbour among 0, the invariant rays and infinity
  ///                  (terminal_ratios). The default chart is right for r up to Phi'(0)/Psi(0), so for every ball
  ///                  under the exact law and the Pade law
  /// @param drive     rho of ReducedSystem
  /// @throws std::domain_error  unless r > 0 and Phi - rho - r k Psi has the chart's sign for all k on the chart
  QuadratureCurve(const Law& law, double r, const TerminalChart& chart = TerminalChart::to_zero(), double drive = 0);

  double ln_w(double xi) const override;
  double sliding_coefficient(double xi) const override;
  double slip_length_coefficient(double xi) const override;
  double angle_coefficient(double xi) const override;
  double beta_coefficient(double xi) const override;
  double time_rate(double xi) const override;

  /// Returns an estimate of the relative error of sliding_coefficient, from the last terms of the series.
  double truncation() const;

  /// Returns the sum of rounding_of_stop_time and truncation(), below 3e-15 for a smooth law and r < 1e4. Under a drive
  /// rho it is divided by 1 - rho, because only this share of the friction slows the body.
  double accuracy() const override;

  long evaluations() const override;

  double linear_below() const override;

  ~QuadratureCurve() override;

 private:
  class Panels;
  struct Parts;

  /// Returns (1 + k)/k if m, n and o are stored as their products with k/(1 + k), else 1.
  double rest_factor(double ln_k) const;

  std::unique_ptr<const Parts> parts_;
};

}  // namespace contensou::reduction
