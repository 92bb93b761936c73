#pragma once

#include <string_view>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::si {

/// What the friction force F and the moment M about the normal of an engine's contact may be at once, where each alone
/// may reach F0 = f N and M0 = c N (N the load, c a length). Comparison models, not friction laws: but for the ellipse and
/// the points, they are not functions of v/|omega|.
enum class Cone {
  elliptic,  ///< (F/F0)^2 + (M/M0)^2 <= 1
  box,       ///< F <= F0, M <= M0: the slip and the spin do not know of each other
  pyramid,   ///< F/F0 + M/M0 <= 1
  points,    ///< points at c/f from the middle, friction f times its load at each: averaged over a turn, the law ring
};

std::string_view name(Cone cone);

/// The share of slip and spin at which FadeTimes count them as ended: an engine's never end to the last digit.
inline constexpr double faded = 1e-3;

/// Until when and how far a body slides and spins.
struct FadeTimes {
  double slip;         ///< s until it has fallen to `faded` of what it was at the start; 0 for what was 0
  double spin;         ///< s, likewise; infinity for never
  double slip_length;  ///< m that the contact slides until it has stopped, of a body that lies flat its path
  double turns;        ///< about the vertical until it has stopped; infinity for never
};

/// Under a friction law.
/// @throws std::domain_error  as require_experiment and patch_radius_of
FadeTimes fade_times(const Experiment& experiment, const reduction::Law& law);

/// Under a cone, of whose forces the one that dissipates most acts.
///
/// @param moment_arm  c in m, >= 0: the greatest moment over the load; 0: the spin never ends
/// @throws std::domain_error  as require_experiment, or if moment_arm is negative or not a finite number
FadeTimes fade_times(const Experiment& experiment, Cone cone, double moment_arm);

/// Slip and spin at an instant under Cone::pyramid: either alone until v = c/f |omega|, then both together.
///
/// @param moment_arm  c in m, > 0
/// @param t           s, >= 0
SlipAndSpin speeds_under_pyramid(const Experiment& experiment, double moment_arm, double t);

}  // namespace contensou::si
