#include "contensou/reduction/flow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/detail/root.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;

OrbitPoint at_beta(const Orbit& orbit, double mu, State start, double beta) {
  if (!(beta >= 0)) throw std::domain_error(fmt::format("at_beta: beta must be >= 0, got {}", beta));
  const double stop = orbit.stop_time();
  if (beta == 0) return orbit.at_time(0);
  OrbitPoint found = orbit.at_time_left(0);
  if (std::isinf(beta) || stop == 0) return found;
  if (orbit.on_axis()) {
    // The speed that is not 0 falls linearly. In dtau = weight dbeta the weight is proportional to the square of this
    // speed. If the share f of the time is left, beta is (1 - f)/f times its value at f = 1/2.
    const double spent = beta / orbit.at_time_left(stop / 2).beta;
    if (std::isfinite(spent)) found = orbit.at_time_left(stop / (1 + spent));
  } else {
    // Towards the stop beta grows like 1/(time left), so ln beta is nearly linear in ln (time left).
    const double unit = 1 / (16 * mu * std::abs(start.u) + 15 * pi * start.v);
    const auto at = [&](double ln_share) { return orbit.at_time_left(std::min(stop * std::exp(ln_share), stop)); };
    const auto missing = [&](double ln_share) { return std::log(beta + unit) - std::log(at(ln_share).beta + unit); };
    constexpr double last = -700;  // a smaller share of the time underflows
    double low = -1;
    while (low > last && missing(low) > 0) low = std::max(2 * low, last);
    found = at(root_between(missing, low, 0, missing(low), std::log(beta + unit) - std::log(unit)));
  }
  found.beta = beta;
  return found;
}

}  // namespace

OrbitPoint at_beta(const Flow& flow, State start, double beta) {
  return at_beta(flow.orbit(start), flow.system().mu(), start, beta);
}

OrbitColumns at_betas(const Flow& flow, State start, const Eigen::ArrayXd& betas) {
  const Orbit orbit = flow.orbit(start);
  OrbitColumns columns(betas.size());
  for (Eigen::Index i = 0; i < betas.size(); ++i) {
    columns.set(i, at_beta(orbit, flow.system().mu(), start, betas[i]));
  }
  return columns;
}

}  // namespace contensou::reduction
