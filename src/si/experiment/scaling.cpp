#include "contensou/si/scaling.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::si {

double patch_ratio(const Experiment& experiment, const reduction::Law& law) {
  return patch_radius_of(experiment, law) / experiment.ball.radius;
}

reduction::State reduced_start(const Experiment& experiment) {
  return {.u = experiment.ball.radius * spin_at_start(experiment), .v = slip_at_start(experiment)};
}

reduction::ReducedSystem reduced_system(const Experiment& experiment, const reduction::Law& law) {
  require_experiment(experiment);
  return {law, patch_ratio(experiment, law), experiment.ball.body.inertia, drive_of(experiment)};
}

reduction::ReducedSystem undriven_system(const Experiment& experiment, const reduction::Law& law) {
  require_experiment(experiment);
  return {law, patch_ratio(experiment, law), experiment.ball.body.inertia};
}

Drives drives_along(const Experiment& experiment, const Eigen::Vector2d& along, double chi) {
  const auto& [ball, contact, start, environment, spreads] = experiment;
  const double steepness = pull(environment).dot(along) / pressing(environment);
  return {steepness / (chi * contact.friction), contact.rolling_friction / contact.friction};
}

bool points_along(const Eigen::Vector2d& vector, const Eigen::Vector2d& along) {
  constexpr double parallel = 1e-12;
  return vector.dot(along) >= (1 - parallel) * vector.norm();
}

Eigen::Vector2d direction_at_start(const Experiment& experiment) {
  const Eigen::Vector2d slip = slip_velocity_at_start(experiment);
  if (const double v = slip_at_start(experiment); v > 0) return slip / v;
  const Eigen::Vector2d velocity = velocities_of(experiment.start).velocity;
  if (const double V = velocity.stableNorm(); V > 0) return velocity / V;
  return {experiment.environment.slope > 0 ? -1 : 1, 0};
}

bool is_driven(const Experiment& experiment) {
  return experiment.contact.rolling_friction != 0 || experiment.environment.slope != 0;
}

double drive_of(const Experiment& experiment) {
  if (!is_driven(experiment)) return 0;
  const auto& [ball, contact, start, environment, spreads] = experiment;
  require_stop(experiment);
  const Eigen::Vector2d along = direction_at_start(experiment);
  const double v = slip_at_start(experiment);
  const Eigen::Vector2d rolling =
      velocities_of(start).velocity - (v > 0 ? slip_velocity_at_start(experiment) : Eigen::Vector2d(0, 0));
  const char* const integrated = ": no reduced system has this motion; the whole motion (roll) is integrated";
  if (!points_along(rolling, along)) {
    throw std::domain_error(fmt::format(
        "with rolling friction {} and a slope of {} degrees a ball must roll the way it slides, or not at all{}",
        contact.rolling_friction, environment.slope, integrated));
  }
  if (environment.slope != 0 && !points_along(pull(environment), along)) {
    throw std::domain_error(
        fmt::format("on a slope of {} degrees along x it must slide straight down, "
                    "got a slip in the direction ({:.3g}, {:.3g}), which the slope slows or turns{}",
                    environment.slope, along.x(), along.y(), integrated));
  }
  const double drive = drives_along(experiment, along, ball.body.inertia.chi).turning();
  return drive < reduction::ReducedSystem::least_drive ? 0 : drive;
}

void require_stop(const Experiment& experiment) {
  const auto& [ball, contact, start, environment, spreads] = experiment;
  if (environment.slope == 0) return;
  // Slope and rolling resistance both drive a body that turns. A held body slides like a puck: only the slope drives.
  const double chi = ball.body.inertia.chi, friction = contact.friction, u_r = contact.rolling_friction;
  const double most = (chi - 1) * friction > chi * u_r ? chi * (friction - u_r) : friction;
  const double angle = std::atan(most) * (180 / std::numbers::pi);
  if (std::abs(environment.slope) < angle) return;
  throw std::domain_error(fmt::format(
      "on a slope of {} degrees a {} never stops sliding: the pull is more than friction {} holds; less than "
      "{:.4g} degrees is needed",
      environment.slope, ball.body.name, friction, angle));
}

void require_undriven(const Experiment& experiment, std::string_view what) {
  if (!is_driven(experiment)) return;
  throw std::domain_error(
      fmt::format("{} takes neither rolling friction nor a slope: "
                  "rolling_friction and slope must be 0, got {} and {} degrees",
                  what, experiment.contact.rolling_friction, experiment.environment.slope));
}

double seconds(const Experiment& experiment, double tau) {
  // Divide by one factor after the other, because the product f g may underflow.
  return tau * (2 / (3 * std::numbers::pi)) / experiment.contact.friction / pressing(experiment.environment);
}

}  // namespace contensou::si
