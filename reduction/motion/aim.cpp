#include "contensou/reduction/aim.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "contensou/reduction/detail/root.hpp"
#include "numerics/epsilon.hpp"

namespace contensou::reduction {

namespace {

void require_level(const Flow& flow) {
  if (flow.system().drive() == 0) return;
  throw std::domain_error(fmt::format("aim: a motion without a drive is needed, got one of {}", flow.system().drive()));
}

void require_two(const Aim& aim) {
  int given = 0;
  for (const auto& asked : {aim.tau, aim.distance, aim.turned}) {
    if (!asked) continue;
    ++given;
    if (!(*asked >= 0 && std::isfinite(*asked)))
      throw std::domain_error(fmt::format("aim: what is asked for must be finite and >= 0, got {}", *asked));
  }
  if (given != 2)
    throw std::domain_error(fmt::format("aim: two of time, distance and turning are needed, got {}", given));
}

/// Returns the start with the given k at which the larger of the speeds v and w is 1.
State unit_start(const Flow& flow, double ln_k) {
  return {std::exp(std::min(0.0, -ln_k)) / flow.system().mu(), std::exp(std::min(0.0, ln_k))};
}

State scaled(State start, double factor) { return {start.u * factor, start.v * factor}; }

double square_root_of_ratio(double a, double b) { return std::sqrt(a) / std::sqrt(b); }

/// Return the start of pure sliding over a distance, and the start of pure pivoting through an angle.
State sliding_over(const Flow& flow, double distance) {
  return scaled({0, 1}, square_root_of_ratio(distance, reached(flow, {0, 1}).distance));
}
State pivoting_through(const Flow& flow, double turned) {
  return scaled({1, 0}, square_root_of_ratio(turned, reached(flow, {1, 0}).turned));
}

State axis_start(const Flow& flow, const Aim& aim) {
  return aim.distance ? sliding_over(flow, *aim.distance) : pivoting_through(flow, *aim.turned);
}

/// Returns true if the numbers of a motion equal the demands to 1e-6.
bool comes_to(const Reached& here, const Aim& aim) {
  const auto same = [](double got, const std::optional<double>& asked) {
    constexpr double close = 1e-6;
    return !asked || (std::isfinite(got) && std::abs(got - *asked) <= close * *asked);
  };
  return same(here.tau, aim.tau) && same(here.distance, aim.distance) && same(here.turned, aim.turned);
}

/// Returns the same start as `aimed`, without a test of whether it fulfils the demands.
std::optional<State> best_start(const Flow& flow, const Aim& aim) {
  // If one demand is 0, the motion lies on an axis.
  const bool in_place = aim.distance && *aim.distance == 0;
  const bool straight = aim.turned && *aim.turned == 0;
  if (in_place && straight) return State{0, 0};
  if (aim.tau) {
    if (in_place) return State{*aim.tau / flow.system().pivoting_limit(1), 0};
    if (straight) return State{0, *aim.tau / flow.system().sliding_limit(1)};
    const double least = least_time(flow, aim);
    constexpr double rounding = 16 * eps;
    if (*aim.tau < least * (1 - rounding)) return std::nullopt;
    if (*aim.tau <= least * (1 + rounding)) return axis_start(flow, aim);
  } else {
    if (in_place) return pivoting_through(flow, *aim.turned);
    if (straight) return sliding_over(flow, *aim.distance);
  }

  // A ratio of the demands is used: distance/turned, distance/tau^2 or tau^2/turned. The residual is the logarithm of
  // this ratio divided by the demanded one. It is independent of the start's scale, and it grows with k.
  const auto residual = [&](double ln_k) {
    const Reached here = reached(flow, unit_start(flow, ln_k));
    const double time = aim.tau ? 2 * std::log(here.tau / *aim.tau) : 0;
    const double distance = aim.distance ? std::log(here.distance / *aim.distance) : 0;
    const double turned = aim.turned ? std::log(here.turned / *aim.turned) : 0;
    return aim.distance ? distance - (aim.tau ? time : turned) : time - turned;
  };
  constexpr double widest = 640;  // up to this |ln k| the speeds and their product are doubles
  double low = 0, high = 0;
  double at_low = residual(0), at_high = at_low;
  for (double step = 1; at_low > 0 && low > -widest; step *= 2) {
    high = low, at_high = at_low;
    low = std::max(low - step, -widest), at_low = residual(low);
  }
  for (double step = 1; at_high < 0 && high < widest; step *= 2) {
    low = high, at_low = at_high;
    high = std::min(high + step, widest), at_high = residual(high);
  }
  if (at_low > 0 || at_high < 0) return axis_start(flow, aim);  // no double lies between this start and the axis
  const State start = unit_start(flow, root_between(residual, low, high, at_low, at_high));
  const Reached here = reached(flow, start);
  if (aim.distance) return scaled(start, square_root_of_ratio(*aim.distance, here.distance));
  return scaled(start, square_root_of_ratio(*aim.turned, here.turned));
}

}  // namespace

Reached reached(const Flow& flow, State start) {
  require_level(flow);
  const Orbit orbit = flow.orbit(start);
  const double tau = orbit.stop_time();
  const Orbit::Instant end = orbit.instant(tau);
  const double chi = flow.system().inertia().chi;
  return {tau, (1 - 1 / chi) * start.v * tau + end.slip_length / chi, std::abs(end.turned)};
}

double least_time(const Flow& flow, const Aim& aim) {
  require_level(flow);
  require_two(aim);
  return flow.stop_time(axis_start(flow, aim)).tau;
}

void require_monotone(const Law& law) {
  constexpr double from = 1e-6, to = 1e6, step = 1.1, noise = 1e-6;
  struct Extreme {
    double value, k;
  };
  Extreme force{0, 0}, moment{law.pivoting_moment(), 0};
  const auto refuse = [](const char* what, const char* does, const Extreme& before, const Extreme& now) {
    throw std::domain_error(fmt::format(
        "aim needs a force that does not fall and a moment that does not grow with k; this law's {} {} from "
        "{:.6g} at k = {:.6g} to {:.6g} at k = {:.6g}",
        what, does, before.value, before.k, now.value, now.k));
  };
  for (double k = from; k < to; k *= step) {
    const auto [phi, psi] = law(slip_of_ratio(k));
    if (phi < force.value * (1 - noise)) refuse("Phi", "falls", force, {phi, k});
    if (psi > moment.value * (1 + noise)) refuse("Psi", "grows", moment, {psi, k});
    if (phi > force.value) force = {phi, k};
    if (psi < moment.value) moment = {psi, k};
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (force.value > 1 + noise) refuse("Phi", "falls", force, {1, infinity});
}

std::optional<State> aimed(const Flow& flow, const Aim& aim) {
  require_level(flow);
  require_two(aim);
  require_monotone(flow.system().law());
  const std::optional<State> start = best_start(flow, aim);
  if (start && !(std::isfinite(start->u + start->v) && comes_to(reached(flow, *start), aim)))
    throw TooFarApart("aim: what is asked for is too far apart for a double");
  return start;
}

}  // namespace contensou::reduction
