#include "contensou/reduction/planar_reduction.hpp"

#include <algorithm>
#include <array>
#include <bit>
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

#include "contensou/reduction/detail/root.hpp"
#include "planar/inverse_factor.hpp"
#include "planar/region.hpp"
#include "planar/solution.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;

namespace {

namespace odeint = boost::numeric::odeint;
using Pair = std::array<double, 2>;

/// The field with the call operator that a stepper needs.
struct RightSide {
  const SmoothField& field;

  void operator()(const Pair& x, Pair& rate, double /*t*/) const {
    const Vector2d f = field({x[0], x[1]});
    rate = {f[0], f[1]};
  }
};

/// The steps of one orbit, computed up to the latest requested time. No step crosses a zero of a switching function:
/// there the orbit crosses, slides or rests, see Region.
class SteppedMotion final : public PlanarOrbit::Motion {
 public:
  SteppedMotion(SmoothField field, const Vector2d& start, double tolerance, std::size_t most_steps)
      : field_(std::move(field)),
        tolerance_(tolerance),
        most_(most_steps),
        size_((start.isZero(0) ? sampled_about(field_, start) : start).lpNorm<Eigen::Infinity>()) {
    end = PlanarEnd::undecided;
    end_time = std::numeric_limits<double>::quiet_NaN();
    undecided = "no reduction was found: orbits are followed by steps";
    const Vector2d f = field_(start);
    if (const auto from_curve = onward(field_, start, size_)) {
      states_.push_back({0, {start[0], start[1]}, nullptr});
      enter(*from_curve);
    } else {
      states_.push_back({0, {start[0], start[1]}, std::make_shared<const Region>(field_, start, f)});
    }
    step_ = first_step(start, f);
  }

  /// Looks whether the orbit comes to rest. Only motions that meet jumps do, and no motion that returns to a jump.
  void look_for_rest() {
    constexpr std::size_t most = 2000;
    try {
      while (field_.switches && !rests_ && !returns_ && states_.size() - piece_ < most) extend();
    } catch (const std::domain_error& stopped) {
      if (ambiguous_) undecided = stopped.what();
    }
    if (!rests_) return;
    end = PlanarEnd::rest;
    end_time = states_.back().t;
    undecided.clear();
  }

  Vector2d at(double time) const override {
    const std::scoped_lock lock(guard_);
    while (states_.back().t < time && !rests_) extend();
    const State& state = *std::prev(std::ranges::upper_bound(states_, time, {}, &State::t));
    // This step is a part of a step whose error was accepted, so the error of this step is smaller.
    return vector_of(stepped(state, time - state.t));
  }
  Vector2d at_end() const override { return vector_of(states_.back().x); }
  double first_slide() const override {
    const std::scoped_lock lock(guard_);
    return first_slide_;
  }

 private:
  using Stepper = odeint::runge_kutta_dopri5<Pair>;
  struct State {
    double t;
    Pair x;
    std::shared_ptr<const Region> region;  ///< region that the orbit enters here; null if no single motion leaves x
  };

  /// Returns a step that is short enough even where the field grows much along the motion, as beside an equilibrium. An
  /// error that overflows would pass the comparison of the controlled stepper. Source: E. Hairer, S. P. Norsett, G.
  /// Wanner, Solving ordinary differential equations I, section II.4.
  double first_step(const Vector2d& start, const Vector2d& f) const {
    constexpr double part = 1e-3, order = 5;
    const double speed = f.stableNorm(), first = part * (speed > 0 ? size_ / speed : 1);
    const auto there = value_of(field_.value, start + first * f);
    if (!there) return first;
    const double change = std::max(speed, (*there - f).stableNorm() / first) / (tolerance_ * size_);
    return std::min(first, std::pow(part / change, 1 / order));
  }

  static Vector2d vector_of(const Pair& x) { return {x[0], x[1]}; }

  static Pair stepped(const State& from, double step) {
    Pair x = from.x;
    if (step > 0 && from.region) Stepper().do_step(RightSide{from.region->field()}, x, from.t, step);
    return x;
  }

  /// Goes on from the last state, which lies on a switching curve.
  void enter(const Onward& next) const {
    State& last = states_.back();
    if (jumps_to(next)) {
      // The motion returns if it meets a jump where it has met one after half as many jumps, or later.
      constexpr double near = 1e-10;
      piece_ = states_.size();
      const Vector2d away = next.x - vector_of(anchor_);
      returns_ = jumps_ > 0 && away.norm() <= near * size_;
      if (std::has_single_bit(++jumps_)) anchor_ = {next.x[0], next.x[1]};
    }
    last.x = {next.x[0], next.x[1]};
    last.region = next.region ? std::make_shared<const Region>(*next.region) : nullptr;
    rests_ = next.rests;
    if (rests_ || (next.region && next.region->slides())) first_slide_ = std::min(first_slide_, last.t);
    ambiguous_ = next.ambiguous;
    reason_ = next.reason;
  }

  /// Returns true if the velocity changes where the last region ends.
  bool jumps_to(const Onward& next) const {
    const auto& region = states_.back().region;
    if (!region || !next.region) return true;
    const auto before = value_of(region->field().value, next.x), after = value_of(next.region->field().value, next.x);
    constexpr double apart = 1e-9;
    return !before || !after || (*after - *before).norm() > apart * (before->norm() + after->norm());
  }

  void extend() const {
    constexpr std::size_t most_in_all = 300'000;
    const State& last = states_.back();
    State next = last;
    const auto stop = [&](std::string_view reason) {
      throw std::domain_error(fmt::format("steps follow this orbit to the time {}, at ({}, {}), where {}", last.t,
                                          last.x[0], last.x[1], reason));
    };
    if (const bool in_piece = states_.size() - piece_ > most_; in_piece || states_.size() > most_in_all)
      stop(fmt::format("{} steps are made", in_piece ? most_ : most_in_all));
    if (!last.region) stop(reason_);
    auto stepper = odeint::make_controlled(tolerance_ * 1e-3 * size_, tolerance_, Stepper());
    while (stepper.try_step(RightSide{last.region->field()}, next.x, next.t, step_) == odeint::fail) {
      if (!(step_ > 1e-300) || next.t + step_ == next.t) stop("the field has no value, or changes too fast");
    }
    if (!std::isfinite(next.x[0]) || !std::isfinite(next.x[1])) stop("it leaves the numbers");
    const auto inside = [&](double step) { return last.region->contains(vector_of(stepped(last, step))); };
    double whole = next.t - last.t;
    bool leaves = !last.region->contains(vector_of(next.x));
    if (const auto dip = leaves ? std::nullopt : last.region->dip(vector_of(last.x), vector_of(next.x), whole)) {
      leaves = !inside(*dip * whole);
      if (leaves) whole *= *dip;
    }
    if (!leaves) {
      const Vector2d x = last.region->on_curve(vector_of(next.x));
      next.x = {x[0], x[1]};
      return states_.push_back(std::move(next));
    }
    // The state at the border, or at most one rounding of the time beyond.
    const double part = last_where(inside, 0, whole);
    const std::shared_ptr<const Region> region = last.region;
    still_ = part > 0 ? 0 : still_ + 1;
    constexpr int most_at_a_point = 8;
    if (still_ > most_at_a_point) stop("rounding hides which motion leaves a switching curve");
    next.t = last.t + part;
    next.x = stepped(last, part);
    states_.push_back(std::move(next));
    enter(region->leave(vector_of(states_.back().x), size_));
  }

  SmoothField field_;
  double tolerance_;
  std::size_t most_;  ///< steps between two jumps
  double size_;
  mutable std::mutex guard_;
  mutable std::vector<State> states_;
  mutable double step_;
  mutable bool rests_ = false, ambiguous_ = false;  ///< of the last state, like reason_
  mutable std::string_view reason_;
  mutable int still_ = 0;          ///< number of borders met without a step between them
  mutable std::size_t piece_ = 0;  ///< number of states before the last jump
  mutable std::size_t jumps_ = 0;  ///< number of jumps that the motion has met
  mutable Pair anchor_ = {};       ///< state at one of these jumps
  mutable bool returns_ = false;
  mutable double first_slide_ = std::numeric_limits<double>::infinity();
};

struct SteppedSolution final : PlanarReduction::Solution {
  SteppedSolution(SmoothField of, double relative, std::size_t most)
      : Solution(std::move(of), ""), tolerance(relative), most_steps(most) {}

  double factor(const Vector2d&) const override { throw std::domain_error("no inverse integrating factor was found"); }
  double end_time_error(const Vector2d&, const PlanarOrbit&) const override {
    return std::numeric_limits<double>::quiet_NaN();
  }
  PlanarOrbit orbit(const Vector2d& start) const override {
    auto motion = std::make_shared<SteppedMotion>(field, start, tolerance, most_steps);
    motion->look_for_rest();
    return PlanarOrbit(std::move(motion));
  }
  PlanarOrbit part_of_orbit(const Vector2d& start) const override {
    return PlanarOrbit(std::make_shared<const SteppedMotion>(field, start, tolerance, most_steps));
  }
  std::optional<double> first_integral(const Vector2d&) const override { return std::nullopt; }
  std::shared_ptr<const Solution> reversed() const override {
    return std::make_shared<const SteppedSolution>(backward(field), tolerance, most_steps);
  }

  double tolerance;
  std::size_t most_steps;
};

}  // namespace

std::shared_ptr<PlanarReduction::Solution> solved_by_steps(SmoothField field, double tolerance,
                                                           std::size_t most_steps) {
  return std::make_shared<SteppedSolution>(std::move(field), tolerance, most_steps);
}

PlanarReduction by_steps(SmoothField field, double tolerance, std::size_t most_steps) {
  return PlanarReduction(solved_by_steps(std::move(field), tolerance, most_steps));
}

}  // namespace contensou::reduction
