#pragma once

#include <memory>
#include <string>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// Coulomb friction of a circular patch; at rho patch radii from its centre the pressure is const (1 - rho^2)^p.
///
/// p = 1/2 is Hertz's pressure (HertzLaw), p = 0 a uniform disc, p = -1/2 a flat rigid punch, p = 1 a paraboloid (a
/// soft foundation). The limit p -> -1 is a thin ring (README (R32)).
///
/// Source    z = k^2:   Phi = C (p + 3/2) k 2F1(1/2, -p - 1/2; 2; z),  Psi = C 2F1(1/2, -p - 3/2; 1; z),   k <= 1
///           z = k^-2:  Phi = 2F1(-1/2, 1/2; p + 2; z),  Psi = 2F1(1/2, 1/2; p + 3; z)/(2 (p + 2) k),      k >= 1
///           with C = Psi(0) = sqrt(pi) Gamma(p + 2)/(2 Gamma(p + 5/2)); elliptic integrals for integer p.
/// Accuracy  4 eps for every k from 1e-300 to 1e300 (tests/reference/laws_pressure.csv), with the 64-bit mantissa of
///           x87's long double. Without it, as in WebAssembly, 7 eps for the named laws and 40 eps at p = 25.
/// Symmetry  degree 0: unchanged, bit for bit, when both speeds are scaled by a power of two.
class PressureLaw {
 public:
  static constexpr SlidingBounds sliding_bounds{0, 1};
  static constexpr double max_p = 25;

  /// @param p  exponent, -1 < p <= max_p
  /// @throws std::domain_error  for any other p
  explicit PressureLaw(double p);

  static PressureLaw uniform();
  static PressureLaw punch();
  static PressureLaw ring();
  static PressureLaw paraboloid();

  /// Returns "uniform", "punch", "ring", "paraboloid", or "pressure:P" with the shortest P that reads back as p.
  const std::string& name() const { return name_; }

  /// Returns the exponent p; -1 for the ring.
  double p() const { return p_; }

  /// Returns force and moment. Throws as require_slip.
  Resistance operator()(Slip slip) const;

  /// Returns 1 - Psi/Psi(0), without cancellation for k << 1.
  double moment_deficit(Slip slip) const;

  /// Returns 1 - Phi, without cancellation for k >> 1.
  double force_deficit(Slip slip) const;

 private:
  struct Series;
  PressureLaw(double p, std::string name);

  double p_;
  std::string name_;
  std::shared_ptr<const Series> series_;
};

}  // namespace contensou::reduction
