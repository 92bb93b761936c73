#pragma once

#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/motion.hpp"

namespace contensou::si {

/// What the integration of the equations of motion gives.
struct IntegratedMotion {
  MotionColumns points;
  double stop_time = 0;    ///< s
  double slip_length = 0;  ///< m, until the stop
  double spin_angle = 0;   ///< rad about the vertical, until the stop
  long steps = 0;
};

/// The equations of motion (2.5) of a ball, or of a body that lies flat, under any friction law, with its position, integrated in SI by
/// Cash-Karp 5(4): a route of its own, that knows neither the reduction nor the first integrals.
///
/// Force and torque act on the Cartesian velocities; the step is made in omega_x, omega_y, the position and, in place
/// of the velocity of the contact point and of omega_z, in ln v, the direction of v and ln |omega_z|, as Zh98 does
/// before (2.6): these cannot step through the stop. Once one friction is all there is, the tail is closed with its
/// exact limit; beyond the stop the ball rolls.
///
/// @param times  s, >= 0, in any order
/// @throws std::domain_error   as require_experiment, and if a time is negative or not finite
/// @throws std::runtime_error  if the integration does not reach the stop
///
/// Accuracy  1e-12 of the scales of the motion for mu from 1e-3 to 1.
IntegratedMotion integrate_motion(const Experiment& experiment, const reduction::Law& law, const Eigen::ArrayXd& times);

}  // namespace contensou::si
