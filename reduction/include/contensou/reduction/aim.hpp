#pragma once

#include <optional>
#include <stdexcept>

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// Time, distance and angle of a motion from its start to its stop, in the units of Orbit.
struct Reached {
  double tau;       ///< the time tau of ReducedSystem
  double distance;  ///< length of the centre's path, the integral of the centre's speed over tau; unit: speed squared
  double turned;    ///< the integral of |u| over tau; unit: speed squared
};

/// Returns time, distance and angle until the stop for a body that begins without rolling. The centre moves along the
/// slip at the speed V = (1 - 1/chi) v0 + v/chi. chi is Inertia::chi; v is the sliding speed, at the start v0.
/// @throws std::domain_error  if start is not a state, as Flow::orbit; if the flow has a drive
Reached reached(const Flow& flow, State start);

/// Two of the three numbers of Reached, each >= 0, that the motion from a start must have.
struct Aim {
  std::optional<double> tau, distance, turned;
};

/// Thrown if no start with finite doubles fulfils both demands to 1e-6.
struct TooFarApart : std::domain_error {
  using std::domain_error::domain_error;
};

/// Tests the hypothesis of (R36) and (R37): with growing k = v/(mu |u|), Phi does not fall and Psi does not grow.
///
/// The test takes 276 values of k from 1e-6 to 1e6 and ignores relative changes below 1e-6. Coulomb friction under any
/// pressure and all named laws pass, because their Phi and Psi are derivatives of a convex function.
/// @throws std::domain_error  if Phi falls or Psi grows; the message names the function and both k
void require_monotone(const Law& law);

/// Returns the shortest stop time of all motions with a given distance or a given angle, numerics.md (R37). For
/// a distance it is the time of pure sliding; for an angle, the time of pure pivoting.
/// @param aim  aim.tau is ignored; if distance and turned are both given, the distance is used
/// @throws std::domain_error  if the flow has a drive, or unless aim contains two demands, both finite and >= 0
double least_time(const Flow& flow, const Aim& aim);

/// Finds the one start with u, v >= 0 that fulfils the two demands, by a root in ln k and a scale factor (R36), (R37).
/// @return the start; empty if and only if the demanded stop time is below least_time
/// @throws std::domain_error  unless aim contains two demands, both finite and >= 0; for a drive; as require_monotone
/// @throws TooFarApart        if the best start misses a demand by more than 1e-6, relative
///
/// Accuracy  the start fulfils each demand to 1e-13.
/// Cost      about 15 orbits.
std::optional<State> aimed(const Flow& flow, const Aim& aim);

}  // namespace contensou::reduction
