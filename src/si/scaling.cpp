#include "contensou/si/scaling.hpp"

#include <numbers>

namespace contensou::si {

double patch_ratio(const Experiment& experiment, const reduction::Law& law) {
  return patch_radius_of(experiment, law) / experiment.ball.radius;
}

reduction::State reduced_start(const Experiment& experiment) {
  return {.u = experiment.ball.radius * spin_at_start(experiment), .v = slip_at_start(experiment)};
}

reduction::ReducedSystem reduced_system(const Experiment& experiment, const reduction::Law& law) {
  require_experiment(experiment);
  return {law, patch_ratio(experiment, law), experiment.ball.body.inertia};
}

double seconds(const Experiment& experiment, double tau) {
  // One factor at a time: f g may underflow.
  return tau * (2 / (3 * std::numbers::pi)) / experiment.contact.friction / experiment.environment.gravity;
}

}  // namespace contensou::si
