// README (R61): moving the start along (u, v) scales the motion; moving the start along the field delays the motion.
#include "contensou/reduction/flow.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::reduction {

InstantGradient instant_gradient(const Flow& flow, State start, double tau) {
  const ReducedSystem& system = flow.system();
  require_state("instant_gradient", start);
  if (start.u == 0 || start.v == 0) {
    throw std::domain_error(fmt::format(
        "instant_gradient: a start with u not 0 and v > 0 is needed, got u = {}, v = {}", start.u, start.v));
  }
  const Orbit motion = flow.orbit(start);
  const Orbit::Instant at = motion.instant(tau);
  const Rate first = system.field(start);
  const Rate last = at.v > 0 || at.u != 0 ? system.field({at.u, at.v}) : Rate{0, 0};
  const double D = start.u * first.v - start.v * first.u;
  constexpr double clear = 1e-5;
  if (!(std::abs(D) > clear * std::max(std::abs(start.u * first.v), std::abs(start.v * first.u)))) {
    // Across a ray the state is as smooth as the law, so the gradient is the mean of two gradients beside the ray.
    for (double aside = 3 * clear; aside < 0.01; aside *= 3) {
      const State below{start.u, start.v * (1 - aside)}, above{start.u, start.v * (1 + aside)};
      const auto is_clear = [&](State beside) {
        const Rate rate = system.field(beside);
        return std::abs(beside.u * rate.v - beside.v * rate.u) > clear * std::abs(beside.v * rate.u);
      };
      if (!is_clear(below) || !is_clear(above)) continue;
      InstantGradient one = instant_gradient(flow, below, tau), other = instant_gradient(flow, above, tau);
      const auto mean = [](const InstantGradient::Part& a, const InstantGradient::Part& b, double value, double rate) {
        return InstantGradient::Part{value, (a.by_u + b.by_u) / 2, (a.by_v + b.by_v) / 2, rate};
      };
      return {mean(one.u, other.u, at.u, last.u), mean(one.v, other.v, at.v, last.v),
              mean(one.slip_length, other.slip_length, at.slip_length, at.v),
              mean(one.turned, other.turned, at.turned, at.u)};
    }
    throw std::domain_error(fmt::format(
        "instant_gradient: under law {} every k near that of u = {}, v = {} keeps what it is: no gradient by k",
        system.law().name(), start.u, start.v));
  }
  // Two derivatives by the start are known: along (u, v), a scaling, and along the field, a delay.
  const auto part = [&](double value, int degree, double rate, double later) {
    const double scaled = degree * value - tau * rate;
    return InstantGradient::Part{value, (scaled * first.v - start.v * later) / D,
                                 (start.u * later - first.u * scaled) / D, rate};
  };
  return {part(at.u, 1, last.u, last.u), part(at.v, 1, last.v, last.v), part(at.slip_length, 2, at.v, at.v - start.v),
          part(at.turned, 2, at.u, at.u - start.u)};
}

}  // namespace contensou::reduction
