#pragma once

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/inertia.hpp"

namespace contensou::reduction {

/// A point of the phase plane (u, v): two speeds in one unit.
struct State {
  double u;  ///< pivoting speed R omega_z, of either sign
  double v;  ///< sliding speed of the contact point, >= 0
};

/// A velocity in the phase plane: the derivatives of u and v.
struct Rate {
  double u;
  double v;
};

/// Two numbers that enclose a third.
struct Bounds {
  double lower;
  double upper;
};

/// A stop time, its error and its cost.
struct StopTime {
  double tau;        ///< the time tau of ReducedSystem; infinity if it exceeds the largest double
  double accuracy;   ///< bound of the relative error of tau
  long evaluations;  ///< number of calls of the friction law; 0 for a closed form
  Bounds bounds;     ///< ReducedSystem::stop_time_bounds
};

/// The two equations of motion (2.6) of V. F. Zhuravlev, 1998 (Zh98), for any friction law and any axisymmetric body:
///   dv/dtau = -(2 chi/(3 pi)) (Phi(k) - rho),  du/dtau = -(2 gamma mu/(3 pi)) Psi(k) sign(u),  k = v/(mu |u|).
/// v is the sliding speed, u = R omega_z the pivoting speed, mu the patch radius divided by R. rho is a constant drive
/// along the slip, 0 in the paper. It represents a slope straight down, or the rolling resistance of a ball that rolls
/// in the direction in which it slides (reduction/README.md, "A constant drive"). Under a drive v = 0 is no orbit: a
/// body that spins without sliding begins to creep.
///
/// The time is the paper's tau = (3 pi/2) f g t with the coefficient of friction f; tau has the unit of a speed. A
/// system never changes and is cheap to copy.
class ReducedSystem {
 public:
  /// @param patch_ratio  mu = patch radius/R, > 0; more than 1 is allowed, because R need not be the width of the body
  /// @param drive        rho: 0, or from least_drive to below 1; a drive of 1 or more would not let the body stop
  /// @throws std::domain_error  if mu, chi or gamma is not a positive finite number, or drive is not allowed
  ReducedSystem(const Law& law, double patch_ratio, Inertia inertia, double drive = 0);

  /// Makes the system of the homogeneous ball on a level plane.
  /// @param patch_ratio  mu, above 0 and at most 1: no patch is wider than the ball
  /// @throws std::domain_error  for any other mu
  ReducedSystem(const Law& law, double patch_ratio);

  const Law& law() const { return law_; }
  double mu() const { return mu_; }
  Inertia inertia() const { return inertia_; }
  double drive() const { return drive_; }

  /// Smallest drive except 0. A smaller drive changes no digit of a motion, and its ray leaves the range of doubles.
  static constexpr double least_drive = 1e-100;

  /// Returns r = gamma mu^2/chi, a normal double. r and rho determine the shape of a motion (README (R1)).
  double r() const { return r_; }

  /// Returns ds/dtau of the scaled time s = chi f g t (README (R1)): dv/ds = rho - Phi, dw/ds = -r Psi, w = mu |u|.
  double scaled_time_rate() const { return scaled_time_rate_; }

  /// Returns d(u, v)/dtau, the right side of the equations of motion.
  /// @throws std::domain_error  at u = v = 0, where the equations have no value, and for v < 0
  Rate field(State state) const;

  /// Returns dtau/dbeta = (16 mu |u| + 15 pi v)(8 mu |u| + 3 pi v), the weight of the regularised time beta of (2.8),
  /// for every law.
  double regularising_weight(State state) const;

  /// Returns d(u, v)/dbeta, the field times the weight; 0 at rest. For the Pade law it is the right side of (2.7).
  /// @throws std::domain_error  for v < 0
  Rate regularised_field(State state) const;

  /// Returns dv/du along an orbit.
  /// @throws std::domain_error  at u = 0 and for v < 0
  double slope(State state) const;

  /// Returns S = 3 pi v/(2 chi), the stop time of a body that slides without pivoting and without a drive (ball: 3 pi
  /// v/7). Under a drive the stop time is S/(1 - rho).
  double sliding_limit(double v) const;

  /// Returns P = 3 pi |u|/(2 gamma mu Psi(0)), the stop time of pivoting without sliding (ball: 16 |u|/(5 mu)).
  double pivoting_limit(double u) const;

  /// Returns bounds of the stop time from the law's SlidingBounds and max(S, P) (README (R6), with a drive (R52)),
  /// widened by 2 rounding_of_stop_time(r)/(1 - rho). For a law without SlidingBounds they are [0, infinity].
  Bounds stop_time_bounds(State start) const;

 private:
  Law law_;
  double mu_;
  Inertia inertia_;
  double drive_;
  double r_;
  double scaled_time_rate_;
};

/// Returns the largest relative error of a stop time by rounding: eps (4 + ln(1 + r)/2), r = gamma mu^2/chi. For r >
/// 1e12, larger than r of any real body, 2 eps ln(r/1e12) is added.
///
/// The error was measured for closed forms up to mu = 1e6 (tests/certify), for quadratures (tests/reference/rays.csv),
/// and up to r = 1e24 as the distance outside proved bounds (tests/reduction/differential.cpp).
double rounding_of_stop_time(double r);

/// Returns true if u and v are finite and v >= 0.
bool is_state(State state);

/// Throws unless is_state(state).
/// @throws std::domain_error  if u or v is not finite or v < 0; the message begins with the function's name
void require_state(const char* function, State state);

}  // namespace contensou::reduction
