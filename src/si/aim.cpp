#include "contensou/si/aim.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "contensou/reduction/aim.hpp"
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

}  // namespace

SlipAndSpin aimed(const Experiment& experiment, const reduction::Flow& flow, const Goal& goal) {
  require_undriven(experiment, "aim");
  require_goal(goal);
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

std::optional<CueStrike> level_strike(const Ball& ball, const SlipAndSpin& start) {
  if (ball.body.lies_flat() || start.slip == 0) return std::nullopt;
  const double gamma = ball.body.inertia.gamma;
  const double right = start.spin * ball.radius / (gamma * start.slip);
  if (std::abs(right) > largest_tip_offset) return std::nullopt;
  const double speed = start.slip * (1 + ball.mass / standard_cue_mass + gamma * right * right) / 2;
  return CueStrike{.speed = speed, .right = right, .above = 0, .elevation = 0};
}

}  // namespace contensou::si
