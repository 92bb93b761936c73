#pragma once

#include <array>
#include <limits>

#include "contensou/reduction/inertia.hpp"

namespace contensou::si {

/// Elastic constants of the two bodies in contact, the ball first, the plane second.
struct HertzModuli {
  std::array<double, 2> youngs_modulus;  ///< Pa, > 0
  std::array<double, 2> poisson_ratio;   ///< -1 < nu <= 1/2

  /// m, R_c of the second body where they touch: infinite of a plane, below 0 of a dish, not 0.
  double counter_radius = std::numeric_limits<double>::infinity();
};

/// E* (Pa): 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
double effective_modulus(const HertzModuli& moduli);

/// Radius (m) of the patch of a ball pressed on a plane or a sphere: eps = (3 N R'/(4 E*))^(1/3), 1/R' = 1/R + 1/R_c.
///
/// @param load    N, newton
/// @param radius  R, m
/// @throws std::domain_error  unless R' is positive: a dish no wider than the ball touches it not in one patch
double hertz_patch_radius(double load, double radius, const HertzModuli& moduli);

/// Radius (m) of the patch of a ball whose spin about the vertical, without sliding, falls at a measured rate:
///   eps = R^2 alpha/(gamma f g Psi(0)).
///
/// From J domega_z/dt = -f N eps Psi(0) with J = m R^2/gamma and N = m g.
///
/// @param radius           R, m
/// @param deceleration     alpha, rad/s^2
/// @param friction         f
/// @param gravity          g, m/s^2
/// @param pivoting_moment  Psi(0) of the law: 3 pi/16 of the exact and the Pade law, 2/3 of uniform pressure
/// @param gamma            of the body
double patch_radius_of_deceleration(double radius, double deceleration, double friction, double gravity,
                                    double pivoting_moment, double gamma = reduction::homogeneous_ball.gamma);

}  // namespace contensou::si
