#include "contensou/si/aim.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "contensou/reduction/aim.hpp"
#include "contensou/reduction/detail/root.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"

namespace contensou::si {

namespace {

void require_goal(const Goal& goal) {
  int given = 0;
  const auto take = [&](const char* name, const std::optional<double>& value, bool signed_) {
    if (!value) return;
    ++given;
    if (std::isfinite(*value) && (signed_ || *value >= 0)) return;
    throw std::domain_error(fmt::format("{}: it must be finite{}, got {}", name, signed_ ? "" : " and >= 0", *value));
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
      fmt::format("aim takes no slope: on one of {} degrees a ball may roll for ever, and one distance may have "
                  "several starts; --slope 0 leaves it out",
                  experiment.environment.slope));
}

[[noreturn]] void too_far_apart(const Goal& goal) {
  std::string asked;
  const auto add = [&](const std::optional<double>& value, const char* unit) {
    if (value) asked += fmt::format("{}{} {}", asked.empty() ? "" : " and ", *value, unit);
  };
  add(goal.distance, "m");
  add(goal.turns, "turns");
  add(goal.time, "s");
  throw std::domain_error(fmt::format(
      "{} are too far apart for a double: no start that one can write down comes to both; nearer ones have one",
      asked));
}

[[noreturn]] void too_far_apart(const RollingGoal& goal) {
  throw std::domain_error(
      fmt::format("no start in doubles begins to roll within 1e-6 of {} m and rolls on at {} m/s "
                  "with a spin of {} rad/s: the three are too far apart for a double",
                  goal.place, goal.speed, goal.spin));
}

/// Returns true if a value equals the demanded value to 1e-6.
bool comes_to(double there, double asked) {
  constexpr double close = 1e-6;
  return std::isfinite(there) && std::abs(there - asked) <= close * asked;
}

/// Returns the message if the time is too short. @param least  least time, s, in which the other demand is possible
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

/// Finds the start of a ball with rolling friction from its turns, and from the distance or time until nothing moves.
/// Lengths and turns are proportional to the square of the speeds, and times to the speeds, except for the effect of
/// resting_slip. The quotient of the two demands therefore determines the ratio k at the start (reduction/numerics.md),
/// and one demand then determines the speeds.
/// @param goal  turns and one other demand
SlipAndSpin aimed_to_rest(const Experiment& experiment, const reduction::Flow& flow, const Goal& goal) {
  struct Reached {
    double turns, other;  ///< other: the distance or the square of the time; turns and other grow like speed squared
  };
  const double R = experiment.ball.radius, turns = std::abs(*goal.turns);
  const double other = goal.distance ? *goal.distance : *goal.time * *goal.time;
  const Shots shots(experiment, flow);
  const auto reached = [&](const SlipAndSpin& start) -> Reached {
    const Motion motion = shots.from(start);
    const double time = motion.last_time();
    return {motion.turns(), goal.distance ? motion.rest()->place.x() : time * time};
  };
  // Returns the start whose speeds have a given ratio and that fulfils a demand.
  const auto settled = [&](const auto& start_of) {
    // Near the solution the results may jump by more than `rounding`; then an error below `enough` passes.
    constexpr double rounding = 1e-11, enough = 1e-9;
    constexpr int most = 40, patience = 4;
    double speed = 1, least_off = std::numeric_limits<double>::infinity();
    SlipAndSpin best{};
    for (int i = 0, since = 0; i < most && since < patience && std::isfinite(speed); ++i, ++since) {
      const SlipAndSpin start = start_of(speed);
      const Reached at = reached(start);
      const double factor = std::sqrt(turns > 0 ? turns / at.turns : other / at.other);
      if (const double off = std::abs(factor - 1); off < least_off) best = start, least_off = off, since = 0;
      if (least_off < rounding) break;
      speed *= factor;
    }
    if (!(least_off < enough)) too_far_apart(goal);
    return best;
  };
  if (turns == 0 && other == 0) return {0, 0};
  if (turns == 0) return settled([](double speed) { return SlipAndSpin{speed, 0}; });
  const auto in_place = [&](double speed) { return SlipAndSpin{0, speed / R}; };
  if (goal.time) {
    const Reached soonest = reached(in_place(1));
    const double least = std::sqrt(soonest.other) * std::sqrt(turns / soonest.turns);
    constexpr double rounding = 1e-11;
    if (*goal.time < least * (1 - rounding)) throw std::domain_error(out_of_reach(goal, least));
    if (*goal.time <= least * (1 + rounding)) {
      const SlipAndSpin found = settled(in_place);
      return {0, std::copysign(found.spin, *goal.turns)};
    }
  }
  if (other == 0) return settled(in_place);
  const double mu = flow.system().mu();
  const SlipAndSpin found = settled([&](double speed) {
    const auto start_of = [&](double ln_k) -> SlipAndSpin {
      const double slip = mu * std::exp(ln_k), size = std::hypot(slip, 1);
      return {speed * slip / size, speed / size / R};
    };
    const auto falls_short = [&](double ln_k) {
      const Reached at = reached(start_of(ln_k));
      return at.other * turns < other * at.turns;
    };
    constexpr double far = 30;  // beyond this |ln k| a start only spins or only slides, up to rounding
    return start_of(reduction::last_where(falls_short, -far, far, 60));
  });
  if (!std::isfinite(other)) too_far_apart(goal);
  if (const double there = reached(found).other; !comes_to(there, other)) {
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
  reduction::require_monotone(flow.system().law());
  if (experiment.contact.rolling_friction != 0) {
    if (goal.turns) return aimed_to_rest(experiment, flow, goal);
    throw std::domain_error(
        "with rolling friction one distance in one time may have two starts, a slow spin and a fast one: give turns "
        "with one of them; --rolling-friction 0 leaves it out");
  }
  const double second = 1 / seconds(experiment, 1);  // 1 s as tau; the same factor converts lengths
  const double turn = 2 * std::numbers::pi * experiment.ball.radius;
  const auto times = [](const std::optional<double>& value, double factor) {
    return value ? std::optional(std::abs(*value) * factor) : std::nullopt;
  };
  const reduction::Aim aim{times(goal.time, second), times(goal.distance, second), times(goal.turns, turn * second)};
  for (const auto& each : {aim.tau, aim.distance, aim.turned}) {
    if (each && !std::isfinite(*each)) too_far_apart(goal);
  }
  const auto start = [&] {
    try {
      return reduction::aimed(flow, aim);
    } catch (const reduction::TooFarApart&) {
      too_far_apart(goal);
    }
  }();
  if (!start) throw std::domain_error(out_of_reach(goal, seconds(experiment, reduction::least_time(flow, aim))));
  return {start->v, std::copysign(start->u / experiment.ball.radius, goal.turns.value_or(1))};
}

Velocities aimed_to_roll(const Experiment& experiment, const reduction::Flow& flow, const RollingGoal& goal) {
  require_level(experiment);
  const auto require = [](const char* name, double value, bool possible, const char* range) {
    if (!std::isfinite(value) || !possible)
      throw std::domain_error(fmt::format("{}: it must be finite{}, got {}", name, range, value));
  };
  require("rolls_at", goal.place, goal.place > 0, " and > 0");
  require("rolling_speed", goal.speed, goal.speed >= 0, " and >= 0");
  require("spin", goal.spin, true, "");
  if (experiment.ball.body.lies_flat())
    throw std::domain_error("a body that lies flat never rolls: give two of distance, turns and time");
  if (experiment.contact.rolling_friction != 0) {
    throw std::domain_error(
        "aim finds where a ball begins to roll only without rolling friction; --rolling-friction 0 leaves it out");
  }
  reduction::require_monotone(flow.system().law());
  // Returns the speed that the centre loses from the start to the final rolling.
  const Shots shots(experiment, flow);
  const auto added = [&](const Motion& motion, double slip) { return slip - motion.final_motion().velocity.x(); };
  const auto too_far = [&](double slip) {
    const Motion motion = shots.from(SlipAndSpin{slip, goal.spin});
    const Event rolls = motion.event(motion.rolls());
    return rolls.place.x() + (goal.speed + added(motion, slip) - slip) * rolls.t - goal.place;
  };
  double high = 2 * rolling_slip;
  constexpr double most = 1e100;
  while (too_far(high) < 0) {
    high *= 2;
    if (high > most) too_far_apart(goal);
  }
  const double slip = reduction::root_between(too_far, high / 2, high);
  const double speed = goal.speed + added(shots.from(SlipAndSpin{slip, goal.spin}), slip);
  const Velocities start{{speed, 0}, {0, (speed - slip) / experiment.ball.radius, goal.spin}};
  const Motion motion = shots.from(start);
  if (!comes_to(motion.event(motion.rolls()).place.x(), goal.place)) too_far_apart(goal);
  return start;
}

std::optional<CueStrike> level_strike(const Ball& ball, const Velocities& start) {
  const double speed = start.velocity.x();
  if (ball.body.lies_flat() || !mass_is_known(ball) || !(speed > 0)) return std::nullopt;
  const double gamma = ball.body.inertia.gamma;
  const auto offset = [&](double turning) { return turning * ball.radius / (gamma * speed); };
  const double right = offset(start.angular_velocity.z()), above = offset(start.angular_velocity.y());
  if (std::hypot(right, above) > largest_tip_offset) return std::nullopt;
  const double of_cue = speed * (1 + ball.mass / standard_cue_mass + gamma * right * right + gamma * above * above) / 2;
  return CueStrike{.speed = of_cue, .right = right, .above = above, .elevation = 0};
}

}  // namespace contensou::si
