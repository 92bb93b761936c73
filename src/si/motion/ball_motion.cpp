#include "contensou/si/ball_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/si/scaling.hpp"

namespace contensou::si {

BallMotion::BallMotion(const Experiment& experiment, const reduction::Law& law)
    : BallMotion(experiment, reduction::Flow(undriven_system(experiment, law))) {}

BallMotion::BallMotion(const Experiment& experiment, const reduction::Flow& flow)
    : experiment_(experiment),
      law_(flow.system().law()),
      orbit_(flow.orbit(reduced_start(experiment))),
      stop_(seconds(experiment, orbit_.stop_time())),
      scale_(1 / seconds(experiment, 1)) {
  if (!std::isfinite(stop_)) throw std::runtime_error("the stop time exceeds the largest double");
}

double BallMotion::paper_time(double t) const { return t >= stop_ ? orbit_.stop_time() : t * scale_; }

MotionPoint BallMotion::at_time(double t) const {
  if (!(t >= 0)) throw std::domain_error(fmt::format("BallMotion::at_time: t must be >= 0, in s; got {}", t));
  const reduction::Orbit::Instant at = orbit_.instant(paper_time(t));
  return motion_by_slip(experiment_, t, at.v, seconds(experiment_, at.slip_length), at.u / experiment_.ball.radius);
}

MotionColumns BallMotion::at_times(const Eigen::ArrayXd& times) const {
  MotionColumns columns(times.size());
  for (Eigen::Index i = 0; i < times.size(); ++i) columns.set(i, at_time(times[i]));
  return columns;
}

double BallMotion::slip_time(double speed) const {
  if (!(speed >= 0))
    throw std::domain_error(fmt::format("BallMotion::slip_time: speed >= 0 is required, got {}", speed));
  return seconds(experiment_, orbit_.time_of_v(speed));
}

double BallMotion::spin_time(double speed) const {
  if (!(speed >= 0))
    throw std::domain_error(fmt::format("BallMotion::spin_time: speed >= 0 is required, got {}", speed));
  return seconds(experiment_, orbit_.time_of_u(speed * experiment_.ball.radius));
}

double BallMotion::slip_length() const { return seconds(experiment_, orbit_.slip_length(orbit_.stop_time())); }

double BallMotion::spin_angle() const {
  return seconds(experiment_, orbit_.instant(orbit_.stop_time()).turned) / experiment_.ball.radius;
}

double BallMotion::path_length(double t) const {
  if (!(t >= 0)) throw std::domain_error(fmt::format("BallMotion::path_length: t must be >= 0, in s; got {}", t));
  // V is a linear function of the slip (motion_by_slip); where |V| is least, it may have a kink.
  const double v0 = slip_at_start(experiment_);
  const double spin = spin_at_start(experiment_);
  const auto velocity = [&](double v) { return motion_by_slip(experiment_, 0, v, 0, spin).velocity; };
  const Eigen::Vector2d last = velocity(0);
  const Eigen::Vector2d change = velocity(v0) - last;
  const auto speed = [&](double v) { return (last + change * (v0 > 0 ? v / v0 : 0)).norm(); };
  const double slowest = change.squaredNorm() > 0 ? -last.dot(change) / change.squaredNorm() * v0 : 0;
  constexpr double straight = 1e-12;
  if (std::abs(last.x() * change.y() - last.y() * change.x()) <= straight * last.norm() * change.norm()) {
    // Forth, and perhaps back from where it stands for an instant.
    const Eigen::Vector2d there = at_time(slowest > 0 && slowest < v0 ? std::min(slip_time(slowest), t) : 0).position;
    return there.norm() + (at_time(t).position - there).norm();
  }
  return seconds(experiment_, orbit_.integral(speed, paper_time(t), {slowest})) +
         last.norm() * std::max(0.0, t - stop_);
}

}  // namespace contensou::si
