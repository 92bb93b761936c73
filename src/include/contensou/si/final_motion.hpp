#pragma once

#include <Eigen/Core>

#include "contensou/si/shot.hpp"

namespace contensou::si {

/// How a ball moves once it neither slides nor spins: it rolls on.
struct FinalMotion {
  Eigen::Vector2d velocity;          ///< m/s, of the centre
  Eigen::Vector3d angular_velocity;  ///< 1/s; z up
};

/// The rolling that a shot ends in, under any friction law, in the axes of the start (x along the initial slip for
/// SlipAndSpin).
///
/// With the axis x along the slip v, 7 R omega_y + 5 v is a first integral (Zh98 after (2.5)): R omega_y grows by 5
/// v0/7, and the velocity of the centre along the slip falls by 2 v0/7.
FinalMotion final_motion(const Shot& shot);

}  // namespace contensou::si
