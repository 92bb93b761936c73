#pragma once

#include <string_view>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::si {

/// A limit of an engine's contact for the friction force F and the moment M about the normal. Alone, F may reach F0 = f
/// N and M may reach M0 = c N, with the load N and a length c. Cones are models for comparison, not friction laws:
/// except the ellipse and the points, they are not functions of v/|omega|.
enum class Cone {
  elliptic,  ///< (F/F0)^2 + (M/M0)^2 <= 1
  box,       ///< F <= F0, M <= M0: slip and spin are independent
  pyramid,   ///< F/F0 + M/M0 <= 1
  points,    ///< points at c/f from the middle, friction f times their load; the mean over a turn is the law ring
};

std::string_view name(Cone cone);

/// FadeTimes counts slip or spin as ended when it has fallen to this share of its value at the start. In an engine
/// neither becomes exactly 0.
inline constexpr double faded = 1e-3;

/// Times and lengths until slip and spin end.
struct FadeTimes {
  double slip;         ///< time until the slip has fallen to `faded` of its value at the start, s; 0 without slip
  double spin;         ///< time until the spin has fallen to this share, s; infinity for never
  double slip_length;  ///< length that the contact point slides until the stop, m; for a body that lies flat, the path
  double turns;        ///< turns about the vertical until the stop; infinity for never
};

/// Computes the times under a friction law.
/// @throws std::domain_error  as require_experiment and patch_radius_of
FadeTimes fade_times(const Experiment& experiment, const reduction::Law& law);

/// Computes the times under a cone. The contact exerts the force and moment of the cone that dissipate most.
///
/// @param moment_arm  c in m, >= 0: the largest moment divided by the load; for 0 the spin never ends
/// @throws std::domain_error  as require_experiment, or if moment_arm is negative or not a finite number
FadeTimes fade_times(const Experiment& experiment, Cone cone, double moment_arm);

/// Returns slip v and spin omega under Cone::pyramid. One of them falls alone until v = c/f |omega|; then both fall.
///
/// @param moment_arm  c in m, > 0
/// @param t           time, s, >= 0
SlipAndSpin speeds_under_pyramid(const Experiment& experiment, double moment_arm, double t);

}  // namespace contensou::si
