#include "contensou/si/shot.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/si/quantity.hpp"

namespace contensou::si {

namespace {

/// What depends on how the patch is given: its radius, its checks, its words.
struct RadiusOf {
  const Shot& shot;

  double operator()(PatchRadius patch) const { return patch.value; }

  double operator()(SpinDeceleration measured) const {
    return patch_radius_of_deceleration(shot.ball.radius, measured.value, shot.contact.friction,
                                        shot.environment.gravity);
  }

  double operator()(const HertzModuli& moduli) const {
    return hertz_patch_radius(shot.ball.mass * shot.environment.gravity, shot.ball.radius, moduli);
  }
};

struct Require {
  void operator()(PatchRadius patch) const { require(patch_radius, patch.value); }
  void operator()(SpinDeceleration measured) const { require(spin_deceleration, measured.value); }
  void operator()(const HertzModuli& moduli) const {
    for (double value : moduli.youngs_modulus) require(youngs_modulus, value);
    for (double value : moduli.poisson_ratio) require(poisson_ratio, value);
  }
};

struct RequireStart {
  void operator()(const SlipAndSpin& start) const {
    require(slip, start.slip);
    require(spin, start.spin);
  }
  void operator()(const Velocities& start) const {
    for (double part : start.velocity) require(velocity, part);
    for (double part : start.angular_velocity) require(angular_velocity, part);
  }
};

struct VelocitiesOf {
  Velocities operator()(const SlipAndSpin& start) const { return {{start.slip, 0}, {0, 0, start.spin}}; }
  Velocities operator()(const Velocities& start) const { return start; }
};

struct Origin {
  std::string operator()(PatchRadius) const { return "given"; }
  std::string operator()(SpinDeceleration measured) const {
    return fmt::format("from a spin deceleration of {} rad/s^2", measured.value);
  }
  std::string operator()(const HertzModuli&) const { return "from Hertz's formula"; }
};

}  // namespace

double patch_radius_of(const Shot& shot) { return std::visit(RadiusOf{shot}, shot.contact.patch); }

Velocities velocities_of(const Start& start) { return std::visit(VelocitiesOf{}, start); }

Eigen::Vector2d slip_velocity_at_start(const Shot& shot) {
  const auto [centre, body] = velocities_of(shot.start);
  const double R = shot.ball.radius;
  return {centre.x() - R * body.y(), centre.y() + R * body.x()};
}

double slip_at_start(const Shot& shot) {
  const Eigen::Vector2d contact = slip_velocity_at_start(shot);
  return std::hypot(contact.x(), contact.y());
}

double spin_at_start(const Shot& shot) { return velocities_of(shot.start).angular_velocity.z(); }

void require_shot(const Shot& shot) {
  require(mass, shot.ball.mass);
  require(radius, shot.ball.radius);
  require(friction, shot.contact.friction);
  std::visit(Require{}, shot.contact.patch);
  std::visit(RequireStart{}, shot.start);
  require(gravity, shot.environment.gravity);

  const double patch = patch_radius_of(shot);
  if (!(patch > 0 && patch <= shot.ball.radius)) {
    throw std::domain_error(
        fmt::format("the patch radius must be above 0 and at most the ball's radius {} m, got {} m ({})",
                    shot.ball.radius, patch, std::visit(Origin{}, shot.contact.patch)));
  }
  if (!std::isfinite(shot.ball.radius * spin_at_start(shot))) {
    throw std::domain_error(
        fmt::format("radius times spin must be finite, got {} m * {} rad/s", shot.ball.radius, spin_at_start(shot)));
  }
  if (!std::isfinite(slip_at_start(shot))) {
    throw std::domain_error(
        fmt::format("the velocity of the contact point must be finite: radius {} m and these velocities overflow",
                    shot.ball.radius));
  }
}

}  // namespace contensou::si
