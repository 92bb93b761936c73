#include "motion/asymptotic_tail.hpp"

#include <cmath>
#include <numbers>

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

}  // namespace contensou::reduction
