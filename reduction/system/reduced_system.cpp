#include "contensou/reduction/reduced_system.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/detail/infinity.hpp"
#include "system/balance.hpp"

namespace contensou::reduction {

using std::numbers::pi;

namespace {

double positive(const char* name, double value) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw std::domain_error(fmt::format("ReducedSystem: {} must be positive and finite, got {}", name, value));
  }
  return value;
}

double allowed_drive(double drive) {
  if (drive == 0 || (drive >= ReducedSystem::least_drive && drive < 1)) return drive;
  const char* why = drive >= 1  ? "; friction cannot be larger than 1 in this unit, so that the body would never stop"
                    : drive < 0 ? "; against the slip it would turn it round, and the motion is not one orbit"
                                : "";
  throw std::domain_error(fmt::format("ReducedSystem: the drive must be 0, or from {} to below 1, got {}{}",
                                      ReducedSystem::least_drive, drive, why));
}

double of_ball(double patch_ratio) {
  if (patch_ratio > 0 && patch_ratio <= 1) return patch_ratio;
  throw std::domain_error(fmt::format(
      "ReducedSystem: mu = {}: of a ball 0 < mu <= 1 is required; for another body give its Inertia", patch_ratio));
}

}  // namespace

bool is_state(State state) { return std::isfinite(state.u) && std::isfinite(state.v) && state.v >= 0; }

void require_state(const char* function, State state) {
  if (!is_state(state)) {
    throw std::domain_error(
        fmt::format("{}: u and v must be finite and v >= 0, got u = {}, v = {}", function, state.u, state.v));
  }
}

ReducedSystem::ReducedSystem(const Law& law, double patch_ratio, Inertia inertia, double drive)
    : law_(law),
      mu_(positive("mu", patch_ratio)),
      inertia_{positive("chi", inertia.chi), positive("gamma", inertia.gamma)},
      drive_(allowed_drive(drive)),
      // If r is below the smallest normal double, only the time depends on r; pivoting_limit computes the time from mu.
      r_(std::max(inertia.gamma * patch_ratio * patch_ratio / inertia.chi, std::numeric_limits<double>::min())),
      scaled_time_rate_(2 * inertia.chi / (3 * pi)) {}

ReducedSystem::ReducedSystem(const Law& law, double patch_ratio)
    : ReducedSystem(law, of_ball(patch_ratio), homogeneous_ball) {}

Rate ReducedSystem::field(State state) const {
  require_state("ReducedSystem::field", state);
  const Slip slip{state.v, mu_ * std::abs(state.u)};
  const Resistance resistance = law_(slip);
  const double net_force = reduction::net_force(law_, slip, resistance.force, drive_);
  const double spin_down = 2 * inertia_.gamma * mu_ / (3 * pi) * resistance.moment;
  return {state.u == 0 ? 0.0 : -std::copysign(spin_down, state.u), scaled_time_rate_ * (0 - net_force)};
}

double ReducedSystem::regularising_weight(State state) const {
  return reduction::regularising_weight(mu_ * std::abs(state.u), state.v);
}

Rate ReducedSystem::regularised_field(State state) const {
  if (state.u == 0 && state.v == 0) return {0, 0};
  const Rate rate = field(state);
  const double weight = regularising_weight(state);
  return {weight * rate.u, weight * rate.v};
}

double ReducedSystem::slope(State state) const {
  const Rate rate = field(state);
  if (rate.u == 0) {
    throw std::domain_error(fmt::format("ReducedSystem::slope: dv/du is infinite at u = 0 (v = {})", state.v));
  }
  return rate.v / rate.u;
}

double ReducedSystem::sliding_limit(double v) const { return 3 * pi / (2 * inertia_.chi) * v; }

double ReducedSystem::pivoting_limit(double u) const {
  return 3 * pi / (2 * inertia_.gamma * law_.pivoting_moment()) * (std::abs(u) / mu_);
}

Bounds ReducedSystem::stop_time_bounds(State start) const {
  require_state("ReducedSystem::stop_time_bounds", start);
  if (!law_.sliding_bounds()) return {0, infinity};
  const double sliding = sliding_limit(start.v);
  const double pivoting = pivoting_limit(start.u);
  const auto [min, max] = *law_.sliding_bounds();
  const double min_sliding = min == 0 ? 0 : min * sliding;  // sliding can be infinite
  // The bounds are widened by the rounding of these sums and of the stop time, so that they always contain this time.
  const double rounding = 2 * rounding_of_stop_time(r_) / (1 - drive_);
  const double lower = std::max({pivoting, (pivoting + min_sliding) / (1 - min * drive_), sliding / (1 - drive_)});
  const double upper = max * drive_ < 1 ? (pivoting + max * sliding) / (1 - max * drive_) : infinity;
  return {lower * (1 - rounding), upper * (1 + rounding)};
}

double rounding_of_stop_time(double r) {
  const double logarithm = std::log1p(r);
  return std::numeric_limits<double>::epsilon() * (4 + logarithm / 2 + 2 * std::max(0.0, logarithm - std::log(1e12)));
}

}  // namespace contensou::reduction
