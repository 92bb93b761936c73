#include "contensou/si/contact_cone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/elliptic_law.hpp"
#include "contensou/si/ball_motion.hpp"
#include "contensou/si/scaling.hpp"

// With F = f N Phi and M = c N Psi a cone's motion is that of (2.6) for a patch of radius c/f whose Psi(0) is 1:
//
//     dv/ds = -Phi,   dw/ds = -r Psi,   w = mu |u|,   mu = c/(f R),   r = gamma mu^2/chi,   k = v/w = f v/(c |omega|),
//
// and of all (Phi, Psi) of the cone that one acts for which Phi v + Psi w, the power over f N, is greatest.
//
// Ellipse, Phi^2 + Psi^2 <= 1. The greatest is normal to the ellipse: the law elliptic:1.
//
// Box, Phi <= 1, Psi <= 1. Its corner, whatever v and w: the slip lasts S(v0), the spin P(u0), the limits of that law.
//
// Pyramid, Phi + Psi <= 1. A linear function is greatest at a corner: (1, 0) for k > 1, where the ball slides and its
// spin is frozen, and (0, 1) for k < 1, where it spins and its slip is frozen. Each takes k to 1 and neither beyond.
// There every point of the edge dissipates alike, and of those only Phi = r Psi = r/(1 + r) keeps k = 1: v and w fall
// together, v = (c/f) |omega|, until both are 0. So a ball that starts with k > 1 slides until v = w0 and then has the
// slip (c/f) |omega| as long as it spins: it rolls when the spin ends and not before. On the ray dv/ds = -r/(1 + r):
// from v = w the stop takes v (1 + r)/r = v + w/r, in tau S(v) + P(u), and so it does from any start:
//
//     s - s0 = v0 + w0/r                                                     the sum of what the box takes the larger of

namespace contensou::si {

namespace {

using reduction::ReducedSystem;

FadeTimes fade_times(const Experiment& experiment, const BallMotion& motion) {
  return {motion.slip_time(faded * slip_at_start(experiment)),
          motion.spin_time(faded * std::abs(spin_at_start(experiment)))};
}

/// Under the pyramid, in tau.
FadeTimes pyramid_times(const ReducedSystem& system, double u0, double v0) {
  const double mu = system.mu();
  const double u = faded * u0;
  const double v = faded * v0;
  const double whole = system.sliding_limit(v0) + system.pivoting_limit(u0);
  // On the ray v = mu u, or before it at the start's u0 or v0.
  const auto on_ray = [&](double speed) {
    return whole - system.sliding_limit(speed) - system.pivoting_limit(speed / mu);
  };
  return {v >= mu * u0 ? system.sliding_limit(v0 - v) : on_ray(v),
          mu * u >= v0 ? system.pivoting_limit(u0 - u) : on_ray(mu * u)};
}

}  // namespace

std::string_view name(Cone cone) {
  switch (cone) {
    case Cone::elliptic:
      return "elliptic";
    case Cone::box:
      return "box";
    default:
      return "pyramid";
  }
}

FadeTimes fade_times(const Experiment& experiment, const reduction::Law& law) {
  return fade_times(experiment, BallMotion(experiment, law));
}

FadeTimes fade_times(const Experiment& experiment, Cone cone, double moment_arm) {
  require_experiment(experiment);
  if (!(moment_arm >= 0) || std::isinf(moment_arm)) {
    throw std::domain_error(
        fmt::format("fade_times: the moment arm must be >= 0 and finite, in m; got {}", moment_arm));
  }
  const auto [u, v0] = reduced_start(experiment);
  const double u0 = std::abs(u);
  const double mu = moment_arm / experiment.contact.friction / experiment.ball.radius;
  const ReducedSystem system(reduction::EllipticLaw(1), mu > 0 ? mu : 1);  // where mu is 0, its sliding is asked for
  FadeTimes tau{system.sliding_limit((1 - faded) * v0), system.pivoting_limit((1 - faded) * u0)};
  if (mu == 0) {
    tau.spin = std::numeric_limits<double>::infinity();
  } else if (cone == Cone::elliptic) {
    return fade_times(experiment, BallMotion(experiment, reduction::Flow(system)));
  } else if (cone == Cone::pyramid) {
    tau = pyramid_times(system, u0, v0);
  }
  return {v0 > 0 ? seconds(experiment, tau.slip) : 0, u0 > 0 ? seconds(experiment, tau.spin) : 0};
}

SlipAndSpin speeds_under_pyramid(const Experiment& experiment, double moment_arm, double t) {
  const auto [u0, v0] = reduced_start(experiment);
  const double mu = moment_arm / experiment.contact.friction / experiment.ball.radius;
  const ReducedSystem system(reduction::EllipticLaw(1), mu);
  const double w0 = mu * std::abs(u0);
  const double w = std::min(v0, w0);  // where the ray begins
  const double ray = seconds(experiment, system.sliding_limit(v0 - w) + system.pivoting_limit((w0 - w) / mu));
  const double stop = seconds(experiment, system.sliding_limit(v0) + system.pivoting_limit(u0));
  const auto fallen = [&](double from) {
    if (t < ray) return from - (from - w) * (t / ray);
    return t < stop ? w * ((stop - t) / (stop - ray)) : 0.0;
  };
  return {fallen(v0), std::copysign(fallen(w0) / mu / experiment.ball.radius, u0)};
}

}  // namespace contensou::si
