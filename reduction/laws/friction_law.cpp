#include "contensou/reduction/friction_law.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <stdexcept>
#include <unordered_map>

#include <fmt/format.h>

namespace contensou::reduction {

Slip slip_of_ratio(double k) {
  if (!(k >= 0)) {
    throw std::domain_error(fmt::format("slip_of_ratio: the ratio k = sliding/pivoting must be >= 0, got {}", k));
  }
  return k <= 1 ? Slip{k, 1} : Slip{1, 1 / k};
}

namespace {

/// Throws. It is a separate function to keep the test in require_slip short, which runs in every call of a law.
[[noreturn, gnu::noinline]] void reject(const char* law, Slip slip) {
  if (slip.sliding == 0 && slip.pivoting == 0) {
    throw std::domain_error(
        fmt::format("{}: sliding and pivoting are both 0; friction has no limit at rest (Zh98, remark 3)", law));
  }
  throw std::domain_error(
      fmt::format("{}: sliding and pivoting must be finite and >= 0, got {} and {}", law, slip.sliding, slip.pivoting));
}

}  // namespace

void require_slip(const char* law, Slip slip) {
  const auto is_speed = [](double x) { return x >= 0 && std::isfinite(x); };
  if (!is_speed(slip.sliding) || !is_speed(slip.pivoting) || (slip.sliding == 0 && slip.pivoting == 0))
    reject(law, slip);
}

namespace {

/// Relative error that limits and ratios of a user's law may have, because the law may come from a quadrature.
constexpr double noise = 1e-6;

[[noreturn]] void reject(const std::string& name, const std::string& what) {
  throw std::domain_error(fmt::format("Law {}: {}", name, what));
}

bool differ(double a, double b) { return !(std::abs(a - b) <= noise * std::max(std::abs(a), std::abs(b))); }

}  // namespace

void Law::Function::read_limits() {
  pivoting_moment = resistance({0, 1}).moment;
  const double pure_sliding = resistance({1, 0}).force;
  // Two slow slips are needed: their Phi/k is equal if Phi ~ k, but not if Phi jumps (Phi(0+) = 1) or is a square root.
  constexpr double slow = 0x1p-60;
  constexpr double slower = 0x1p-80;
  force_slope = resistance({slow, 1}).force / slow;
  const double same_slope = resistance({slower, 1}).force / slower;

  if (!(pivoting_moment > 0) || !std::isfinite(pivoting_moment)) {
    reject(name, fmt::format("Psi(0) must be positive and finite, got {}", pivoting_moment));
  }
  if (!(std::abs(pure_sliding - 1) <= 1e-14)) {
    reject(name, fmt::format("Phi must be 1 in pure sliding, got {}", pure_sliding));
  }
  if (!(force_slope > 0) || differ(same_slope, force_slope)) {
    reject(name,
           fmt::format(
               "Phi must grow in proportion to k for slow sliding, but Phi/k is {} at k = 2^-60 and {} at k = 2^-80",
               force_slope, same_slope));
  }
  require_degree_0();
  require_approach();
}

void Law::Function::require_degree_0() const {
  for (const Slip slip : {Slip{0x1p-10, 1}, Slip{0.3, 1}, Slip{0.9, 1}, Slip{1, 0.9}, Slip{1, 0.3}, Slip{1, 0x1p-10}}) {
    const Resistance here = resistance(slip);
    if (!(here.force > 0) || !(here.moment > 0) || !std::isfinite(here.force) || !std::isfinite(here.moment)) {
      reject(name, fmt::format("Phi and Psi must be positive and finite where a patch slides and pivots, got Phi = {} "
                               "and Psi = {} at sliding = {}, pivoting = {}",
                               here.force, here.moment, slip.sliding, slip.pivoting));
    }
    // No scale is a power of two, because with a power of two every law would agree to the bit.
    for (double scale : {1e-9, 1e-3, 0.3, 1e3, 1e9}) {
      const Resistance there = resistance({scale * slip.sliding, scale * slip.pivoting});
      if (!differ(here.force, there.force) && !differ(here.moment, there.moment)) continue;
      reject(name,
             fmt::format("dry friction depends on the ratio of the two speeds alone, but Phi = {}, Psi = {} at "
                         "sliding = {}, pivoting = {}, and Phi = {}, Psi = {} at {} times both: divide by a speed "
                         "of the slip, not by a fixed one",
                         here.force, here.moment, slip.sliding, slip.pivoting, there.force, there.moment, scale));
    }
  }
}

void Law::Function::require_approach() const {
  // Compares a quantity at two k, the second 64 times nearer to the limit. The quantity must not grow like a power.
  const auto require_bounded = [&](const char* what, double first, double second, double allowance) {
    if (std::abs(second) <= 2 * std::abs(first) + allowance) return;
    reject(name, fmt::format("{}: it is {} and, 64 times nearer to the limit, {}", what, first, second));
  };
  constexpr double near = 0x1p-10;
  constexpr double nearer = 0x1p-16;
  const auto deficit = [&](double k) { return moment_deficit({k, 1}) / k; };
  const auto missing = [&](double inverse_k) { return (1 - resistance({1, inverse_k}).force) / inverse_k; };
  require_bounded("Psi must come to Psi(0) in proportion to k or faster, (1 - Psi/Psi(0))/k bounded", deficit(near),
                  deficit(nearer), noise / nearer);
  require_bounded("Phi must come to 1 in proportion to 1/k or faster, k (1 - Phi) bounded", missing(near),
                  missing(nearer), noise / nearer);
  constexpr double far = 0x1p-60;
  constexpr double farther = 0x1p-80;
  const double moment = resistance({1, far}).moment / far;
  const double same_moment = resistance({1, farther}).moment / farther;
  if (!(moment >= 0) || !std::isfinite(moment) || differ(moment, same_moment)) {
    reject(name, fmt::format("k Psi must have a limit for fast sliding, but is {} at k = 2^60 and {} at k = 2^80",
                             moment, same_moment));
  }
}

struct Law::Remembered final : Law::Function {
  explicit Remembered(std::shared_ptr<const Function> function) : Function(*function), function_(std::move(function)) {}

  Resistance resistance(Slip slip) const override { return at(slip).resistance; }
  double moment_deficit(Slip slip) const override { return at(slip).moment_deficit; }
  double force_deficit(Slip slip) const override { return function_->force_deficit(slip); }
  bool states_force_deficit() const override { return function_->states_force_deficit(); }
  const Function& given() const override { return function_->given(); }

 private:
  struct Values {
    Resistance resistance;
    double moment_deficit;
  };
  struct Hash {
    std::size_t operator()(const Slip& slip) const {
      constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;
      const auto bits = [](double speed) { return std::bit_cast<std::uint64_t>(speed); };
      return ((bits(slip.sliding) * odd ^ bits(slip.pivoting)) * odd) >> 20;
    }
  };
  struct Same {
    bool operator()(const Slip& a, const Slip& b) const { return a.sliding == b.sliding && a.pivoting == b.pivoting; }
  };

  Values at(Slip slip) const {
    {
      const std::lock_guard lock(guard_);
      if (const auto found = known_.find(slip); found != known_.end()) return found->second;
    }
    const Values made{function_->resistance(slip), function_->moment_deficit(slip)};  // other threads need not wait
    const std::lock_guard lock(guard_);
    known_.emplace(slip, made);
    return made;
  }

  std::shared_ptr<const Function> function_;
  mutable std::mutex guard_;
  mutable std::unordered_map<Slip, Values, Hash, Same> known_;
};

Law Law::remembered() const { return Law(std::make_shared<const Remembered>(function_)); }

}  // namespace contensou::reduction
