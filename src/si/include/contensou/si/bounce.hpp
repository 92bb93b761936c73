#pragma once

#include "contensou/si/motion_point.hpp"

namespace contensou::si {

/// The normal motion of a ball that hits the plane and rebounds.
struct Impact {
  double normal_speed;  ///< v_n towards the plane, m/s, > 0
  double restitution;   ///< coefficient of restitution e, 0 to 1: the ball rebounds at e v_n

  /// Returns (1 + e) v_n, m/s: the normal impulse of the plane divided by the mass.
  double impulse() const { return (1 + restitution) * normal_speed; }
};

/// Returns the normal speed sqrt(2 g h), m/s, of a body released with its lowest point at the height h.
/// @param height   h, m, >= 0
/// @param gravity  g, m/s^2
double drop_speed(double height, double gravity);

/// Returns the patch radius, in m, of an elastic ball in an impact: the mean radius over the normal impulse.
///
/// The mean is B(1/2, 6/5)/2 = 0.89552 (beta function B) of the largest radius a. m v^2/2 = (8/15) E* a^5/R'^2 gives a
/// (H. Hertz, J. reine angew. Math. 92 (1882) 156, doi:10.1515/crll.1882.92.156); E* and R' as in hertz_patch_radius.
/// At the normal speed w v the radius is (1 - w^2)^(1/5) a, and the impulse so far is m (1 - w) v.
///
/// @param mass    m, kg
/// @param speed   v, m/s, along the normal
/// @param radius  R, m
/// @throws std::domain_error  as hertz_patch_radius
double hertz_impact_patch_radius(double mass, double speed, double radius, const HertzModuli& moduli);

/// The motion of a ball that leaves the plane.
struct Rebound {
  Velocities velocities;  ///< velocity of the centre along the plane; angular velocity, z up
  double slip;            ///< slip that remains, m/s
  double grip;            ///< share of the impulse after which the ball rolls; above 1 the ball leaves before it rolls
};

/// Returns the experiment whose time in s is the normal impulse so far, divided by the mass, in m/s; the impact ends at
/// (1 + e) v_n. Its patch is constant: hertz_impact_patch_radius if Hertz's moduli are given, else the patch at rest.
/// @throws std::domain_error  unless v_n > 0 and 0 <= e <= 1; as require_experiment and patch_radius_of
Experiment pressed_in(const Impact& impact, const Experiment& experiment, const reduction::Law& law);

/// Computes the rebound of a ball that hits the plane obliquely, sliding and spinning.
///
/// The friction of a patch is proportional to the load. Slip and spin therefore pass through the states of a sliding
/// ball (Motion::reduced), with the normal impulse in place of time, no matter how the load varies. The bodies are
/// rigid. The patch is constant, does not roll and does not yield sideways. Gravity is negligible during the impact.
///
/// @param experiment     its start is the motion at the first contact
/// @param rolling_below  slip below which the ball rolls, m/s, >= 0; with 0 it rolls when its spin ends
/// @throws std::domain_error  as pressed_in and Motion::reduced
Rebound bounce(const Experiment& experiment, const reduction::Law& law, const Impact& impact,
               double rolling_below = rolling_slip);

/// Computes the rebound under the uncoupled model (Motion::uncoupled). The slip falls by chi f (1 + e) v_n, but not
/// below 0. The velocity of the centre falls by 1/chi of the lost slip: by f (1 + e) v_n, or, if the slip ends, by 2/7
/// of the slip for a homogeneous ball. The spin about the vertical falls independently.
Rebound uncoupled_bounce(const Experiment& experiment, const reduction::Law& law, const Impact& impact,
                         double rolling_below = rolling_slip);

}  // namespace contensou::si
