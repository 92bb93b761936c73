#include "contensou/si/bounce.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/si/experiment.hpp"
#include "contensou/si/motion.hpp"

namespace contensou::si {

namespace {

Rebound rebound(const Motion& motion, const Impact& impact, double rolling_below) {
  const MotionPoint last = motion.at(impact.impulse());
  return {{last.velocity, last.angular_velocity}, last.slip, motion.slip_time(rolling_below) / impact.impulse()};
}

}  // namespace

double drop_speed(double height, double gravity) { return std::sqrt(2 * gravity * height); }

double hertz_impact_patch_radius(double mass, double speed, double radius, const HertzModuli& moduli) {
  constexpr double mean = 0.89552187486943376;                             // B(1/2, 6/5)/2
  const double cube = std::pow(hertz_patch_radius(1, radius, moduli), 3);  // 3 R'/(4 E*), m^3/N
  const double joint = 4.0 / 3 * cube * effective_modulus(moduli);         // R'
  return mean * std::pow(1.25 * mass * speed * speed * joint * cube, 0.2);
}

Experiment pressed_in(const Impact& impact, const Experiment& experiment, const reduction::Law& law) {
  const auto& [normal_speed, restitution] = impact;
  if (!(std::isfinite(normal_speed) && normal_speed > 0))
    throw std::domain_error(
        fmt::format("a ball hits the plane at a normal speed above 0, in m/s; got {}", normal_speed));
  if (!(restitution >= 0 && restitution <= 1))
    throw std::domain_error(
        fmt::format("restitution is 0 to 1, the part of the normal speed that it goes up with; got {}", restitution));
  Experiment pressed = experiment;
  const auto* moduli = std::get_if<HertzModuli>(&experiment.contact.patch);
  pressed.contact.patch = PatchRadius{moduli ? hertz_impact_patch_radius(mass_for("Hertz's formula", experiment.ball),
                                                                         normal_speed, experiment.ball.radius, *moduli)
                                             : patch_radius_of(experiment, law)};
  pressed.environment = {.gravity = 1};
  pressed.contact.rolling_friction = 0;
  if (const double patch = std::get<PatchRadius>(pressed.contact.patch).value;
      moduli && !(patch > 0 && patch <= pressed.ball.radius))
    throw std::domain_error(fmt::format(
        "by Hertz's formula an impact at a normal speed of {} m/s presses a patch of {:.3g} m, and a ball of "
        "radius {} m has none: a patch above 0 and up to the radius is needed",
        normal_speed, patch, pressed.ball.radius));
  require_experiment(pressed);
  return pressed;
}

Rebound bounce(const Experiment& experiment, const reduction::Law& law, const Impact& impact, double rolling_below) {
  return rebound(Motion::reduced(pressed_in(impact, experiment, law), law), impact, rolling_below);
}

Rebound uncoupled_bounce(const Experiment& experiment, const reduction::Law& law, const Impact& impact,
                         double rolling_below) {
  return rebound(Motion::uncoupled(pressed_in(impact, experiment, law), law), impact, rolling_below);
}

}  // namespace contensou::si
