#include "contensou/si/experiment.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/quantity.hpp"

namespace contensou::si {

double effective_modulus(const HertzModuli& moduli) {
  const auto compliance = [&](std::size_t body) {
    const double nu = moduli.poisson_ratio[body];
    return (1 - nu) * (1 + nu) / moduli.youngs_modulus[body];
  };
  return 1 / (compliance(0) + compliance(1));
}

double hertz_patch_radius(double normal_force, double ball_radius, const HertzModuli& moduli) {
  const double bend = 1 + ball_radius / moduli.counter_radius;  // R/R'
  if (!(bend > 0)) {
    throw std::domain_error(fmt::format(
        "counter_radius {} m is a dish no wider than the ball of radius {} m, which then touches it in no one "
        "patch: below {} it is wider",
        moduli.counter_radius, ball_radius, -ball_radius));
  }
  return std::cbrt(0.75 * normal_force * (ball_radius / bend) / effective_modulus(moduli));
}

double patch_radius_of_deceleration(double ball_radius, double deceleration, double dry_friction,
                                    double acceleration_of_gravity, double pivoting_moment, double gamma) {
  return ball_radius * ball_radius * deceleration / (gamma * dry_friction * acceleration_of_gravity * pivoting_moment);
}

Body Body::with_factor(double of_m_R2) const {
  const bool flat = lies_flat();
  const double most = flat ? 1 : 2.0 / 3;
  constexpr double rounding = 1e-3;  // 0.667 is 2/3, which has no decimals that end
  if (of_m_R2 > most && of_m_R2 <= most * (1 + rounding)) of_m_R2 = most;
  if (!(of_m_R2 > 0 && of_m_R2 <= most)) {
    throw std::domain_error(fmt::format(
        "the inertia of a {}, over m R^2, must be above 0 and at most {}, as of a {} with R the radius; got {}", name,
        flat ? "1" : "2/3", flat ? "ring" : "hollow-ball", of_m_R2));
  }
  Body changed = *this;
  changed.factor = of_m_R2;
  changed.inertia = {.chi = flat ? 1 : 1 + 1 / of_m_R2, .gamma = 1 / of_m_R2};
  return changed;
}

std::string Body::complaint(double mu) const {
  if (patch_ratio) return mu == *patch_ratio ? "" : "a puck rests on its whole face, so mu is 1: leave --mu out";
  if (rolls_on_a_small_patch) return mu > 0 && mu <= 1 ? "" : "0 < mu <= 1 is required";
  return mu > 0 ? "" : "mu > 0 is required";
}

const std::vector<Body>& bodies() {
  static const std::vector<Body> named{
      {},
      {.name = "hollow-ball", .inertia = {.chi = 2.5, .gamma = 1.5}},
      {"disc", {.chi = 1, .gamma = 2}, 1.0, false, "uniform"},
      {"puck", {.chi = 1, .gamma = 2}, 1.0, false, "uniform"},
      {"ring", {.chi = 1, .gamma = 1}, 1.0, false, "ring"},
  };
  return named;
}

static_assert(gravity.standard == Environment{}.gravity && rolling_friction.standard == 0 && slope.standard == 0);

double pressing(const Environment& environment) {
  const double degrees = environment.slope;
  return degrees == 0 ? environment.gravity : environment.gravity * std::cos(degrees * (std::numbers::pi / 180));
}

Eigen::Vector2d pull(const Environment& environment) {
  const double degrees = environment.slope;
  return {degrees == 0 ? 0 : -environment.gravity * std::sin(degrees * (std::numbers::pi / 180)), 0};
}

bool mass_is_known(const Ball& ball) { return !std::isnan(ball.mass); }

double mass_for(std::string_view user, const Ball& ball) {
  if (mass_is_known(ball)) return ball.mass;
  throw std::domain_error(
      fmt::format("the mass is not known; {} needs it; give mass (--mass, or 'mass' in [ball])", user));
}

double* member_of(Experiment& experiment, const Quantity& quantity) {
  const std::pair<const Quantity*, double*> members[]{{&mass, &experiment.ball.mass},
                                                      {&radius, &experiment.ball.radius},
                                                      {&friction, &experiment.contact.friction},
                                                      {&rolling_friction, &experiment.contact.rolling_friction},
                                                      {&slope, &experiment.environment.slope}};
  const auto* const found = std::ranges::find(members, &quantity, &std::pair<const Quantity*, double*>::first);
  return found == std::end(members) ? nullptr : found->second;
}

std::vector<GivenQuantity> given_by(Experiment experiment) {
  std::vector<GivenQuantity> given;
  for (const Quantity* quantity : quantities()) {
    if (const auto& factor = experiment.ball.body.factor; quantity == &inertia_factor && factor)
      given.push_back({quantity, {*factor}});
    if (quantity == &mass && !mass_is_known(experiment.ball)) continue;
    const double* const member = member_of(experiment, *quantity);
    if (member && quantity != &slope && quantity->standard != *member) given.push_back({quantity, {*member}});
  }
  const auto add = [&](const Quantity& quantity, const auto&... values) { given.push_back({&quantity, {values...}}); };
  const PatchSource& patch = experiment.contact.patch;
  if (const auto* radius_given = std::get_if<PatchRadius>(&patch)) add(patch_radius, radius_given->value);
  if (const auto* measured = std::get_if<SpinDeceleration>(&patch)) add(spin_deceleration, measured->value);
  if (const auto* moduli = std::get_if<HertzModuli>(&patch)) {
    add(youngs_modulus, moduli->youngs_modulus[0], moduli->youngs_modulus[1]);
    add(poisson_ratio, moduli->poisson_ratio[0], moduli->poisson_ratio[1]);
    if (std::isfinite(moduli->counter_radius)) add(counter_radius, moduli->counter_radius);
  }
  if (const auto* along_x = std::get_if<SlipAndSpin>(&experiment.start)) {
    add(slip, along_x->slip);
    add(spin, along_x->spin);
  } else {
    const auto& [centre, body] = std::get<Velocities>(experiment.start);
    add(velocity, centre.x(), centre.y());
    add(angular_velocity, body.x(), body.y(), body.z());
  }
  if (const auto& newtons = experiment.environment.load) {
    add(load, *newtons);
  } else {
    add(gravity, experiment.environment.gravity);
  }
  if (experiment.environment.slope != slope.standard) add(slope, experiment.environment.slope);
  return given;
}

std::string origin_of(const PatchSource& patch) {
  if (std::holds_alternative<PatchRadius>(patch)) return "given";
  if (const auto* moduli = std::get_if<HertzModuli>(&patch)) {
    return std::isfinite(moduli->counter_radius)
               ? fmt::format("by Hertz's formula on a surface of radius {} m", moduli->counter_radius)
               : "by Hertz's formula";
  }
  if (std::holds_alternative<WholeFace>(patch)) return "its whole face";
  return fmt::format("from its spin deceleration {} rad/s^2", std::get<SpinDeceleration>(patch).value);
}

std::string law_of(const Experiment& experiment) {
  return experiment.contact.law.empty() ? std::string(experiment.ball.body.law) : experiment.contact.law;
}

double patch_radius_of(const Experiment& experiment, const reduction::Law& law) {
  const auto& [ball, contact, start, environment, spreads] = experiment;
  double patch = 0;
  if (const auto* given = std::get_if<PatchRadius>(&contact.patch)) {
    patch = given->value;
  } else if (std::holds_alternative<WholeFace>(contact.patch)) {
    patch = ball.radius;
  } else if (const auto* measured = std::get_if<SpinDeceleration>(&contact.patch)) {
    // A spin deceleration is measured while the ball spins in place, on a level plane.
    patch = patch_radius_of_deceleration(ball.radius, measured->value, contact.friction, environment.gravity,
                                         law.pivoting_moment(), ball.body.inertia.gamma);
  } else {
    patch = hertz_patch_radius(mass_for("Hertz's formula", ball) * pressing(environment), ball.radius,
                               std::get<HertzModuli>(contact.patch));
  }
  if (patch > 0 && patch <= ball.radius) return patch;
  throw std::domain_error(
      fmt::format("the patch radius must be above 0 and at most the ball's radius {} m, got {} m ({}, under law {})",
                  ball.radius, patch, origin_of(contact.patch), law.name()));
}

Velocities velocities_of(const Start& start) {
  if (const auto* along_x = std::get_if<SlipAndSpin>(&start)) return {{along_x->slip, 0}, {0, 0, along_x->spin}};
  return std::get<Velocities>(start);
}

Experiment without_spin(Experiment experiment) {
  Velocities start = velocities_of(experiment.start);
  start.angular_velocity.z() = 0;
  experiment.start = start;
  return experiment;
}

Eigen::Vector2d slip_velocity_at_start(const Experiment& experiment) {
  const auto [centre, body] = velocities_of(experiment.start);
  const double R = experiment.ball.radius;
  // A sum that is only the rounding of its terms becomes 0. Velocities of pure rolling therefore have the slip 0.
  const auto sum = [](double a, double b) {
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    return std::abs(a + b) <= rounding * std::abs(a) ? 0 : a + b;
  };
  return {sum(centre.x(), -R * body.y()), sum(centre.y(), R * body.x())};
}

double slip_at_start(const Experiment& experiment) {
  const Eigen::Vector2d contact = slip_velocity_at_start(experiment);
  return std::hypot(contact.x(), contact.y());
}

double spin_at_start(const Experiment& experiment) { return velocities_of(experiment.start).angular_velocity.z(); }

void require_experiment(const Experiment& experiment) {
  for (const auto& [quantity, values] : given_by(experiment)) {
    for (double value : values) require(*quantity, value);
  }
  require(gravity, experiment.environment.gravity);
  if (experiment.environment.load && experiment.environment.slope != 0) {
    throw std::domain_error(
        "a load and a slope exclude each other: how hard gravity pulls down the slope is not said; "
        "give gravity, or no slope");
  }
  if (experiment.ball.body.lies_flat()) {
    if (experiment.contact.rolling_friction != 0) {
      throw std::domain_error(fmt::format("a {} lies flat and never rolls: it has no rolling friction, got {}",
                                          experiment.ball.body.name, experiment.contact.rolling_friction));
    }
    if (std::holds_alternative<HertzModuli>(experiment.contact.patch)) {
      throw std::domain_error(fmt::format(
          "a {} lies flat, and the formula of Hertz needs a ball; give patch_radius, or nothing for the whole face",
          experiment.ball.body.name));
    }
    const Eigen::Vector2d turning = velocities_of(experiment.start).angular_velocity.head<2>();
    if (turning != Eigen::Vector2d::Zero()) {
      throw std::domain_error(
          fmt::format("a {} lies flat and turns about the vertical only; got an angular velocity of {}, {}, ... rad/s",
                      experiment.ball.body.name, turning.x(), turning.y()));
    }
  } else if (std::holds_alternative<WholeFace>(experiment.contact.patch)) {
    throw std::domain_error("a ball has no face to lie on: give the patch");
  }

  if (!std::holds_alternative<SpinDeceleration>(experiment.contact.patch))
    patch_radius_of(experiment, reduction::HertzLaw{});
  if (!std::isfinite(experiment.ball.radius * spin_at_start(experiment))) {
    throw std::domain_error(fmt::format("radius times spin must be finite, got {} m * {} rad/s", experiment.ball.radius,
                                        spin_at_start(experiment)));
  }
  if (!std::isfinite(slip_at_start(experiment))) {
    throw std::domain_error(
        fmt::format("the velocity of the contact point must be finite: radius {} m and these velocities overflow",
                    experiment.ball.radius));
  }
}

void require_finite_motion(const Experiment& experiment, double braked, double last) {
  constexpr double largest = std::numeric_limits<double>::max() / 100;
  const Velocities start = velocities_of(experiment.start);
  // Upper bounds of all speeds (m/s) and rates of turning (1/s).
  const double speed =
      start.velocity.stableNorm() + std::max(1.0, experiment.ball.radius) * start.angular_velocity.stableNorm();
  const double allowed = std::min({std::sqrt(largest / std::max(1.0, experiment.ball.mass)),
                                   std::sqrt(largest) * std::sqrt(speed / braked), largest / last});
  if (speed == 0 || speed <= allowed) return;
  throw std::domain_error(
      fmt::format("at speeds of {:.2g} (m/s, 1/s) lengths, angles or energies exceed the largest double; up to "
                  "{:.2g} is allowed",
                  speed, allowed));
}

Velocities struck(const Ball& ball, const CueStrike& strike) {
  const auto& [speed, right, above, elevation, cue_mass] = strike;
  const double offset = std::hypot(right, above);
  if (ball.body.lies_flat())
    throw std::domain_error(fmt::format(
        "a {} lies flat and turns about the vertical only; a cue strikes balls: give slip and spin", ball.body.name));
  if (!(speed > 0 && std::isfinite(speed)))
    throw std::domain_error(fmt::format("a cue's speed must be positive, in m/s; got {}", speed));
  if (!(cue_mass > 0 && std::isfinite(cue_mass)))
    throw std::domain_error(fmt::format("a cue's mass must be positive, in kg; got {}", cue_mass));
  if (!(elevation >= 0 && elevation < 90))
    throw std::domain_error(fmt::format("a cue's elevation must be 0 to below 90 degrees; got {}", elevation));
  if (!(offset <= largest_tip_offset)) {
    throw std::domain_error(fmt::format("the tip slips off the ball {} radii from its centre: at most {} are allowed",
                                        offset, largest_tip_offset));
  }
  const double gamma = ball.body.inertia.gamma;
  const double ball_speed =
      2 * speed / (1 + mass_for("a cue's stroke", ball) / cue_mass + gamma * offset * offset);  // P/m of struck
  const double turning = gamma * ball_speed / ball.radius;
  const double angle = elevation * (std::numbers::pi / 180), sine = std::sin(angle), cosine = std::cos(angle);
  return {{ball_speed * cosine, 0}, {turning * right * sine, turning * above, turning * right * cosine}};
}

}  // namespace contensou::si
