#pragma once

#include "contensou/si/motion.hpp"

namespace contensou::si {

/// The textbook's rolling friction: from the instant when it rolls, a ball rolls without slip along a straight line, slows down at u_r
/// g and rests. Its spin about the vertical is that of the motion without it.
class RollingFriction {
 public:
  /// @param rolls         the instant when the ball rolls
  /// @param deceleration  u_r g, m/s^2, > 0
  /// @throws std::domain_error  unless that is positive and finite
  RollingFriction(const Ball& ball, const MotionPoint& rolls, double deceleration);

  /// s from the start until the centre rests.
  double rest_time() const { return rolls_.t + speed_ / deceleration_; }

  /// m, where it rests.
  Eigen::Vector2d rest_position() const { return rolls_.position + speed_ * speed_ / (2 * deceleration_) * direction_; }

  /// The same instant with rolling friction.
  /// @param free  without it
  MotionPoint operator()(MotionPoint free) const;

 private:
  Ball ball_;
  MotionPoint rolls_;
  double deceleration_;
  double speed_;  ///< when it rolls
  Eigen::Vector2d direction_;
};

}  // namespace contensou::si
