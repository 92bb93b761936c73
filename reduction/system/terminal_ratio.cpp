#include "contensou/reduction/terminal_ratio.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/math/tools/roots.hpp>

namespace contensou::reduction {

namespace {

/// k falls where Phi > r k Psi and grows where it is less: with more than one change of sign, it depends on the start
/// where it goes.
template <class Excess>
void require_one_end(const Law& law, double r, Excess excess, double farthest) {
  constexpr double step = 0.25;
  constexpr double told_apart = 1e-9;
  bool falls = false;
  for (double ln_k = -farthest; ln_k <= farthest; ln_k += step) {
    const double here = excess(ln_k);
    if (falls && here < -told_apart) {
      throw std::domain_error(fmt::format(
          "terminal_ratio: under law {} with r = gamma mu^2/chi = {}, k = v/(mu |u|) tends to one of several "
          "ratios, it depends on the start which; routes regularised and direct answer there",
          law.name(), r));
    }
    falls = falls || here > told_apart;
  }
}

}  // namespace

TerminalRatio terminal_ratio(const Law& law, double r) {
  if (!(r > 0) || !std::isfinite(r)) {
    throw std::domain_error(fmt::format("terminal_ratio: r = gamma mu^2/chi must be positive and finite, got {}", r));
  }
  constexpr double fast = 0x1p100;
  const double low = law.force_slope() / law.pivoting_moment();
  const double high = 1 / (fast * law({fast, 1}).moment);
  // Beyond these k the law is its limit, and r would be equal to low or high.
  constexpr double farthest = 60;
  const auto excess = [&](double ln_k) {
    const double k = std::exp(ln_k);
    const auto [force, moment] = law(slip_of_ratio(k));
    return force / (r * k * moment) - 1;
  };
  require_one_end(law, r, excess, farthest);
  if (r <= low) return {TerminalRegime::zero, 0, low, high};
  if (r >= high) return {TerminalRegime::infinity, std::numeric_limits<double>::infinity(), low, high};
  constexpr int digits = std::numeric_limits<double>::digits - 2;
  std::uintmax_t most = 200;
  const auto [left, right] = boost::math::tools::toms748_solve(excess, -farthest, farthest,
                                                               boost::math::tools::eps_tolerance<double>(digits), most);
  return {TerminalRegime::ray, std::exp((left + right) / 2), low, high};
}

}  // namespace contensou::reduction
