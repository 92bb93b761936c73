#pragma once

#include <array>
#include <limits>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::si {

/// Elastic constants of the two bodies in contact. In each array the ball is first, the plane second.
struct HertzModuli {
  std::array<double, 2> youngs_modulus;  ///< Pa, > 0
  std::array<double, 2> poisson_ratio;   ///< -1 < nu <= 1/2

  /// Radius R_c of the second body at the contact, m: infinite for a plane, negative for a dish; never 0.
  double counter_radius = std::numeric_limits<double>::infinity();
};

/// Returns E* in Pa: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
double effective_modulus(const HertzModuli& moduli);

/// Returns the patch radius (m) of a ball on a plane or a sphere: eps = (3 N R'/(4 E*))^(1/3), 1/R' = 1/R + 1/R_c.
///
/// @param load    N, in newtons
/// @param radius  R, m
/// @throws std::domain_error  unless R' is positive; in a dish no wider than the ball there is no single patch
double hertz_patch_radius(double load, double radius, const HertzModuli& moduli);

/// Returns the patch radius (m) of a ball whose spin about the vertical falls at a measured rate without sliding:
///   eps = R^2 alpha/(gamma f g Psi(0)).
///
/// This follows from J domega_z/dt = -f N eps Psi(0) with J = m R^2/gamma and N = m g.
///
/// @param radius           R, m
/// @param deceleration     alpha, rad/s^2
/// @param friction         f
/// @param gravity          g, m/s^2
/// @param pivoting_moment  Psi(0) of the law: 3 pi/16 for the exact and the Pade law, 2/3 for uniform pressure
/// @param gamma            m R^2/J, the inertia number of the body
double patch_radius_of_deceleration(double radius, double deceleration, double friction, double gravity,
                                    double pivoting_moment, double gamma = reduction::homogeneous_ball.gamma);

}  // namespace contensou::si
