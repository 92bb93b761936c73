#pragma once

#include "contensou/si/motion_point.hpp"

namespace contensou::si {

/// How a ball comes down on the plane, and goes up again.
struct Impact {
  double normal_speed;  ///< v_n, m/s, > 0: towards the plane
  double restitution;   ///< e, 0 to 1: it goes up again at e v_n

  /// (1 + e) v_n, m/s: the impulse of the plane along the normal, over the mass.
  double impulse() const { return (1 + restitution) * normal_speed; }
};

/// m/s, sqrt(2 g h): how fast a body comes down that was let go with its lowest point h above the plane.
/// @param height   h, m, >= 0
/// @param gravity  g, m/s^2
double drop_speed(double height, double gravity);

/// The patch of an elastic ball in an impact, as a mean over the normal impulse, in m: B(1/2, 6/5)/2 = 0.89552 of the widest, a,
/// for which m v^2/2 = (8/15) E* a^5/R'^2 (Hertz 1882). While w v of the normal speed v is left, the patch is
/// (1 - w^2)^(1/5) a, and the impulse is m (1 - w) v.
///
/// @param mass    m, kg
/// @param speed   v, m/s, along the normal
/// @param radius  R, m
/// @throws std::domain_error  as hertz_patch_radius
double hertz_impact_patch_radius(double mass, double speed, double radius, const HertzModuli& moduli);

/// A ball as it leaves the plane.
struct Rebound {
  Velocities velocities;  ///< of the centre along the plane; angular velocity, z up
  double slip;            ///< m/s, that is left
  double grip;            ///< after which part of the impulse it rolls; above 1 it leaves the plane before
};

/// The experiment whose time in s is the impulse over the mass in m/s, with the patch that the whole impact has. That is the contact's
/// own, which does not know of the impact: of a spin deceleration that of rest; but of Hertz's moduli the mean over the impulse
/// (hertz_impact_patch_radius).
/// @throws std::domain_error  unless v_n > 0 and 0 <= e <= 1; as require_experiment and patch_radius_of
Experiment pressed_in(const Impact& impact, const Experiment& experiment, const reduction::Law& law);

/// A ball that hits the plane at a slant, sliding and spinning. The friction of a patch is in proportion to the load,
/// so that slip and spin go through the states of a sliding ball (Motion::reduced) with the normal impulse in the place of time,
/// however the load rises and falls. Rigid bodies; the patch does not change during the impact and does not roll or
/// yield sideways, and gravity counts for nothing beside the impact.
///
/// @param experiment     its start is what the ball does when it touches the plane
/// @param rolling_below  m/s, >= 0: a slip from which on it rolls; 0: none, which a ball that spins does not reach before its spin ends
/// @throws std::domain_error  as pressed_in and Motion::reduced
Rebound bounce(const Experiment& experiment, const reduction::Law& law, const Impact& impact,
               double rolling_below = rolling_slip);

/// The textbook's: the slip falls by chi f (1 + e) v_n, or ends, and the velocity of the centre by 1/chi of that, f (1 + e) v_n or,
/// of a homogeneous ball, 2/7 of the slip; spin about the vertical falls by itself (Motion::uncoupled).
Rebound uncoupled_bounce(const Experiment& experiment, const reduction::Law& law, const Impact& impact,
                         double rolling_below = rolling_slip);

}  // namespace contensou::si
