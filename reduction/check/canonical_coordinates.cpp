#include "contensou/reduction/canonical_coordinates.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "system/balance.hpp"

namespace contensou::reduction {

Canonical to_canonical(State state) {
  require_state("to_canonical", state);
  if (state.u == 0 || state.v == 0) {
    throw std::domain_error(fmt::format(
        "to_canonical: the axes u = 0 and v = 0 are invariant and have no canonical coordinates, got u = {}, v = {}",
        state.u, state.v));
  }
  return {state.v / state.u, std::log(state.v)};
}

State from_canonical(Canonical point) {
  if (point.q == 0 || !std::isfinite(point.q) || !std::isfinite(point.p)) {
    throw std::domain_error(
        fmt::format("from_canonical: q must be finite and not 0, p finite; got q = {}, p = {}", point.q, point.p));
  }
  const double v = std::exp(point.p);
  return {v / point.q, v};
}

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
