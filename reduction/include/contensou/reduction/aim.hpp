#pragma once

#include <optional>
#include <stdexcept>

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// Time, distance and angle of a motion from its start to its stop, in the units of Orbit.
struct Reached {
  double tau;       ///< the time tau of ReducedSystem
  double distance;  ///< path of the centre, the integral of its velocity over tau: a speed squared
  double turned;    ///< the integral of |u| over tau: a speed squared
};

/// Returns time, distance and angle until the stop for a body that begins without rolling. Its centre moves along the
/// slip at the speed V = (1 - 1/chi) v0 + v/chi, where chi is the number of Inertia and v the sliding speed.
/// @throws std::domain_error  as Flow::orbit, and for a flow with a drive
Reached reached(const Flow& flow, State start);

/// The demands on a start: two of the three numbers of Reached, each >= 0.
struct Aim {
  std::optional<double> tau, distance, turned;
};

/// Thrown if no start with finite doubles fulfils both demands to 1e-6.
struct TooFarApart : std::domain_error {
  using std::domain_error::domain_error;
};

/// Tests the hypothesis of (R59) and (R60): the force Phi does not fall and the moment Psi does not grow with k.
///
/// The test takes 276 ratios from 1e-6 to 1e6, to a relative 1e-6. Coulomb friction under any pressure and all named
/// laws pass, because their Phi and Psi are derivatives of a convex function.
/// @throws std::domain_error  if Phi or Psi fails; the message names the function and k
void require_monotone(const Law& law);

/// Returns the least stop time with a given distance (pure sliding) or a given angle (pure pivoting),
/// reduction/README.md (R60).
/// @param aim  its tau is ignored; if distance and turned are both given, distance counts
/// @throws std::domain_error  for a flow with a drive; unless two demands are given, finite and not negative
double least_time(const Flow& flow, const Aim& aim);

/// Finds the one start with u, v >= 0 that fulfils the two demands, by a root in ln k and a scale factor (R59), (R60).
/// @return empty if no start does: if and only if the stop time demanded is below least_time
/// @throws std::domain_error  unless two demands are given, finite and >= 0; with a drive; as require_monotone
/// @throws TooFarApart        if the best start misses a demand by more than 1e-6, relative
///
/// Accuracy  the start fulfils each demand to 1e-13.
/// Cost      about 15 orbits.
std::optional<State> aimed(const Flow& flow, const Aim& aim);

}  // namespace contensou::reduction
