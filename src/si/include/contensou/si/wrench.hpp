#pragma once

#include <functional>

#include <Eigen/Core>

#include "contensou/reduction/tangent.hpp"

namespace contensou::si {

/// A circular contact patch under dry friction.
struct Patch {
  double friction;  ///< f, >= 0
  double radius;    ///< eps in m, >= 0; 0: a point, without a moment
  double creep;     ///< s in m/s, > 0: the speed below which friction is viscous, see PatchFriction
};

/// What friction does to a body over its patch, and how that changes with the motion.
struct Wrench {
  Eigen::Vector3d value;     ///< Fx, Fy in N; moment about the normal in N m
  Eigen::Matrix3d jacobian;  ///< of these by vx, vy in m/s and omega in rad/s
};

/// The wrench of a patch for a time step, finite and continuous down to rest: that of the law, in which the sliding speed
/// |v| is sqrt(|v|^2 + s^2). With V this speed and w = eps |omega|,
///   F = -f N Phi(V, w) v/V,    M = -f N eps Psi(V, w) sign(omega)
/// so |F| <= f N, |M| <= f N eps Psi(0), and F.v + M omega <= 0 for every motion. Under a law with a dissipation potential
/// R (all named ones but pade, which also has a kink at omega = 0) this is minus the gradient of f N R(V, w), which is
/// convex: the Jacobian is symmetric and negative semidefinite, and an implicit step under a given load N has exactly
/// one solution (reduction/README.md, (R36)). At rest it is diagonal, -f N/s for the force and -f N eps^2 K/s for the moment, K = lim k Psi
/// (1/5 for exact); elsewhere it is of that order, below 5 f N/s with lengths in units of eps under every law (the ring's has
/// a logarithm at k = 1, which differences cut off). It is symmetric to rounding for exact and elliptic, whose
/// slopes are closed; those of the others are differences of the law, to 1e-9, and 1e-6 next to the kink of ring and of
/// pressures near it.
///
/// What rests creeps instead: under a tangential load T < f N alone at
///   |v| = s T/sqrt((f N)^2 - T^2),
/// under a moment Q < f N eps Psi(0) alone at eps |omega| = s/k with Psi(k) = Q/(f N eps); at s Q/(K f N eps) if Q is small.
/// Where either speed is above s, its share in force and moment is of the order of s^2 over the larger one's square.
///
/// For one Newton step per time step dt, s should not be below a dt/2, where a is the deceleration by friction alone (for
/// a ball 7/2 f g): else a body that slides without spinning jumps to and fro about rest by up to a dt/2. Steps that
/// iterate to the solution need no such bound.
class PatchFriction {
 public:
  explicit PatchFriction(const reduction::Law& law) : tangent_(reduction::tangent_of(law)) {}

  /// Does not allocate, and may be called from several threads at once.
  /// @param motion  vx, vy of the patch centre over the other body in m/s, omega about the normal in rad/s
  /// @param load    N in N; 0 or less is no contact: zeros
  /// @throws std::domain_error  for a number that is not finite, a speed or a stiffness that overflows, or a member of the
  ///                            patch that is out of its range
  Wrench operator()(const Eigen::Vector3d& motion, double load, const Patch& patch) const;

  /// The same without an exception.
  /// @param wrench  zeros if something is wrong
  /// @return        what is wrong; null if nothing is
  const char* evaluate(const Eigen::Vector3d& motion, double load, const Patch& patch, Wrench& wrench) const;

 private:
  std::function<reduction::Tangent(reduction::Slip)> tangent_;
};

}  // namespace contensou::si
