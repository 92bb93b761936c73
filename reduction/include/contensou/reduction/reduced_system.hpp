#pragma once

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/inertia.hpp"

namespace contensou::reduction {

/// A point of the phase plane of (2.6): two speeds in one unit.
struct State {
  double u;  ///< pivoting, R omega_z, either sign
  double v;  ///< sliding speed of the contact point, >= 0
};

/// A velocity in the phase plane.
struct Rate {
  double u;
  double v;
};

/// Two numbers that enclose a third.
struct Bounds {
  double lower;
  double upper;
};

/// The paper's two equations (2.6) for any friction law and any axisymmetric body:
///   dv/dtau = -(2 chi/(3 pi)) (Phi(k) - rho),  du/dtau = -(2 gamma mu/(3 pi)) Psi(k) sign(u),  k = v/(mu |u|).
/// rho is a constant drive along the slip, 0 in the paper: rolling resistance of a ball that rolls the way it slides, a
/// slope straight down (README, "A constant drive"). With it v = 0 is no orbit: a body that spins there begins to creep.
///
/// Time is the paper's tau = (3 pi/2) f g t, a speed. A value: cheap to copy, never changes.
class ReducedSystem {
 public:
  /// @param patch_ratio  mu = patch radius/R, > 0: a body that has only these numbers may be wider than R
  /// @param drive        rho: 0, or from least_drive to below 1; from 1 on the body would not stop
  /// @throws std::domain_error  if mu, chi or gamma is not a positive finite number, or drive is not one that is allowed
  ReducedSystem(const Law& law, double patch_ratio, Inertia inertia, double drive = 0);

  /// The homogeneous ball on a level plane.
  /// @param patch_ratio  mu, above 0 and at most 1: no patch is wider than the ball
  /// @throws std::domain_error  for another mu
  ReducedSystem(const Law& law, double patch_ratio);

  const Law& law() const { return law_; }
  double mu() const { return mu_; }
  Inertia inertia() const { return inertia_; }

  /// rho.
  double drive() const { return drive_; }

  /// Below this a drive moves nothing that a double shows, and its ray leaves their range.
  static constexpr double least_drive = 1e-100;

  /// r = gamma mu^2/chi, the one number beside rho that the shape of the motion depends on (README (R1)); at least the
  /// smallest normal double.
  double r() const { return r_; }

  /// ds/dtau of the scaled time s = chi f g t (README (R1)), in which dv/ds = rho - Phi, dw/ds = -r Psi, w = mu |u|.
  double scaled_time_rate() const { return scaled_time_rate_; }

  /// d(u, v)/dtau, the right side of (2.6).
  /// @throws std::domain_error  at u = v = 0, where (2.6) has no value, and for v < 0
  Rate field(State state) const;

  /// dtau/dbeta = (16 mu |u| + 15 pi v)(8 mu |u| + 3 pi v), the weight of (2.8), the same for every law.
  double regularising_weight(State state) const;

  /// d(u, v)/dbeta: the field times the weight, (2.7) for the Pade law; 0 at u = v = 0.
  /// @throws std::domain_error  for v < 0
  Rate regularised_field(State state) const;

  /// dv/du along an orbit.
  /// @throws std::domain_error  at u = 0 and for v < 0
  double slope(State state) const;

  /// S = 3 pi v/(2 chi): the stop time of a body that slides, does not pivot and is not driven. Ball: 3 pi v/7. With a
  /// drive it is S/(1 - rho).
  double sliding_limit(double v) const;

  /// P = 3 pi |u|/(2 gamma mu Psi(0)): the stop time of a body that pivots and does not slide. Ball: 16 |u|/(5 mu).
  double pivoting_limit(double u) const;

  /// Two-sided bound of the stop time from the law's own SlidingBounds and max(S, P) (README (R6), with a drive (R52));
  /// widened by 2 rounding_of_stop_time(r)/(1 - rho); [0, infinity] for a law that states none.
  Bounds stop_time_bounds(State start) const;

 private:
  Law law_;
  double mu_;
  Inertia inertia_;
  double drive_;
  double r_;
  double scaled_time_rate_;
};

/// Largest relative error of a stop time by rounding: eps (4 + ln(1 + r)/2), r = gamma mu^2/chi; beyond r = 1e12, which
/// no real body has, 2 eps ln(r/1e12) more.
///
/// Measured in closed form up to mu = 1e6 (tests/certify), by quadrature (tests/reference/rays.csv), and, by how far a
/// bound is passed, up to r = 1e24 (tests/reduction/differential.cpp).
double rounding_of_stop_time(double r);

/// Whether a motion can have it: u and v finite, v >= 0.
bool is_state(State state);

/// Rejects a state that no motion can have.
/// @throws std::domain_error  if u or v is not finite or v < 0; the message begins with the function's name
void require_state(const char* function, State state);

}  // namespace contensou::reduction
