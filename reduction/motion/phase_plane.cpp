#include "contensou/reduction/phase_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/planar_kinds.hpp"
#include "system/balance.hpp"

namespace contensou::reduction {

using std::numbers::pi;

namespace {

/// Returns dD/dk at a zero k of D = Phi - rho - r k Psi, k neither 0 nor infinity, by differences in ln k.
double excess_slope(const Law& law, double r, double k) {
  const double ln_k = std::log(k);
  const auto excess = [&](double x) { return Balance::of(law, r, 0, std::exp(x)).difference(); };
  const auto central = [&](double h) { return (excess(ln_k + h) - excess(ln_k - h)) / (2 * h); };

  constexpr double at_kink = 1e-6;
  if (std::abs(ln_k) < at_kink) {
    // The slope is infinite if the difference across the kink grows as the step shrinks.
    const double fine = central(at_kink);
    const double coarse = central(100 * at_kink);
    return fine > 1.01 * coarse ? infinity : fine / k;
  }
  // The differences have order 8 and use points on one side of k = 1 only.
  constexpr std::array weights{4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
  const double h = std::min(0.02, std::abs(ln_k) / 20);
  double slope = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double step = h * static_cast<double>(i + 1);
    slope += weights[i] * (excess(ln_k + step) - excess(ln_k - step)) / h;
  }
  return slope / k;
}

/// Returns the kind by the signs of the eigenvalues, which are known even if the eigenvalues underflow.
std::string_view kind_of(bool attracts_radially, double attracts_angularly) {
  if (attracts_angularly == 0) return planar_kind("degenerate");
  if (attracts_radially != (attracts_angularly > 0)) return planar_kind("saddle");
  return attracts_radially ? planar_kind("stable node") : planar_kind("unstable node");
}

}  // namespace

std::string_view name(InvariantDirection direction) {
  constexpr std::array<std::string_view, 3> names{"v = 0", "ray", "u = 0"};
  return names[static_cast<std::size_t>(direction)];
}

std::string_view name(SingularPlace place) { return place == SingularPlace::origin ? "origin" : "infinity"; }

PhasePlane phase_plane(const Flow& flow) {
  const ReducedSystem& system = flow.system();
  const Law& law = system.law();
  const double mu = system.mu();
  const double r = system.r();
  const auto [chi, gamma] = system.inertia();
  const TerminalRatios& terminal = flow.terminal();
  // weight of beta in (2.8) divided by (mu u)^2
  const auto weight = [](double k) { return (16 + 15 * pi * k) * (8 + 3 * pi * k); };

  // Returns the sign of 1 - r/limit; 0 if r and limit are equal within the tolerance.
  const auto sign_below = [r](double limit) {
    return std::abs(r - limit) <= TerminalRatios::tolerance * limit ? 0.0 : r < limit ? 1.0 : -1.0;
  };
  const double below_low = sign_below(terminal.low);
  const double below_high = sign_below(terminal.high);

  const double body_scale = std::sqrt(chi / gamma);
  PhasePlane plane{terminal, body_scale * std::sqrt(terminal.low), body_scale * std::sqrt(terminal.high), {}, {}};
  // Adds the two singular points of a half-line, and the tangent if orbits end there. fall is the rate at which the
  // speed along the half-line falls, relative to the speed. order is the relative rate of the angle beside the
  // half-line, divided by fall. attraction is the sign of order.
  const auto add = [&](InvariantDirection direction, double k, double fall, double order, double attraction) {
    for (SingularPlace place : {SingularPlace::origin, SingularPlace::infinity}) {
      const bool at_origin = place == SingularPlace::origin;
      const double radial = at_origin ? -fall : fall;
      plane.points.push_back({direction, place, k, mu * k, radial, -fall * order, kind_of(at_origin, attraction)});
    }
    if (std::ranges::count(terminal.ends, k, &TerminalRatio::k) > 0) {
      plane.tangents.push_back({direction, k, std::max(0.0, order)});
    }
  };

  // Rates by theory.md (R18), (R19). They underflow if mu is tiny, but the orders do not.
  const double sliding_rate = 2 * chi / (3 * pi);
  const double pivoting_rate = 2 * gamma * mu / (3 * pi);
  const double moment = law.pivoting_moment();
  if (system.drive() == 0) {
    add(InvariantDirection::pivoting, 0, pivoting_rate * moment * mu * mu * weight(0),
        below_low == 0 ? 0 : law.force_slope() / (r * moment) - 1, below_low);
  }
  for (const InvariantRay& ray : terminal.rays) {
    const double drag = law(slip_of_ratio(ray.k)).moment;
    const double sign = ray.attracts_above != ray.attracts_below ? 0 : ray.attracts() ? 1 : -1;
    add(InvariantDirection::ray, ray.k, pivoting_rate * drag * mu * mu * weight(ray.k),
        sign == 0 ? 0 : excess_slope(law, r, ray.k) / (r * drag), sign);
  }
  add(InvariantDirection::sliding, infinity, sliding_rate * 45 * pi * pi * (1 - system.drive()),
      below_high == 0 ? 0 : r / terminal.high - 1, -below_high);
  return plane;
}

}  // namespace contensou::reduction
