#include "contensou/reduction/terminal_ratio.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/math/tools/roots.hpp>

namespace contensou::reduction {

TerminalRatio terminal_ratio(const Law& law, double r) {
  if (!(r > 0) || !std::isfinite(r)) {
    throw std::domain_error(fmt::format("terminal_ratio: r = gamma mu^2/chi must be positive and finite, got {}", r));
  }
  constexpr double fast = 0x1p100;
  const double low = law.force_slope() / law.pivoting_moment();
  const double high = 1 / (fast * law({fast, 1}).moment);
  if (r <= low) return {TerminalRegime::zero, 0, low, high};
  if (r >= high) return {TerminalRegime::infinity, std::numeric_limits<double>::infinity(), low, high};

  const auto excess = [&](double ln_k) {
    const double k = std::exp(ln_k);
    const auto [force, moment] = law(slip_of_ratio(k));
    return force - r * k * moment;
  };
  // Beyond these k the law is its limit, and r would be equal to low or high.
  constexpr double farthest = 60;
  constexpr int digits = std::numeric_limits<double>::digits - 2;
  std::uintmax_t most = 200;
  const auto [left, right] = boost::math::tools::toms748_solve(excess, -farthest, farthest,
                                                               boost::math::tools::eps_tolerance<double>(digits), most);
  return {TerminalRegime::ray, std::exp((left + right) / 2), low, high};
}

}  // namespace contensou::reduction
