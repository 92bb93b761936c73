#include "contensou/reduction/canonical_coordinates.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "system/balance.hpp"

namespace contensou::reduction {

double separated_slope(const ReducedSystem& system, double q) {
  if (q == 0 || !std::isfinite(q)) {
    throw std::domain_error(fmt::format("separated_slope: q must be finite and not 0, got {}", q));
  }
  // d ln v = -(Phi - rho) ds/v and d ln k = -(Phi - rho - r k Psi) ds/v (README (R2), (R48)), and q = mu k.
  const double k = std::abs(q) / system.mu();
  const Balance balance = Balance::of(system.law(), system.r(), system.drive(), k);
  return balance.force / (q * balance.difference());
}

}  // namespace contensou::reduction
