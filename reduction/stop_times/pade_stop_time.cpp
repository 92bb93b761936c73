#include "contensou/reduction/pade_stop_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/pade_sliding_coefficient.hpp"

namespace contensou::reduction {

namespace {

/// P + m S. In long double, so that of the two terms only the error of m is left.
long double sum_of_limits(double mu, double u, double v, Inertia inertia) {
  const double r = std::clamp(inertia.gamma * (mu * mu) / inertia.chi, std::numeric_limits<double>::min(), 1e100);
  const double m = v > 0 ? pade_sliding_coefficient(r, v / (mu * u)) : 0;
  constexpr long double pi = std::numbers::pi_v<long double>;
  const long double pivoting = 8 * static_cast<long double>(u) / (static_cast<long double>(inertia.gamma) * mu);
  const long double sliding = 3 * pi * v / (2 * static_cast<long double>(inertia.chi));
  return pivoting + sliding * m;
}

bool positive(double value) { return value > 0 && std::isfinite(value); }

void require_positive(const char* name, double value) {
  if (!positive(value)) {
    throw std::domain_error(fmt::format("pade_stop_time: {} must be positive and finite, got {}", name, value));
  }
}

/// Speeds, mu, chi and gamma between 1/large and large need no scaling.
constexpr double large = 0x1p300;

}  // namespace

double pade_stop_time(double mu, State start, Inertia inertia) {
  const double u = std::abs(start.u);
  const double v = start.v;
  const double largest = std::max(u, v);
  const bool ordinary = mu > 1 / large && mu < large && largest > 1 / large && largest < large && v >= 0 &&
                        inertia.chi > 0 && inertia.chi < large && inertia.gamma > 0 && inertia.gamma < large;
  if (ordinary) return static_cast<double>(sum_of_limits(mu, u, v, inertia));

  require_positive("mu", mu);
  require_positive("chi", inertia.chi);
  require_positive("gamma", inertia.gamma);
  require_state("pade_stop_time", start);
  if (largest == 0) return 0;
  const int exponent = std::ilogb(largest);
  const long double tau = sum_of_limits(mu, std::ldexp(u, -exponent), std::ldexp(v, -exponent), inertia);
  return static_cast<double>(std::ldexp(tau, exponent));
}

}  // namespace contensou::reduction
