#pragma once

#include <functional>

#include "contensou/reduction/slip.hpp"

namespace contensou::reduction {

/// Coulomb friction of a circular patch by its definition: an integral of the local slip over the disc, equations (1.1)
/// and (1.2) of V. F. Zhuravlev, 1998 (Zh98). The integration is slow and shares no formula with any law, so tests
/// compare the laws with this class.
///
/// The unit of length is the radius of the patch. The pressure may have any unit, because it is divided by the load.
/// Accuracy  1e-12 of the largest value (1 for Phi, Psi(0) for Psi), for pressures that are smooth inside the disc and
///           a power of 1 - rho^2 at its edge, with an exponent above -1; rho is the distance from the centre.
class ContactPatch {
 public:
  /// @param pressure  pressure, >= 0, as a function of 1 - rho^2; this argument keeps its digits at the edge
  /// @throws std::domain_error  if the load, the integral of the pressure over the disc, is not positive and finite
  explicit ContactPatch(std::function<double(double)> pressure);

  /// Returns force and moment by the double integral (1.1), in polar coordinates about the centre of the patch.
  /// @throws std::domain_error  for a slip that require_slip rejects
  Resistance over_disc(Slip slip) const;

  /// Returns force F and moment M by (1.2), the integral over chords, in polar coordinates (q, theta) about the centre
  /// of velocity, at the distance k from the centre of the patch. Two misprints are corrected: cos(theta) is included,
  /// and M = M^h - k F, with the moment M^h about the centre of velocity. For k <= 1, theta goes from 0 to pi.
  /// @param k  sliding speed divided by rim speed, > 0, finite
  Resistance over_chords(double k) const;

  /// Returns Q_n of (1.2) divided by the load: the integral of pressure times q^n along a chord, from q_- to q_+.
  /// @param n      exponent, >= 0
  /// @param theta  angle of chord and line through the centres of velocity and patch; returns 0 if the chord misses
  double chord_moment(int n, double theta, double k) const;

 private:
  double pressure_at(double rest) const;
  double chord_moment_of(int n, double centre, double half_length) const;

  std::function<double(double)> pressure_;
  double load_ = 1;
};

}  // namespace contensou::reduction
