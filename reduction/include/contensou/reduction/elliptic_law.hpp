#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// Friction whose force Phi and moment Psi lie on an ellipse, Phi^2 + (Psi/C)^2 = 1. The velocity (v, w) is normal to
/// this ellipse. Robotics calls the ellipse a limit surface, physics engines call it an elliptic friction cone.
///
/// Source    Phi = k/sqrt(k^2 + C^2), Psi = C^2/sqrt(k^2 + C^2); R. D. Howe and M. R. Cutkosky, "Practical
///           force-motion models for sliding manipulation", Int. J. Robotics Research 15 (1996) 557,
///           doi:10.1177/027836499601500603.
/// Orbits are powers, v ~ w^(1/(r C^2)), w = mu |u|, r of ReducedSystem; the stop time is one integral, README (R35).
/// Accuracy  2 eps relative for every k (eps: the rounding of a double).
/// Symmetry  degree 0: unchanged, bit for bit, when both speeds are scaled by a power of two.
class EllipticLaw {
 public:
  static constexpr SlidingBounds sliding_bounds{0, 1};
  /// The moment Psi(0) of pure pivoting under Hertz's pressure, 3 pi/16.
  static constexpr double hertz_moment = 3 * std::numbers::pi / 16;
  static constexpr double min_moment = 1e-3;

  /// @param moment  C = Psi(0), moment of pure pivoting over f N (patch radius), from min_moment to 1 (a thin ring)
  /// @throws std::domain_error  for any other moment
  explicit EllipticLaw(double moment = hertz_moment);

  /// Returns "elliptic", or "elliptic:C" with the shortest C that reads back to the same double.
  std::string name() const;

  double moment() const { return moment_; }

  /// Returns an empty list: Phi and Psi are smooth.
  static std::vector<double> kinks() { return {}; }

  /// Returns force and moment. Throws as require_slip.
  Resistance operator()(Slip slip) const;

  /// Returns 1 - Psi/Psi(0), without cancellation for k << 1.
  double moment_deficit(Slip slip) const;

  /// Returns 1 - Phi, without cancellation for k >> 1.
  double force_deficit(Slip slip) const;

 private:
  double moment_;
};

}  // namespace contensou::reduction
