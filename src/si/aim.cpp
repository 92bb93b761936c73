#include "contensou/si/aim.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "contensou/reduction/aim.hpp"
#include "contensou/reduction/root.hpp"
#include "contensou/si/ball_motion.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/resisted_motion.hpp"
#include "contensou/si/scaling.hpp"

namespace contensou::si {

namespace {

void require_goal(const Goal& goal) {
  int given = 0;
  const auto take = [&](const char* name, const std::optional<double>& value, bool signed_) {
    if (!value) return;
    ++given;
    if (std::isfinite(*value) && (signed_ || *value >= 0)) return;
    throw std::domain_error(
        fmt::format("{0}: {0} must be finite{1}, got {2}", name, signed_ ? "" : " and >= 0", *value));
  };
  take("distance", goal.distance, false);
  take("turns", goal.turns, true);
  take("time", goal.time, false);
  if (given == 2) return;
  throw std::domain_error(fmt::format("two of distance, turns and time decide a start, got {}: {}", given,
                                      given < 2 ? "give one more" : "leave one out"));
}

void require_level(const Experiment& experiment) {
  if (experiment.environment.slope == 0) return;
  throw std::domain_error(
      fmt::format("aim knows no slope: on one of {} degrees a ball may roll for ever, and one distance may have "
                  "several starts; --slope 0 leaves it out",
                  experiment.environment.slope));
}

/// @param least  s, in which the other one is reached at the soonest
std::string out_of_reach(const Goal& goal, double least) {
  const double most = *goal.time / least;
  const auto sentence = [&](const std::string& asked, const std::string& greatest, const char* how) {
    return fmt::format(
        "no start comes to {0} in {1} s: that takes {2:.6g} s or more, and in {1} s it comes to {3} at most, {4}",
        asked, *goal.time, least, greatest, how);
  };
  if (goal.distance) {
    return sentence(fmt::format("{} m", *goal.distance), fmt::format("{:.6g} m", *goal.distance * most * most),
                    "without spin");
  }
  return sentence(fmt::format("{} turns", *goal.turns), fmt::format("{:.6g} turns", *goal.turns * most * most),
                  "in place");
}

/// The start of a ball with rolling friction that has turned so often when nothing moves any more, and rests after a
/// distance or has taken so long. Lengths and turns go with the square of the speeds and times with them, but for
/// resting_slip; so the ratio k at the start is the root of a quotient (reduction/README.md), and the speeds follow.
/// @param goal  of which turns is one
SlipAndSpin aimed_to_rest(const Experiment& experiment, const reduction::Law& law, const Goal& goal) {
  struct Reached {
    double turns, other;  ///< other: what goes with the square of the speeds, too, distance or the square of the time
  };
  const double R = experiment.ball.radius, turns = std::abs(*goal.turns);
  const double other = goal.distance ? *goal.distance : *goal.time * *goal.time;
  const auto flows = std::make_shared<ResistedFlows>();
  const auto reached = [&](const SlipAndSpin& start) -> Reached {
    Experiment shot = experiment;
    shot.start = start;
    const ResistedMotion motion(shot, law, experiment.contact.rolling_friction, false, flows);
    const double time = motion.last_time();
    return {motion.spin_angle() / (2 * std::numbers::pi), goal.distance ? motion.rest_position().x() : time * time};
  };
  // A start with these speeds, and from it the one of the same kind that comes to what is asked for.
  const auto settled = [&](const auto& start_of) {
    double speed = 1;
    constexpr int most = 40;
    for (int i = 0; i < most; ++i) {
      const SlipAndSpin start = start_of(speed);
      const Reached at = reached(start);
      const double factor = std::sqrt(turns > 0 ? turns / at.turns : other / at.other);
      constexpr double rounding = 1e-11;
      if (std::abs(factor - 1) < rounding) return start;
      speed *= factor;
    }
    throw std::runtime_error("aim: no scale of the start was found");
  };
  if (turns == 0 && other == 0) return {0, 0};
  if (turns == 0) return settled([](double speed) { return SlipAndSpin{speed, 0}; });
  const auto in_place = [&](double speed) { return SlipAndSpin{0, speed / R}; };
  if (goal.time) {
    const Reached soonest = reached(in_place(1));
    if (const double least = std::sqrt(soonest.other * turns / soonest.turns); *goal.time < least)
      throw std::domain_error(out_of_reach(goal, least));
  }
  if (other == 0) return settled(in_place);
  const double mu = patch_ratio(experiment, law);
  const SlipAndSpin found = settled([&](double speed) {
    SlipAndSpin start{};
    double low = -30, high = 30;  // of ln k; beyond, a start spins or slides alone, to rounding
    constexpr int halvings = 60;
    for (int i = 0; i < halvings; ++i) {
      const double middle = (low + high) / 2, slip = mu * std::exp(middle), size = std::hypot(slip, 1);
      start = {speed * slip / size, speed / size / R};
      const Reached at = reached(start);
      (at.other * turns < other * at.turns ? low : high) = middle;
    }
    return start;
  });
  constexpr double close = 1e-6;
  if (const double there = reached(found).other; std::abs(there - other) > close * other) {
    throw std::domain_error(fmt::format(
        "no start comes to {} turns and this {}: so close to a start that {} alone there is none that rests there",
        *goal.turns, goal.distance ? "distance" : "time", there > other ? "spins" : "slides"));
  }
  return {found.slip, std::copysign(found.spin, *goal.turns)};
}

}  // namespace

SlipAndSpin aimed(const Experiment& experiment, const reduction::Flow& flow, const Goal& goal) {
  require_goal(goal);
  require_level(experiment);
  if (experiment.contact.rolling_friction != 0) {
    if (goal.turns) return aimed_to_rest(experiment, flow.system().law(), goal);
    throw std::domain_error(
        "with rolling friction one distance in one time may have two starts, a slow spin and a fast one: give turns "
        "with one of them; --rolling-friction 0 leaves it out");
  }
  const double second = 1 / seconds(experiment, 1);  // in the paper's time; of lengths the same
  const double turn = 2 * std::numbers::pi * experiment.ball.radius;
  const auto times = [](const std::optional<double>& value, double factor) {
    return value ? std::optional(std::abs(*value) * factor) : std::nullopt;
  };
  const reduction::Aim aim{times(goal.time, second), times(goal.distance, second), times(goal.turns, turn * second)};
  const auto start = reduction::aimed(flow, aim);
  if (!start) throw std::domain_error(out_of_reach(goal, seconds(experiment, reduction::least_time(flow, aim))));
  return {start->v, std::copysign(start->u / experiment.ball.radius, goal.turns.value_or(1))};
}

Velocities aimed_to_roll(const Experiment& experiment, const reduction::Flow& flow, const RollingGoal& goal) {
  require_level(experiment);
  const auto require = [](const char* name, double value, bool possible, const char* range) {
    if (!std::isfinite(value) || !possible)
      throw std::domain_error(fmt::format("{}: must be finite{}, got {}", name, range, value));
  };
  require("rolls_at", goal.place, goal.place > 0, " and > 0");
  require("rolling_speed", goal.speed, goal.speed >= 0, " and >= 0");
  require("spin", goal.spin, true, "");
  if (experiment.ball.body.lies_flat())
    throw std::domain_error("a body that lies flat never rolls: give two of distance, turns and time");
  if (experiment.contact.rolling_friction != 0) {
    throw std::domain_error(
        "aim knows where a ball begins to roll without rolling friction only; --rolling-friction 0 leaves it out");
  }
  // What its slip adds to the speed of the centre at the start.
  Experiment shot = experiment;
  const auto added = [&](double slip) {
    shot.start = SlipAndSpin{slip, goal.spin};
    return slip - final_motion(shot).velocity.x();
  };
  const auto too_far = [&](double slip) {
    const double more = added(slip);
    const BallMotion motion(shot, flow);
    const double rolls = motion.slip_time(rolling_slip);
    return motion.at_time(rolls).position.x() + (goal.speed + more - slip) * rolls - goal.place;
  };
  double high = 2 * rolling_slip;
  constexpr double most = 1e100;
  while (too_far(high) < 0) {
    high *= 2;
    if (high > most) throw std::domain_error(fmt::format("rolls_at: too far to be computed, got {}", goal.place));
  }
  const double slip = reduction::root_between(too_far, high / 2, high);
  const double speed = goal.speed + added(slip);
  return {{speed, 0}, {0, (speed - slip) / experiment.ball.radius, goal.spin}};
}

std::optional<CueStrike> level_strike(const Ball& ball, const Velocities& start) {
  const double speed = start.velocity.x();
  if (ball.body.lies_flat() || !(speed > 0)) return std::nullopt;
  const double gamma = ball.body.inertia.gamma;
  const auto offset = [&](double turning) { return turning * ball.radius / (gamma * speed); };
  const double right = offset(start.angular_velocity.z()), above = offset(start.angular_velocity.y());
  if (std::hypot(right, above) > largest_tip_offset) return std::nullopt;
  const double of_cue = speed * (1 + ball.mass / standard_cue_mass + gamma * right * right + gamma * above * above) / 2;
  return CueStrike{.speed = of_cue, .right = right, .above = above, .elevation = 0};
}

}  // namespace contensou::si
