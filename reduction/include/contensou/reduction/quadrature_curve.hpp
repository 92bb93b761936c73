#pragma once

#include <memory>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/similarity_curve.hpp"

namespace contensou::reduction {

/// The similarity curve of any friction law, by quadrature of the separated equation.
///
/// m, all that a stop time needs, is found in ln k, outwards from the stop (RegularSolution). The others are found when
/// they are first asked for: n, o and b like m, ln w and c in xi, (R26), panel by panel: on each, coefficients are sampled
/// at Gauss points (Boost.Math), and solved as Legendre series. Panels meet at the law's kinks and are halved until the
/// series have converged. They reach from k = 4e-18 to 1e19, where the limits hold to the last bit; and towards an
/// invariant ray as far as Phi - r k Psi, which vanishes there, has a digit left.
///
/// Accuracy  sliding_coefficient 3 eps for a law that is smooth between its kinks, on and beside rays, too
///           (tests/reference/rays.csv); the other functions 1e-13, and less next to a ray.
/// Cost      about 1 300 evaluations of the law for m, as many for each of n, o and b, and 2 000 for ln w and c; then
///           some 30 ns for each value. Noise in the law costs up to a million, and shows in truncation().
class QuadratureCurve final : public SimilarityCurve {
 public:
  /// @param r         gamma mu^2/chi
  /// @param chart     between two neighbours of 0, the invariant rays and infinity, to the one that k tends to
  ///                  (terminal_ratios); the default is right for r up to Phi'(0)/Psi(0), and for every ball
  /// @param drive     rho of ReducedSystem
  /// @throws std::domain_error  unless r > 0, and Phi - rho - r k Psi has the sign of this approach everywhere on its way
  QuadratureCurve(const Law& law, double r, const TerminalChart& chart = TerminalChart::to_zero(), double drive = 0);

  double ln_w(double xi) const override;
  double sliding_coefficient(double xi) const override;
  double slip_length_coefficient(double xi) const override;
  double angle_coefficient(double xi) const override;
  double beta_coefficient(double xi) const override;
  double time_rate(double xi) const override;

  /// Estimate of the relative error of sliding_coefficient from the last terms of the series.
  double truncation() const;

  /// rounding_of_stop_time and truncation(): below 3e-15 for a smooth law, r < 1e4; with a drive over 1 - rho, which is
  /// what it leaves of friction.
  double accuracy() const override;

  long evaluations() const override;

  double linear_below() const override;

  ~QuadratureCurve() override;

 private:
  class Panels;
  struct Parts;

  /// 1/(k/(1 + k)) where m, n and o are kept as their products with k/(1 + k), else 1.
  double rest_factor(double ln_k) const;

  std::unique_ptr<const Parts> parts_;
};

}  // namespace contensou::reduction
