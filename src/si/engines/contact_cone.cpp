#include "contensou/si/contact_cone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"

// Let F = f N Phi be the force and M = c N Psi the moment under the load N. The motion under a cone is then that of
// (2.6) in reduction/theory.md for a patch of radius c/f with Psi(0) = 1, in the time s = chi f g t:
//     dv/ds = -Phi,   dw/ds = -r Psi,   w = mu |u|,   mu = c/(f R),   r = gamma mu^2/chi,   k = v/w = f v/(c |omega|),
//
// The friction is the pair (Phi, Psi) of the cone for which Phi v + Psi w, the power divided by f N, is largest.
//
// Ellipse, Phi^2 + Psi^2 <= 1. At the maximum the velocity is normal to the ellipse. This is the law elliptic:1.
//
// Box, Phi <= 1, Psi <= 1. The maximum is always the corner (1, 1): in s, the slip ends after v0, the spin after w0/r.
//
// Pyramid, Phi + Psi <= 1. A linear function is largest at a corner. For k > 1 it is (1, 0): the ball slides and its
// spin is constant. For k < 1 it is (0, 1): the ball spins and its slip is constant. Both motions move k to 1. At k = 1
// every point of the edge has the same power, and only Phi = r Psi = r/(1 + r) keeps k = 1: v and w fall together, v =
// (c/f) |omega|, until both are 0. A ball that starts with k > 1 therefore slides until v = w0. Its slip is then (c/f)
// |omega| until the spin ends, and the ball does not roll before. On the ray k = 1, dv/ds = -r/(1 + r). From v = w on,
// the motion lasts v (1 + r)/r = v + w/r; in tau this is S(v) + P(u), the sum of the times of pure sliding and pure
// pivoting. This sum is the stop time from any start. Under the box the stop time is the larger of the two times. In s
// the sum is
//     s - s0 = v0 + w0/r
//
// Points: n points at c/f from the middle, each with the load N/n. If the body turns often while its slip changes
// little, the mean of the friction over a turn acts. This mean is the law ring for this radius, with mu = c/(f R).

namespace contensou::si {

namespace {

using reduction::ReducedSystem;

constexpr double turn = 2 * std::numbers::pi;

FadeTimes fade_times(const Experiment& experiment, const Motion& motion) {
  return {.slip = motion.slip_time(faded * slip_at_start(experiment)),
          .spin = motion.spin_time(faded * std::abs(spin_at_start(experiment))),
          .slip_length = motion.slip_length(),
          .turns = std::abs(motion.turns())};
}

double mu_of(const Experiment& experiment, double moment_arm) {
  return moment_arm / experiment.contact.friction / experiment.ball.radius;
}

/// The motion under the pyramid. First v or w falls at a constant rate until v = w; then both fall.
class PyramidMotion {
 public:
  PyramidMotion(const Experiment& experiment, double mu)
      : v0(slip_at_start(experiment)), w0(mu * std::abs(reduced_start(experiment).u)), on_ray_(std::min(v0, w0)) {
    const ReducedSystem system(reduction::EllipticLaw(1), mu, experiment.ball.body.inertia);
    ray_ = seconds(experiment, system.sliding_limit(v0 - on_ray_) + system.pivoting_limit((w0 - on_ray_) / mu));
    stop_ = seconds(experiment, system.sliding_limit(v0) + system.pivoting_limit(w0 / mu));
  }

  /// Returns v or w at the time t. `from` is the value of the same speed at the start.
  double speed(double from, double t) const {
    if (t < ray_) return from - (from - on_ray_) * (t / ray_);
    return t < stop_ ? on_ray_ * ((stop_ - t) / (stop_ - ray_)) : 0;
  }

  /// Returns the time at which v or w has fallen from `from` at the start to `speed`.
  double time(double from, double speed) const {
    return speed >= on_ray_ ? ray_ * ((from - speed) / (from - on_ray_)) : stop_ - (stop_ - ray_) * (speed / on_ray_);
  }

  /// Returns the integral of v or w over time. `from` is the value of the same speed at the start.
  double integral(double from) const { return ((from + on_ray_) * ray_ + on_ray_ * (stop_ - ray_)) / 2; }

  double v0;  ///< slip at the start, m/s
  double w0;  ///< rim speed at the start, m/s

 private:
  double on_ray_;  ///< v and w at the time at which they become equal, m/s
  double ray_;     ///< time at which v and w become equal, s
  double stop_;    ///< stop time, s
};

}  // namespace

std::string_view name(Cone cone) {
  switch (cone) {
    case Cone::elliptic:
      return "elliptic";
    case Cone::box:
      return "box";
    case Cone::points:
      return "points";
    default:
      return "pyramid";
  }
}

FadeTimes fade_times(const Experiment& experiment, const reduction::Law& law) {
  return fade_times(experiment, Motion::reduced(experiment, law));
}

FadeTimes fade_times(const Experiment& experiment, Cone cone, double moment_arm) {
  require_experiment(experiment);
  if (!(moment_arm >= 0) || std::isinf(moment_arm)) {
    throw std::domain_error(
        fmt::format("fade_times: the moment arm must be >= 0 and finite, in m; got {}", moment_arm));
  }
  const auto [u, v0] = reduced_start(experiment);
  const double u0 = std::abs(u);
  const double spin = std::abs(spin_at_start(experiment));
  const double mu = mu_of(experiment, moment_arm);
  const bool is_law = cone == Cone::elliptic || cone == Cone::points;
  const reduction::Law law =
      cone == Cone::points ? *reduction::find_law("ring") : reduction::Law(reduction::EllipticLaw(1));
  const ReducedSystem system(law, mu > 0 ? mu : 1,
                             experiment.ball.body.inertia);  // for mu = 0 any mu will do: only sliding is used
  if (mu > 0 && is_law) return fade_times(experiment, Motion::reduced(experiment, reduction::Flow(system)));
  if (mu > 0 && cone == Cone::pyramid) {
    const PyramidMotion motion(experiment, mu);
    return {.slip = v0 > 0 ? motion.time(v0, faded * v0) : 0,
            .spin = u0 > 0 ? motion.time(motion.w0, faded * motion.w0) : 0,
            .slip_length = motion.integral(v0),
            .turns = motion.integral(motion.w0) / (mu * experiment.ball.radius) / turn};
  }
  const double slides = seconds(experiment, system.sliding_limit(v0));
  double spins = 0;
  if (u0 > 0) {
    spins = mu > 0 ? seconds(experiment, system.pivoting_limit(u0)) : std::numeric_limits<double>::infinity();
  }
  return {.slip = (1 - faded) * slides,
          .spin = (1 - faded) * spins,
          .slip_length = v0 * slides / 2,
          .turns = spin > 0 ? spin * spins / 2 / turn : 0};
}

SlipAndSpin speeds_under_pyramid(const Experiment& experiment, double moment_arm, double t) {
  const double mu = mu_of(experiment, moment_arm);
  const PyramidMotion motion(experiment, mu);
  const double spin = motion.speed(motion.w0, t) / mu / experiment.ball.radius;
  return {motion.speed(motion.v0, t), std::copysign(spin, spin_at_start(experiment))};
}

}  // namespace contensou::si
