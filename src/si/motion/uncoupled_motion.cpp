#include <algorithm>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/scaling.hpp"
#include "solution.hpp"

namespace contensou::si {

namespace {

using Eigen::Vector2d;

/// The motion of the uncoupled model. A ball with rolling friction first slides. Then it rolls without slip along a
/// straight line, slows down at a = u_r g and comes to rest. If the friction f g is less than a, the ball cannot roll:
/// its centre slows down at f g, its turning at chi a - (chi - 1) f g, and it slides (reduction/theory.md, (R21)). The
/// spin is not affected.
class Uncoupled final : public Motion::Solution {
 public:
  Uncoupled(const Experiment& of, const reduction::Law& law, double rolling_below) : Solution(of) {
    const reduction::ReducedSystem system = undriven_system(of, law);
    const reduction::State start = reduced_start(of);
    slip_end_ = seconds(of, system.sliding_limit(start.v));
    spin_end_ = seconds(of, system.pivoting_limit(start.u));
    const double g = of.environment.gravity, a = of.contact.rolling_friction * g;
    if (of.environment.slope != 0) {
      SharedFlows flows;
      on_slope_ = resisted_motion(without_spin(of), reduction::HertzLaw{}, flows);
    } else if (a != 0) {
      rolls_ = free(free_slip_time(rolling_below));
      speed_ = rolls_->velocity.norm();
      slowing_ = std::min(a, of.contact.friction * g);
      turning_ = slowing_ + of.ball.body.inertia.chi * (a - slowing_);
    }
  }

  MotionPoint at(double t) const override {
    if (on_slope_) {
      MotionPoint point = on_slope_->at(t);
      point.angular_velocity.z() = spin(t);
      point.energy = kinetic_energy(experiment.ball, {point.velocity, point.angular_velocity});
      return point;
    }
    return rolls_ && t > rolls_->t ? slowed(free(t)) : free(t);
  }

  double stop_time() const override { return std::max({slip_end_, spin_end_, slip_time(0)}); }
  double spin_end() const override { return spin_end_; }
  double slip_time(double speed) const override {
    if (on_slope_) return on_slope_->slip_time(speed);
    if (!rolls_) return free_slip_time(speed);
    // The slip grows until the ball no longer turns. Then the slip is the speed of the ball.
    const double most = speed_ * (1 - slowing_ / turning_);
    return most > speed ? rest_time() - speed / slowing_ : rolls_->t;
  }
  double slip_length() const override {
    if (on_slope_) return on_slope_->slip_length();
    const double sliding = slip_at_start(experiment) * slip_end_ / 2;
    return rolls_ ? sliding + (way() - rolled()) : sliding;
  }
  double spin_angle() const override { return spin_at_start(experiment) * spin_end_ / 2; }
  double path_length(double t) const override {
    if (on_slope_) return on_slope_->path_length(t);
    if (!rolls_ || t <= rolls_->t) return Solution::path_length(t);
    return Solution::path_length(rolls_->t) + (at(t).position - rolls_->position).stableNorm();
  }
  std::optional<Event> rest() const override {
    if (on_slope_) return on_slope_->rest();
    return rolls_ ? std::optional(Event{rest_time(), rolls_->position + way() * direction()}) : std::nullopt;
  }
  Velocities final_motion() const override {
    if (!is_driven(experiment)) return Solution::final_motion();
    const MotionPoint end = at(stop_time());
    return {end.velocity, end.angular_velocity};
  }
  double rolled() const override {
    return on_slope_ ? on_slope_->rolled() : rolls_ ? speed_ * speed_ / (2 * turning_) : 0;
  }

 private:
  double free_slip_time(double speed) const {
    const double v0 = slip_at_start(experiment);
    return v0 > speed ? slip_end_ * (1 - speed / v0) : 0;
  }

  double spin(double t) const { return t < spin_end_ ? spin_at_start(experiment) * (1 - t / spin_end_) : 0; }

  /// Returns the state without rolling friction on a level plane.
  MotionPoint free(double t) const {
    const double v0 = slip_at_start(experiment);
    const bool slides = t < slip_end_;
    const double slip = slides ? v0 * (1 - t / slip_end_) : 0;
    const double slip_length = slides ? (v0 + slip) / 2 * t : v0 / 2 * slip_end_;
    return motion_by_slip(experiment, t, slip, slip_length, spin(t));
  }

  double rest_time() const { return rolls_->t + speed_ / slowing_; }
  double way() const { return speed_ * speed_ / (2 * slowing_); }
  Vector2d direction() const { return speed_ > 0 ? Vector2d(rolls_->velocity / speed_) : Vector2d(0, 0); }

  /// Returns the state with rolling friction, computed from the state without rolling friction.
  MotionPoint slowed(MotionPoint point) const {
    const double whole = speed_ / slowing_, braked = std::min(point.t - rolls_->t, whole);
    const double speed = braked < whole ? speed_ - slowing_ * braked : 0;
    const double rolling = turning_ == slowing_ ? speed : std::max(0.0, speed_ - turning_ * braked);
    const Vector2d still = Vector2d::Zero();  // adding it avoids -0
    const Vector2d rim = rolling * direction() + still;
    point.position = rolls_->position + (speed_ + speed) / 2 * braked * direction();
    point.velocity = speed * direction() + still;
    point.angular_velocity.head<2>() = Vector2d(0 - rim.y(), rim.x()) / experiment.ball.radius;
    point.slip = speed - rolling;
    point.energy = kinetic_energy(experiment.ball, {point.velocity, point.angular_velocity});
    return point;
  }

  double slip_end_, spin_end_;        ///< times without resistance, s
  SolvedMotion on_slope_;             ///< motion of the ball without spin
  std::optional<MotionPoint> rolls_;  ///< state at which rolling friction begins to act
  double speed_ = 0;                  ///< speed of the centre in that state
  double slowing_ = 0, turning_ = 0;  ///< decelerations of the centre and of R omega, m/s^2
};

}  // namespace

SolvedMotion uncoupled_motion(const Experiment& experiment, const reduction::Law& law, double rolling_below) {
  return std::make_shared<Uncoupled>(experiment, law, rolling_below);
}

}  // namespace contensou::si
