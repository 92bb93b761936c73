#include <algorithm>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/si/scaling.hpp"
#include "rolling_friction.hpp"
#include "solution.hpp"

namespace contensou::si {

namespace {

/// Sliding and pivoting that do not know of each other.
class Uncoupled final : public Motion::Solution {
 public:
  Uncoupled(const Experiment& of, const reduction::Law& law, double rolling_below) : Solution(of) {
    const reduction::ReducedSystem system = undriven_system(of, law);
    const reduction::State start = reduced_start(of);
    slip_end_ = seconds(of, system.sliding_limit(start.v));
    spin_end_ = seconds(of, system.pivoting_limit(start.u));
    const double g = of.environment.gravity, u_r = of.contact.rolling_friction;
    if (of.environment.slope != 0) {
      SharedFlows flows;
      on_slope_ = resisted_motion(without_spin(of), reduction::HertzLaw{}, flows);
    } else if (u_r != 0) {
      friction_.emplace(of.ball, free(free_slip_time(rolling_below)), u_r * g, of.contact.friction * g);
    }
  }

  MotionPoint at(double t) const override {
    if (friction_) return (*friction_)(free(t));
    if (!on_slope_) return free(t);
    MotionPoint point = on_slope_->at(t);
    point.angular_velocity.z() = spin(t);
    point.energy = kinetic_energy(experiment.ball, {point.velocity, point.angular_velocity});
    return point;
  }

  double stop_time() const override { return std::max({slip_end_, spin_end_, slip_time(0)}); }
  double spin_end() const override { return spin_end_; }
  double slip_time(double speed) const override {
    return on_slope_ ? on_slope_->slip_time(speed) : friction_ ? friction_->slip_time(speed) : free_slip_time(speed);
  }
  double slip_length() const override {
    if (on_slope_) return on_slope_->slip_length();
    return slip_at_start(experiment) * slip_end_ / 2 + (friction_ ? friction_->slip_length() : 0);
  }
  double spin_angle() const override { return spin_at_start(experiment) * spin_end_ / 2; }
  double path_length(double t) const override {
    if (on_slope_) return on_slope_->path_length(t);
    if (!friction_ || t <= friction_->start()) return Solution::path_length(t);
    const double free = friction_->start();
    return Solution::path_length(free) + (at(t).position - at(free).position).norm();
  }
  std::optional<Event> rest() const override {
    if (on_slope_) return on_slope_->rest();
    return friction_ ? std::optional(Event{friction_->rest_time(), friction_->rest_position()}) : std::nullopt;
  }
  Velocities final_motion() const override {
    const MotionPoint end = at(stop_time());
    return is_driven(experiment) ? Velocities{end.velocity, end.angular_velocity} : Solution::final_motion();
  }
  double rolled() const override { return on_slope_ ? on_slope_->rolled() : friction_ ? friction_->rolled() : 0; }

 private:
  double free_slip_time(double speed) const {
    const double v0 = slip_at_start(experiment);
    return v0 > speed ? slip_end_ * (1 - speed / v0) : 0;
  }

  double spin(double t) const { return t < spin_end_ ? spin_at_start(experiment) * (1 - t / spin_end_) : 0; }

  /// Without rolling friction, on a level plane.
  MotionPoint free(double t) const {
    const double v0 = slip_at_start(experiment);
    const bool slides = t < slip_end_;
    const double slip = slides ? v0 * (1 - t / slip_end_) : 0;
    const double slip_length = slides ? (v0 + slip) / 2 * t : v0 / 2 * slip_end_;
    return motion_by_slip(experiment, t, slip, slip_length, spin(t));
  }

  double slip_end_, spin_end_;  ///< s, where nothing resists
  std::optional<RollingFriction> friction_;
  SolvedMotion on_slope_;
};

}  // namespace

SolvedMotion uncoupled_motion(const Experiment& experiment, const reduction::Law& law, double rolling_below) {
  return std::make_shared<Uncoupled>(experiment, law, rolling_below);
}

}  // namespace contensou::si
