#include "contensou/si/rolling_friction.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::si {

RollingFriction::RollingFriction(const Ball& ball, const MotionPoint& rolls, double deceleration)
    : ball_(ball),
      rolls_(rolls),
      deceleration_(deceleration),
      speed_(rolls.velocity.norm()),
      direction_(speed_ > 0 ? Eigen::Vector2d(rolls.velocity / speed_) : Eigen::Vector2d::Zero()) {
  if (!(deceleration > 0 && std::isfinite(deceleration))) {
    throw std::domain_error(fmt::format("RollingFriction: deceleration > 0 is required, got {}", deceleration));
  }
}

MotionPoint RollingFriction::operator()(MotionPoint free) const {
  if (free.t <= rolls_.t) return free;
  const double whole = speed_ / deceleration_;
  const double rolled = std::min(free.t - rolls_.t, whole);
  const double speed = rolled < whole ? speed_ - deceleration_ * rolled : 0;
  free.position = rolls_.position + (speed_ + speed) / 2 * rolled * direction_;
  free.velocity = speed * direction_ + Eigen::Vector2d::Zero();  // no -0
  free.angular_velocity.head<2>() = Eigen::Vector2d(0 - free.velocity.y(), free.velocity.x()) / ball_.radius;
  free.slip = 0;
  free.energy = kinetic_energy(ball_, {free.velocity, free.angular_velocity});
  return free;
}

}  // namespace contensou::si
