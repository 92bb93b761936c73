#pragma once

#include <Eigen/Core>

#include "contensou/si/shot.hpp"

namespace contensou::si {

/// How a ball moves once it neither slides nor spins: it rolls on.
struct FinalMotion {
  Eigen::Vector2d velocity;          ///< m/s, of the centre; x along the initial slip
  Eigen::Vector3d angular_velocity;  ///< 1/s; z up
};

/// The rolling that a shot ends in: 5/7 of the initial slip, under any friction law.
///
/// The contact point keeps 7 R omega_y + 5 v as a first integral (Zh98 after (2.5)): R omega_y grows from 0 to 5 v0/7
/// and the centre slows down from v0 by 2 v0/7.
FinalMotion final_motion(const Shot& shot);

}  // namespace contensou::si
