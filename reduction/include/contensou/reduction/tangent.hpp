#pragma once

#include <functional>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

struct HertzLaw;
class EllipticLaw;

/// A resistance and how it changes with both speeds, for implicit steps in time. Since a law is of degree 0, one number
/// says it of each part: with m the larger of the speeds v and w,
///   dPhi = force_slope (w dv - v dw)/m^2,    dPsi = -moment_slope (w dv - v dw)/m^2
/// For a law with a dissipation potential v force_slope = w moment_slope, README (R36).
struct Tangent {
  Resistance resistance;
  double force_slope;   ///< Phi' for k <= 1, beyond it the slope of -Phi over 1/k
  double moment_slope;  ///< -Psi' for k <= 1, beyond it the slope of Psi over 1/k

  /// Of a law with a potential.
  /// @param curvature  Phi' for k <= 1, beyond it the slope of Psi over 1/k
  static Tangent of_potential(Resistance resistance, Slip slip, double curvature);
};

/// In closed form, the slopes to 1e-11.
/// @throws std::domain_error  as the law
Tangent tangent(const HertzLaw& law, Slip slip);
Tangent tangent(const EllipticLaw& law, Slip slip);

/// The tangent of any law: the closed form that its type has, or else central differences, 1e-9 from the slopes where the
/// law is smooth, and finite at its kinks. Calls do not allocate if those of the law do not, and throw as the law.
std::function<Tangent(Slip)> tangent_of(const Law& law);

/// How far the slopes of tangent_of may be off: 0 for rounding alone, or what differences leave.
double tangent_error(const Law& law);

}  // namespace contensou::reduction
