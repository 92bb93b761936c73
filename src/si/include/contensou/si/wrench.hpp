#pragma once

#include <functional>

#include <Eigen/Core>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/wrench_kernel.h"

namespace contensou::si {

/// A circular contact patch under dry friction.
struct Patch {
  double friction;  ///< f, >= 0
  double radius;    ///< eps in m, >= 0; 0: a point, without a moment
  double creep;     ///< speed s in m/s, > 0, below which friction is viscous (see PatchFriction); unused by step()
};

/// Force and moment of a patch's friction on a body, and their derivatives by the motion.
struct Wrench {
  Eigen::Vector3d value;     ///< Fx, Fy in N; moment about the normal in N m
  Eigen::Matrix3d jacobian;  ///< derivatives by vx, vy in m/s and omega in rad/s
};

/// The wrench of a patch, that is, its force and moment, for a time step. It is finite and continuous down to rest.
///
/// The law computes the wrench with V = sqrt(|v|^2 + s^2) in place of the sliding speed |v|, and with w = eps |omega|:
///   F = -f N Phi(V, w) v/V,    M = -f N eps Psi(V, w) sign(omega)
/// Every motion satisfies |F| <= f N, |M| <= f N eps Psi(0) and F.v + M omega <= 0.
///
/// Consider a law with a dissipation potential R: every named law except pade, which also has a kink at omega = 0. The
/// wrench is then minus the gradient of the convex function f N R(V, w). The Jacobian is symmetric and negative
/// semidefinite, and an implicit step under a given load N has exactly one solution (reduction/numerics.md, (R50)).
///
/// At rest the Jacobian is diagonal, -f N/s for the force and -f N eps^2 K/s for the moment, with K = lim k Psi (1/5
/// for exact). If eps is the unit of length, the Jacobian is below 5 f N/s for every motion under every law. (The law
/// ring has a logarithm at k = 1, which differences cut off.) For the laws exact, uniform and elliptic of
/// contensou/wrench_kernel.h, the Jacobian is symmetric up to rounding. For other laws it is symmetric to 1e-9, and to
/// 1e-6 next to the kink of ring and similar laws.
///
/// A body at rest under a force creeps. Under a tangential load T < f N alone, its speed is
///   |v| = s T/sqrt((f N)^2 - T^2).
/// Under a moment Q < f N eps Psi(0) alone, eps |omega| = s/k with Psi(k) = Q/(f N eps); for small Q, s Q/(K f N eps).
/// At speeds above s the effect of s is of the order of s^2 divided by the square of the larger speed.
///
/// An engine that advances in time steps should call step(), which needs no creep speed. The slopes are for methods
/// that solve for many contacts at once.
class PatchFriction {
 public:
  explicit PatchFriction(const reduction::Law& law);

  /// Computes the wrench. It does not allocate, and several threads may call it at once.
  /// @param motion  vx, vy of the patch centre relative to the other body in m/s, omega about the normal in rad/s
  /// @param load    N in newtons; for 0 or less there is no contact, and the wrench is 0
  /// @throws std::domain_error  if a number is not finite, a result overflows, or the patch is out of range
  Wrench operator()(const Eigen::Vector3d& motion, double load, const Patch& patch) const;

  /// Computes the wrench without exceptions.
  /// @param wrench  result; zeros if there is an error
  /// @return        description of the error; null if there is none
  const char* evaluate(const Eigen::Vector3d& motion, double load, const Patch& patch, Wrench& wrench) const;

  /// Computes an implicit time step under dry friction, without exceptions (kernel::step).
  /// @param mobility  changes of slip and spin by a unit of impulse and of angular impulse, in 1/kg and 1/(kg m^2), >=
  /// 0
  /// @param dt        time step in s, >= 0
  /// @param after     result; zeros if there is an error
  /// @return          description of the error; null if there is none
  const char* step(const Eigen::Vector3d& motion, const Eigen::Vector2d& mobility, double load, const Patch& patch,
                   double dt, kernel::Step<double>& after) const;

 private:
  std::function<kernel::WrenchSlopes<double>(double vx, double vy, double w, double limit, double radius, double creep)>
      wrench_;
  std::function<kernel::Step<double>(double vx, double vy, double w, double by_force, double by_moment, double limit,
                                     double radius, double dt)>
      step_;
};

}  // namespace contensou::si
