#include <algorithm>
#include <cmath>

#include "contensou/si/scaling.hpp"
#include "solution.hpp"

namespace contensou::si {

namespace {

/// A motion without a drive, from the similarity solution. Slip and spin are one orbit of the reduced system.
class OneOrbit final : public Motion::Solution {
 public:
  OneOrbit(const Experiment& of, reduction::Flow flow)
      : Solution(of),
        flow_(std::move(flow)),
        orbit_(flow_.orbit(reduced_start(of))),
        stop_(seconds(of, orbit_.stop_time())),
        scale_(1 / seconds(of, 1)) {}

  MotionPoint at(double t) const override {
    const reduction::Orbit::Instant now = orbit_.instant(paper_time(t));
    return motion_by_slip(experiment, t, now.v, seconds(experiment, now.slip_length), now.u / experiment.ball.radius);
  }

  double stop_time() const override { return stop_; }
  double slip_time(double speed) const override { return seconds(experiment, orbit_.time_of_v(speed)); }
  double spin_time(double speed) const override {
    return seconds(experiment, orbit_.time_of_u(speed * experiment.ball.radius));
  }
  double slip_length() const override { return seconds(experiment, orbit_.slip_length(orbit_.stop_time())); }
  double spin_angle() const override {
    return seconds(experiment, orbit_.instant(orbit_.stop_time()).turned) / experiment.ball.radius;
  }
  bool is_reduced() const override { return true; }
  std::vector<ReducedPiece> pieces() const override { return {{0, true, flow_, reduced_start(experiment), orbit_}}; }

  double path_length(double t) const override {
    // V is a linear function of the slip (motion_by_slip). The speed |V| may have a kink at its minimum.
    const double v0 = slip_at_start(experiment);
    const double spin = spin_at_start(experiment);
    const auto velocity = [&](double v) { return motion_by_slip(experiment, 0, v, 0, spin).velocity; };
    const Eigen::Vector2d last = velocity(0);
    const Eigen::Vector2d change = velocity(v0) - last;
    const auto speed = [&](double v) { return (last + change * (v0 > 0 ? v / v0 : 0)).norm(); };
    const double slowest = change.squaredNorm() > 0 ? -last.dot(change) / change.squaredNorm() * v0 : 0;
    constexpr double straight = 1e-12;
    if (std::abs(last.x() * change.y() - last.y() * change.x()) <= straight * last.norm() * change.norm()) {
      // The centre moves along a straight line: forth, and perhaps back from a turning point.
      const Eigen::Vector2d there = at(slowest > 0 && slowest < v0 ? std::min(slip_time(slowest), t) : 0).position;
      return there.stableNorm() + (at(t).position - there).stableNorm();
    }
    return seconds(experiment, orbit_.integral(speed, paper_time(t), {slowest})) +
           last.norm() * std::max(0.0, t - stop_);
  }

 private:
  double paper_time(double t) const { return t >= stop_ ? orbit_.stop_time() : t * scale_; }

  reduction::Flow flow_;
  reduction::Orbit orbit_;
  double stop_;
  double scale_;  ///< tau per second
};

}  // namespace

SolvedMotion undriven_motion(const Experiment& experiment, const reduction::Law& law, SharedFlows& flows) {
  return std::make_shared<OneOrbit>(experiment, flows.get(SharedFlows::Of::undriven, [&] {
    return reduction::Flow(undriven_system(experiment, law));
  }));
}

}  // namespace contensou::si
