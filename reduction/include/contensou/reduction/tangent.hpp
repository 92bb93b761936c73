#pragma once

#include <functional>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

struct HertzLaw;
class EllipticLaw;

/// A resistance and its derivatives by both speeds, for implicit steps in time. Because a law is of degree 0, one slope
/// describes each part. With m, the larger of the speeds v and w,
///   dPhi = force_slope (w dv - v dw)/m^2,    dPsi = -moment_slope (w dv - v dw)/m^2
/// For a law with a dissipation potential v force_slope = w moment_slope, README (R36).
struct Tangent {
  Resistance resistance;
  double force_slope;   ///< Phi' for k <= 1; for k > 1 the derivative of -Phi by 1/k
  double moment_slope;  ///< -Psi' for k <= 1; for k > 1 the derivative of Psi by 1/k

  /// Returns the tangent of a law with a potential.
  /// @param curvature  Phi' for k <= 1; for k > 1 the derivative of Psi by 1/k
  static Tangent of_potential(Resistance resistance, Slip slip, double curvature);
};

/// Returns the tangent in closed form, with slopes to 1e-11.
/// @throws std::domain_error  as the law
Tangent tangent(const HertzLaw& law, Slip slip);
Tangent tangent(const EllipticLaw& law, Slip slip);

/// Returns the tangent of a law as a function: in closed form if its type has one, else by central differences.
/// Differences are within 1e-9 for a smooth law and finite at kinks. Calls allocate or throw only if the law does.
std::function<Tangent(Slip)> tangent_of(const Law& law);

/// Returns a bound of the error of tangent_of's slopes: 0 for rounding alone, else the error of differences.
double tangent_error(const Law& law);

}  // namespace contensou::reduction
