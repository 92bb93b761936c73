#include "fit/flow_orbit.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace contensou::fit {

namespace {

constexpr double step_of_logarithm = 1e-4;  // truncation and rounding are both 1e-8
constexpr double little = 1e-8;             // of the other speed
constexpr double tau_per_T = 3 * std::numbers::pi / 2;

const reduction::Flow& solved(std::optional<reduction::Flow>& flow, const reduction::ReducedSystem& system,
                              double ln_mu) {
  if (!flow) flow.emplace(reduction::ReducedSystem(system.law(), system.mu() * std::exp(ln_mu), system.inertia()));
  return *flow;
}

Speeds halved_difference(const Speeds& more, const Speeds& less) {
  return 1 / (2 * step_of_logarithm) * (more + -1 * less);
}

}  // namespace

const reduction::Flow& FlowsOfPatch::larger() const { return solved(larger_, here.system(), step_of_logarithm); }
const reduction::Flow& FlowsOfPatch::smaller() const { return solved(smaller_, here.system(), -step_of_logarithm); }

FlowOrbit::FlowOrbit(std::shared_ptr<const FlowsOfPatch> flows, reduction::State start)
    : flows_(std::move(flows)),
      start_{.u = start.u, .v = std::abs(start.v)},
      side_(start.v < 0 ? -1 : 1),
      on_axis_(start.u == 0 || start.v == 0),
      orbit_(flows_->here.orbit(start_)) {}

reduction::Orbit FlowOrbit::orbit_of(const reduction::Flow& flow, double ln_ratio) const {
  const double root = std::exp(ln_ratio / 2);
  return flow.orbit({.u = start_.u / root, .v = start_.v * root});
}

void FlowOrbit::solve_neighbours() const {
  if (more_) return;
  if (on_axis_) {
    const double u = little * start_.v, v = little * std::abs(start_.u);
    more_.emplace(flows_->here.orbit({.u = start_.u == 0 ? u : start_.u, .v = start_.v == 0 ? v : start_.v}));
  } else {
    more_.emplace(orbit_of(flows_->here, 2 * step_of_logarithm));
    less_.emplace(orbit_of(flows_->here, -2 * step_of_logarithm));
  }
  larger_.emplace(flows_->larger().orbit(start_));
  smaller_.emplace(flows_->smaller().orbit(start_));
}

Speeds FlowOrbit::speeds_of(const reduction::Orbit& orbit, double T) const {
  const reduction::Orbit::Instant at = orbit.instant(std::min(T * tau_per_T, orbit.stop_time()));
  return {side_ * at.v, at.u, side_ * at.slip_length / tau_per_T, at.turned / tau_per_T};
}

Speeds FlowOrbit::speeds_at(double T, std::size_t& /*cell*/) const { return speeds_of(orbit_, T); }

FilmOrbit::Moment FlowOrbit::at(double T, std::size_t& cell) const {
  Moment result{};
  if (start_.u == 0 && start_.v == 0) {
    if (T == 0) result.by_v.v = result.by_u.u = 1;
    return result;
  }
  solve_neighbours();
  const Speeds& now = result.now = speeds_at(T, cell);
  if (now.v != 0 || now.u != 0) {
    const reduction::Rate rate = flows_->here.system().field({.u = now.u, .v = std::abs(now.v)});
    result.dv = side_ * rate.v * tau_per_T;
    result.du = rate.u * tau_per_T;
  }
  result.by_ln_mu = halved_difference(speeds_of(*larger_, T), speeds_of(*smaller_, T));
  // What both speeds of the start do together, by the symmetry.
  const Speeds by_scale{now.v - T * result.dv, now.u - T * result.du, 2 * now.slid - T * now.v,
                        2 * now.turned - T * now.u};
  const double v0 = side_ * start_.v, u0 = start_.u;
  if (on_axis_) {
    const Speeds beside = speeds_of(*more_, T);
    if (u0 == 0) {
      result.by_v = 1 / v0 * by_scale;
      result.by_u = 1 / (little * start_.v) * Speeds{0, beside.u, 0, beside.turned};
    } else {
      result.by_u = 1 / u0 * by_scale;
      result.by_v = side_ / (little * std::abs(u0)) * Speeds{beside.v, 0, beside.slid, 0};
    }
    return result;
  }
  const Speeds by_ratio = halved_difference(speeds_of(*more_, T), speeds_of(*less_, T));
  result.by_v = 0.5 / v0 * (by_scale + by_ratio);
  result.by_u = 0.5 / u0 * (by_scale + -1 * by_ratio);
  return result;
}

FilmOrbit::Stop FlowOrbit::stop() const {
  if (start_.u == 0 && start_.v == 0) return {};
  solve_neighbours();
  const auto T_of = [](const reduction::Orbit& orbit) { return orbit.stop_time() / tau_per_T; };
  const auto difference = [&](const reduction::Orbit& more, const reduction::Orbit& less) {
    return (T_of(more) - T_of(less)) / (2 * step_of_logarithm);
  };
  Stop result{.T = T_of(orbit_), .by_ln_mu = difference(*larger_, *smaller_), .by_v = 0, .by_u = 0};
  const double v0 = side_ * start_.v, u0 = start_.u;
  if (u0 == 0) {
    result.by_v = result.T / v0;
  } else if (v0 == 0) {
    result.by_u = result.T / u0;
  } else {
    const double by_ratio = difference(*more_, *less_);
    result.by_v = (result.T + by_ratio) / (2 * v0);
    result.by_u = (result.T - by_ratio) / (2 * u0);
  }
  return result;
}

}  // namespace contensou::fit
