#pragma once

#include "contensou/si/motion_point.hpp"

namespace contensou::si {

/// The uncoupled model's rolling friction: from the instant when it rolls, a ball rolls without slip along a straight line,
/// slows down at a = u_r g and rests. Where friction f g is less than a, it cannot: it slows down at f g, its turning at
/// chi a - (chi - 1) f g, and it slides (reduction/README.md, (R53)). Its spin about the vertical is that of the motion
/// without rolling friction.
class RollingFriction {
 public:
  /// @param rolls         the instant when the ball rolls
  /// @param deceleration  u_r g, m/s^2, > 0
  /// @param most          f g, m/s^2: as much as friction can slow it down
  /// @throws std::domain_error  unless the deceleration is positive and finite
  RollingFriction(const Ball& ball, const MotionPoint& rolls, double deceleration, double most);

  /// s from the start until the ball rolls.
  double start() const { return rolls_.t; }

  /// s from the start until the centre rests.
  double rest_time() const { return rolls_.t + speed_ / deceleration_; }

  /// m, where it rests.
  Eigen::Vector2d rest_position() const { return rolls_.position + way() * direction_; }

  /// m from where it rolls.
  double way() const { return speed_ * speed_ / (2 * deceleration_); }

  /// m, the integral of R |omega| from there on.
  double rolled() const { return speed_ * speed_ / (2 * turning_); }

  /// Returns the s from the start after which it slides no faster than that many m/s.
  double slip_time(double speed) const;

  /// m that the contact point slides after that instant.
  double slip_length() const { return way() - rolled(); }

  /// Returns the same instant with rolling friction.
  /// @param free  without it
  MotionPoint operator()(MotionPoint free) const;

 private:
  Ball ball_;
  MotionPoint rolls_;
  double deceleration_, turning_;  ///< m/s^2, of the centre, of R omega
  double speed_;                   ///< when it rolls
  Eigen::Vector2d direction_;
};

}  // namespace contensou::si
