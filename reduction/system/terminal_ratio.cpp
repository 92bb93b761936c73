// Notation (theory.md (R2)): x = ln k; E = slows/speeds - 1 (Balance) has the sign of Phi - rho - r k Psi. E > 0: k
// falls.
#include "contensou/reduction/reduced_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/math/tools/minima.hpp>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/root.hpp"
#include "numerics/epsilon.hpp"
#include "system/balance.hpp"

namespace contensou::reduction {

namespace {

/// An |E| below this has no reliable sign: a law is accurate to some eps. (k also takes nearly for ever to pass there.)
constexpr double without_sign = TerminalRatios::tolerance;

/// Largest |ln k|; beyond this, the law equals its limit.
constexpr double max_x = 60;

struct Excess {
  double ln_k;
  double excess;
  int sign() const { return excess > without_sign ? 1 : excess < -without_sign ? -1 : 0; }
};

class Search {
 public:
  Search(const Law& law, double r, double drive) : law_(law), r_(r), drive_(drive) {
    sample();
    require_decided();
    sharpen();
    collect();
  }

  std::vector<InvariantRay> rays;
  std::vector<int> signs{1};  ///< signs of E: below the first ray, between the rays, above the last

 private:
  double excess(double ln_k) const {
    const Balance balance = Balance::of(law_, r_, drive_, std::exp(ln_k));
    return balance.slows / balance.speeds - 1;
  }

  void sample() {
    constexpr double fine = 16;
    const double min_x = drive_ > 0 ? std::min(-max_x, least_log_ratio(law_, r_, drive_)) : -max_x;
    for (double x = min_x; x <= max_x; x += std::abs(x + 0.01) < fine ? 1 / fine : 0.5) {
      samples_.push_back({x, excess(x)});
    }
  }

  /// Throws if the drive nearly cancels the friction, so that rounding of Phi hides the sign of E for k -> infinity.
  void require_decided() const {
    constexpr double part = 1e-8;
    if (by_deficit(law_, drive_) || samples_.back().sign() != 0 || without_sign < part * (1 - drive_)) return;
    throw std::runtime_error(fmt::format(
        "drive {} with r = {}: law {} does not state 1 - Phi, and rounding of Phi hides whether v/(mu |u|) tends "
        "to a ray or to infinity; give a law with a name, or another drive",
        drive_, r_, law_.name()));
  }

  /// Adds the extrema of E that come near to 0, and those whose sign differs from that of both neighbouring samples.
  void sharpen() {
    std::vector<Excess> extrema;
    for (std::size_t i = 1; i + 1 < samples_.size(); ++i) {
      const Excess &before = samples_[i - 1], &here = samples_[i], &after = samples_[i + 1];
      const int sign = here.sign();
      if (sign == 0 || before.sign() != sign || after.sign() != sign) continue;
      const double fall = sign * (before.excess - here.excess);
      const double rise = sign * (after.excess - here.excess);
      if (fall < 0 || rise < 0 || std::max(fall, rise) < without_sign) continue;
      const auto [at, least] = boost::math::tools::brent_find_minima(
          [&](double x) { return sign * excess(x); }, before.ln_k, after.ln_k, std::numeric_limits<double>::digits / 2);
      if (least < without_sign) extrema.push_back({at, sign * least});
    }
    samples_.insert(samples_.end(), extrema.begin(), extrema.end());
    std::ranges::sort(samples_, {}, &Excess::ln_k);
  }

  void collect() {
    const Excess* last = nullptr;  // last sample with a reliable sign
    const Excess* zero = nullptr;  // since `last`, the sample with the smallest |E| of those without a reliable sign
    for (const Excess& here : samples_) {
      if (here.sign() == 0) {
        if (!zero || std::abs(here.excess) < std::abs(zero->excess)) zero = &here;
        continue;
      }
      if (!last) {
        signs.back() = here.sign();
      } else if (last->sign() != here.sign()) {
        add(root(*last, here), last->sign(), here.sign());
      } else if (zero && last->sign() * zero->excess < without_sign / 2) {
        add(zero->ln_k, last->sign(), here.sign());
      }
      last = &here;
      zero = nullptr;
    }
  }

  double root(const Excess& left, const Excess& right) const {
    return root_between([&](double x) { return excess(x); }, left.ln_k, right.ln_k, left.excess, right.excess);
  }

  void add(double ln_k, int below, int above) {
    double accuracy = 8 * eps;
    const auto lost = [&](double x) { return std::abs(excess(x)) <= 8 * eps; };
    while (accuracy < 1 && (lost(ln_k - accuracy) || lost(ln_k + accuracy))) accuracy *= 2;
    rays.push_back({std::exp(ln_k), above > 0, below < 0, accuracy});
    signs.push_back(above);
  }

  const Law& law_;
  double r_, drive_;
  std::vector<Excess> samples_;
};

std::vector<TerminalRatio> ends_of(const std::vector<InvariantRay>& rays, const std::vector<int>& signs) {
  std::vector<TerminalRatio> ends;
  const auto invariant = [&](std::size_t i) { return i == 0 ? 0.0 : i > rays.size() ? infinity : rays[i - 1].k; };
  if (signs.front() > 0) ends.push_back({TerminalRegime::zero, 0, 0, invariant(1)});
  for (std::size_t i = 1; i <= rays.size(); ++i) {
    const InvariantRay& ray = rays[i - 1];
    if (!ray.attracts_above && !ray.attracts_below) continue;
    ends.push_back({TerminalRegime::ray, ray.k, invariant(ray.attracts_below ? i - 1 : i),
                    invariant(ray.attracts_above ? i + 1 : i)});
  }
  if (signs.back() < 0) ends.push_back({TerminalRegime::infinity, infinity, invariant(rays.size()), infinity});
  return ends;
}

}  // namespace

TerminalRatio TerminalRatios::end_of(double k) const {
  if (!(k >= 0)) throw std::domain_error(fmt::format("TerminalRatios::end_of: k must be >= 0, got {}", k));
  for (const TerminalRatio& end : ends) {
    if (end.from < k && k < end.to) return end;
  }
  return {k == 0 ? TerminalRegime::zero : std::isinf(k) ? TerminalRegime::infinity : TerminalRegime::ray, k, k, k};
}

double least_log_ratio(const Law& law, double r, double drive) {
  // At this distance in ln k the friction is below the drive by a factor exp(44), so k grows at the rate rho/w.
  constexpr double distance = 44;
  constexpr double least = -600;  // exp(-600), and products of it with other factors, are doubles
  return std::max(std::log(drive) - std::log(law.force_slope() + r * law.pivoting_moment()) - distance, least);
}

TerminalRatios terminal_ratios(const Law& law, double r, double drive) {
  if (!(r > 0) || !std::isfinite(r)) {
    throw std::domain_error(fmt::format("terminal_ratios: r = gamma mu^2/chi must be positive and finite, got {}", r));
  }
  constexpr double fast = 0x1p100;
  const double low = law.force_slope() / law.pivoting_moment();
  const double high = (1 - drive) / (fast * law({fast, 1}).moment);
  Search found(law, r, drive);
  auto ends = ends_of(found.rays, found.signs);
  return {low, high, std::move(found.rays), std::move(ends)};
}

}  // namespace contensou::reduction
