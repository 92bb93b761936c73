#include "contensou/reduction/verification.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "system/balance.hpp"

namespace contensou::reduction {

namespace {

double size(Rate rate) { return std::hypot(rate.u, rate.v); }

}  // namespace

double generator_residual(const std::function<Rate(State)>& field, int degree, State state) {
  // Fourth-order central difference of F(exp(h) x) in h: truncation 1e-11, rounding 1e-13.
  constexpr double h = 1e-3;
  const auto along = [&](double step) { return field({std::exp(step) * state.u, std::exp(step) * state.v}); };
  const Rate far_ahead = along(2 * h), ahead = along(h), behind = along(-h), far_behind = along(-2 * h);
  const Rate here = field(state);
  const auto residual = [&](double Rate::*part) {
    const double derivative = (8 * (ahead.*part - behind.*part) - (far_ahead.*part - far_behind.*part)) / (12 * h);
    return derivative - degree * here.*part;
  };
  return size({residual(&Rate::u), residual(&Rate::v)}) / size(here);
}

double field_symmetry_residual(const ReducedSystem& system, State state) {
  return generator_residual([&](State at) { return system.field(at); }, 0, state);
}

double regularised_symmetry_residual(const ReducedSystem& system, State state) {
  return generator_residual([&](State at) { return system.regularised_field(at); }, 2, state);
}

double slope_symmetry_residual(const ReducedSystem& system, State state) {
  // The two partial derivatives use other difference quotients than the derivative along the group. The steps are
  // short, because the exact law has no third derivative at k = 1.
  constexpr double h = 2e-5;
  const auto partial = [&](double du, double dv) {
    const auto at = [&](double step) { return system.slope({state.u * (1 + step * du), state.v * (1 + step * dv)}); };
    return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
  };
  return std::abs(partial(1, 0) + partial(0, 1)) / std::abs(system.slope(state));
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
