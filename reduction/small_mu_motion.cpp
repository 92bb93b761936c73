// Notation (README (R24)): K = 3 pi k/8, z = 15 pi k/16 = (5/2) K; index 0: at the start.
//   layer      K + ln K = K0 + ln K0 - s K0/v0          (dv/ds = -Phi(v/w0))
//   spin       u/u0 = 1 - (r/2) [ln(K0/K) - (3/5) ln((1 + z0)/(1 + z))]
//   sliding    ln(v/v0) = (2/r) ln(u/u0) - (3/(5 - r)) ln((1 + z0)/(1 + z))
#include "contensou/reduction/small_mu_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/wright_omega.hpp"

namespace contensou::reduction {

namespace {

constexpr double minus_infinity = -std::numeric_limits<double>::infinity();

}  // namespace

SmallMuMotion::SmallMuMotion(double patch_ratio, State start, Inertia inertia) : u0_(start.u) {
  const ReducedSystem system(PadeLaw{}, patch_ratio, inertia);
  require_state("SmallMuMotion", start);
  r_ = system.r();
  if (!(r_ < 2)) {
    throw std::domain_error(
        fmt::format("SmallMuMotion: r = gamma mu^2/chi must be small, and is {}; 2 is too much", r_));
  }
  ln_v0_ = std::log(start.v);
  sliding_ = system.sliding_limit(start.v);
  pivoting_ = system.pivoting_limit(start.u);
  // Beyond the largest double the rim speed is not felt, whatever it is.
  constexpr double scale = 3 * std::numbers::pi / 8;
  const double ln_k = ln_v0_ - std::log(system.mu()) - std::log(std::abs(start.u));
  fast_ = scale * std::min(std::exp(ln_k), 0x1p1000);
  ln_fast_ = std::log(scale) + std::min(ln_k, std::log(0x1p1000));
  const double rim = system.sliding_limit(system.mu() * std::abs(start.u));  // S/k0
  layer_rate_ = ln_k > 0 ? fast_ / sliding_ : scale / rim;
  stop_time_ = pivoting_ + sliding_ + 8 / (5 * std::numbers::pi) * rim * (u0_ == 0 ? 0 : std::log1p(2.5 * fast_));
}

SmallMuMotion::Point SmallMuMotion::at_time(double tau) const {
  if (!(tau >= 0)) throw std::domain_error(fmt::format("SmallMuMotion::at_time: tau must be >= 0, got {}", tau));
  if (tau >= stop_time_) return {0, minus_infinity};
  if (ln_v0_ == minus_infinity) return {u0_ * (1 - tau / pivoting_), minus_infinity};
  if (u0_ == 0) return {0, ln_v0_ + std::log1p(-tau / sliding_)};

  const double excess = fast_ - layer_rate_ * tau;
  const double slow = wright_omega(excess + ln_fast_);
  const double ln_fall = slow > 1 ? std::log(fast_ / slow) : slow - excess;  // ln(K0/K)
  const double ln_rise = std::log1p(2.5 * slow) - std::log1p(2.5 * fast_);   // ln((1 + z)/(1 + z0))
  const double spent = r_ / 2 * (ln_fall + 0.6 * ln_rise);
  if (spent >= 1) return {0, minus_infinity};
  return {u0_ * (1 - spent), ln_v0_ + 2 / r_ * std::log1p(-spent) + 3 / (5 - r_) * ln_rise};
}

}  // namespace contensou::reduction
