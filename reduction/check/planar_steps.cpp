#include "contensou/reduction/planar_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include <fmt/format.h>

#include "planar/solution.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;

namespace {

namespace odeint = boost::numeric::odeint;
using Pair = std::array<double, 2>;

/// The field with the call operator that a stepper needs.
struct Equations {
  const PlanarField& field;

  void operator()(const Pair& x, Pair& rate, double /*t*/) const {
    const Vector2d f = field({x[0], x[1]});
    rate = {f[0], f[1]};
  }
};

/// The steps of one orbit, computed up to the latest requested time.
class SteppedMotion final : public PlanarOrbit::Motion {
 public:
  SteppedMotion(PlanarField field, const Vector2d& start)
      : field_(std::move(field)), states_{{0, {start[0], start[1]}}} {
    end = PlanarEnd::undecided;
    end_time = std::numeric_limits<double>::quiet_NaN();
    undecided = "no reduction was found: orbits are followed by steps";
    const double speed = field_(start).norm(), size = start.norm();
    constexpr double first = 1e-3;
    step_ = first * (speed > 0 && size > 0 ? size / speed : 1);
  }

  Vector2d at(double time) const override {
    const std::scoped_lock lock(guard_);
    while (states_.back().t < time) extend();
    const auto after = std::ranges::upper_bound(states_, time, {}, &State::t);
    State state = *std::prev(after);
    // This step is a part of a step whose error was accepted, so the error of this step is smaller.
    auto stepper = odeint::runge_kutta_dopri5<Pair>();
    if (time > state.t) stepper.do_step(Equations{field_}, state.x, state.t, time - state.t);
    return {state.x[0], state.x[1]};
  }
  Vector2d at_end() const override { throw std::logic_error("an orbit by steps has no end"); }

 private:
  struct State {
    double t;
    Pair x;
  };

  void extend() const {
    constexpr std::size_t most = 10000;
    constexpr double tolerance = 1e-12;
    State next = states_.back();
    const auto stop = [&](const char* reason) {
      throw std::domain_error(fmt::format("steps follow this orbit to the time {}, at ({}, {}), where {}", next.t,
                                          next.x[0], next.x[1], reason));
    };
    if (states_.size() > most) stop("10000 steps are made");
    auto stepper = odeint::make_controlled(tolerance * 1e-3, tolerance, odeint::runge_kutta_dopri5<Pair>());
    while (stepper.try_step(Equations{field_}, next.x, next.t, step_) == odeint::fail) {
      if (!(step_ > 1e-300) || next.t + step_ == next.t) stop("the field has no value, or changes too fast");
    }
    if (!std::isfinite(next.x[0]) || !std::isfinite(next.x[1])) {
      next = states_.back();
      stop("it leaves the numbers");
    }
    states_.push_back(next);
  }

  PlanarField field_;
  mutable std::mutex guard_;
  mutable std::vector<State> states_;
  mutable double step_;
};

struct SteppedSolution final : PlanarReduction::Solution {
  explicit SteppedSolution(PlanarField of) : Solution(std::move(of), "") {}

  double factor(const Vector2d&) const override { throw std::domain_error("no inverse integrating factor was found"); }
  double end_time_error(const Vector2d&) const override { return std::numeric_limits<double>::quiet_NaN(); }
  PlanarOrbit orbit(const Vector2d& start) const override {
    return PlanarOrbit(std::make_shared<const SteppedMotion>(field, start));
  }
  std::optional<double> first_integral(const Vector2d&) const override { return std::nullopt; }
  std::shared_ptr<const Solution> reversed() const override {
    return std::make_shared<const SteppedSolution>(reversed_field());
  }
};

}  // namespace

PlanarReduction by_steps(PlanarField field) {
  return PlanarReduction(std::make_shared<const SteppedSolution>(std::move(field)));
}

}  // namespace contensou::reduction
