#include "motion/stepping.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/reduction/detail/infinity.hpp"

namespace contensou::reduction {

using std::numbers::pi;

std::optional<AsymptoticTail> AsymptoticTail::at(const ReducedSystem& system, const LogState& state) {
  const double ln_k = state.ln_v - state.ln_w;
  const double pivoting_rate = system.r() * system.law().pivoting_moment();
  // Pure pivoting: v is too small to change the friction. Pure sliding: the stop time of pivoting alone is negligible.
  if (system.drive() == 0 && ln_k < std::log(1e-17)) return AsymptoticTail(system, state, true);
  if (ln_k + std::log(pivoting_rate) > std::log(1e18)) return AsymptoticTail(system, state, false);
  // Neither limit holds, but the time left is negligible (k tends to a finite ratio, or tends to 0 very slowly).
  const double upper_bound = (std::exp(state.ln_w) / pivoting_rate + std::exp(state.ln_v)) / (1 - system.drive());
  if (upper_bound < 1e-17 * state.s) return AsymptoticTail(system, state, ln_k < 0);
  return std::nullopt;
}

AsymptoticTail::AsymptoticTail(const ReducedSystem& system, const LogState& from, bool pivoting) : from_(from) {
  const Law& law = system.law();
  const double pivoting_rate = system.r() * law.pivoting_moment();
  if (pivoting) {
    const double w = std::exp(from.ln_w);
    left_ = w / pivoting_rate;
    ln_w_slope_ = 1;
    ln_v_slope_ = system.drive() > 0 ? 1 : law.force_slope() / pivoting_rate;
    beta_scale_ = left_ / (128 * w * w);
  } else {
    constexpr double fast = 0x1p100;
    const double v = std::exp(from.ln_v);
    left_ = v / (1 - system.drive());
    ln_v_slope_ = 1;
    ln_w_slope_ = system.r() * fast * law({fast, 1}).moment / (1 - system.drive());
    beta_scale_ = left_ / (45 * pi * pi * v * v);
  }
}

LogState AsymptoticTail::at_fraction(double fraction) const {
  const double ln_fraction = std::log(fraction);
  return {from_.ln_w + ln_w_slope_ * ln_fraction, from_.ln_v + ln_v_slope_ * ln_fraction,
          from_.s + left_ * (1 - fraction), from_.beta + beta_scale_ * (1 / fraction - 1)};
}

namespace {

/// Number of states reported along a tail.
constexpr int tail_instants = 64;

}  // namespace

MotionRecorder::MotionRecorder(const char* caller, const ReducedSystem& system, State start,
                               const Eigen::ArrayXd& times)
    : caller_(caller),
      scaled_time_rate_(system.scaled_time_rate()),
      mu_(system.mu()),
      given_(start),
      every_step_(times.size() == 0),
      times_(times.data(), times.data() + times.size()) {
  require_state(caller, start);
  double previous = 0;
  for (double time : times_) {
    if (!(time >= previous) || !std::isfinite(time)) {
      throw std::domain_error(
          fmt::format("{}: times must be finite, >= 0 and not decrease; got {} after {}", caller, time, previous));
    }
    previous = time;
  }
  const double largest = std::max(std::abs(start.u), start.v);
  if (largest > 0) exponent_ = std::ilogb(largest);
  const double unit = exponent_ * std::log(2.0);
  start_ = {std::log(mu_) + std::log(std::abs(start.u)) - unit, std::log(start.v) - unit, 0, 0};
  if (system.drive() > 0) {
    const double least = least_log_ratio(system.law(), system.r(), system.drive());
    start_.ln_v = std::max(start_.ln_v, start_.ln_w + least);
  }
  time_scale_ = std::exp(start_.ln_w) / (system.r() * system.law().pivoting_moment()) + std::exp(start_.ln_v);

  // Report the speeds of the start as given, because their logarithms are rounded.
  const double k = given_.u == 0 ? infinity : given_.v / (mu_ * std::abs(given_.u));
  const OrbitPoint at_start{0, given_.u, given_.v, std::log(given_.v), k, 0};
  if (every_step_) points_.push_back(at_start);
  while (points_.size() < times_.size() && times_[points_.size()] == 0) points_.push_back(at_start);
}

double MotionRecorder::next_time() const {
  if (points_.size() >= times_.size()) return infinity;
  return std::ldexp(times_[points_.size()], -exponent_) * scaled_time_rate_;
}

void MotionRecorder::add(const LogState& state) {
  const double unit = exponent_ * std::log(2.0);
  const double ln_v = state.ln_v + unit;
  const double ln_u = state.ln_w + unit - std::log(mu_);
  OrbitPoint point{std::ldexp(state.s / scaled_time_rate_, exponent_),
                   std::copysign(std::exp(ln_u), given_.u),
                   std::exp(ln_v),
                   ln_v,
                   std::exp(state.ln_v - state.ln_w),
                   std::ldexp(state.beta / scaled_time_rate_, -exponent_)};
  if (!every_step_) point.tau = times_[points_.size()];
  if (given_.u == 0) point.u = 0;
  points_.push_back(point);
}

Motion MotionRecorder::close(double stop_time, long steps, long evaluations, Outcome outcome) {
  Motion motion;
  motion.stop_time = stop_time;
  motion.steps = steps;
  motion.evaluations = evaluations;
  motion.outcome = std::move(outcome);
  const double k = given_.u == 0 && given_.v > 0 ? infinity : 0.0;
  if (motion.outcome.ok()) {
    if (every_step_) points_.push_back({stop_time, 0, 0, -infinity, k, infinity});
    while (points_.size() < times_.size()) points_.push_back({times_[points_.size()], 0, 0, -infinity, k, infinity});
  }
  motion.points = OrbitColumns(static_cast<Eigen::Index>(points_.size()));
  for (std::size_t i = 0; i < points_.size(); ++i) motion.points.set(static_cast<Eigen::Index>(i), points_[i]);
  return motion;
}

Motion MotionRecorder::finish(const AsymptoticTail& tail, long steps, long evaluations) {
  while (next_time() < tail.stop()) add(tail.at_time(next_time()));
  if (every_step_) {
    for (int i = tail_instants - 1; i > 0; --i) {
      const LogState state = tail.at_fraction(static_cast<double>(i) / tail_instants);
      if (state.s < tail.stop()) add(state);  // a tail shorter than the rounding of s has no states between its ends
    }
  }
  const double stop_time = std::ldexp(tail.stop() / scaled_time_rate_, exponent_);
  return close(stop_time, steps, evaluations, Outcome{});
}

Motion MotionRecorder::finish_at_rest() {
  points_.clear();
  return close(0, 0, 0, Outcome{});
}

Motion MotionRecorder::fail(Outcome::Kind kind, long steps, long evaluations) {
  const char* why = kind == Outcome::Kind::step_limit ? "the step limit was reached before the stop"
                                                      : "the step size fell to nothing or a value was not finite";
  const double reached = points_.empty() ? 0.0 : points_.back().tau;
  return close(std::numeric_limits<double>::quiet_NaN(), steps, evaluations,
               {kind, fmt::format("{}: {} after {} steps from u = {}, v = {} (last reported tau = {})", caller_, why,
                                  steps, given_.u, given_.v, reached)});
}

}  // namespace contensou::reduction
