#include "rolling_friction.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::si {

RollingFriction::RollingFriction(const Ball& ball, const MotionPoint& rolls, double deceleration, double most)
    : ball_(ball),
      rolls_(rolls),
      deceleration_(std::min(deceleration, most)),
      turning_(deceleration_ + ball.body.inertia.chi * (deceleration - deceleration_)),
      speed_(rolls.velocity.norm()),
      direction_(speed_ > 0 ? Eigen::Vector2d(rolls.velocity / speed_) : Eigen::Vector2d::Zero()) {
  if (!(deceleration > 0 && std::isfinite(deceleration))) {
    throw std::domain_error(fmt::format("RollingFriction: deceleration > 0 is required, got {}", deceleration));
  }
}

double RollingFriction::slip_time(double speed) const {
  // The slip grows until the ball turns no more, and then is its speed.
  const double most = speed_ * (1 - deceleration_ / turning_);
  return most > speed ? rest_time() - speed / deceleration_ : rolls_.t;
}

MotionPoint RollingFriction::operator()(MotionPoint free) const {
  if (free.t <= rolls_.t) return free;
  const double whole = speed_ / deceleration_;
  const double braked = std::min(free.t - rolls_.t, whole);
  const double speed = braked < whole ? speed_ - deceleration_ * braked : 0;
  const double rolling = turning_ == deceleration_ ? speed : std::max(0.0, speed_ - turning_ * braked);
  const Eigen::Vector2d still = Eigen::Vector2d::Zero();  // added so that no -0 is left
  const Eigen::Vector2d rim = rolling * direction_ + still;
  free.position = rolls_.position + (speed_ + speed) / 2 * braked * direction_;
  free.velocity = speed * direction_ + still;
  free.angular_velocity.head<2>() = Eigen::Vector2d(0 - rim.y(), rim.x()) / ball_.radius;
  free.slip = speed - rolling;
  free.energy = kinetic_energy(ball_, {free.velocity, free.angular_velocity});
  return free;
}

}  // namespace contensou::si
