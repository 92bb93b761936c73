#include "contensou/si/bridge.hpp"

#include <numbers>

namespace contensou::si {

double patch_ratio(const Shot& shot, const reduction::Law& law) {
  return patch_radius_of(shot, law) / shot.ball.radius;
}

reduction::State reduced_start(const Shot& shot) {
  return {.u = shot.ball.radius * spin_at_start(shot), .v = slip_at_start(shot)};
}

reduction::ReducedSystem reduced_system(const Shot& shot, const reduction::Law& law) {
  require_shot(shot);
  return {law, patch_ratio(shot, law)};
}

double seconds(const Shot& shot, double tau) {
  // One factor at a time: f g may underflow.
  return tau * (2 / (3 * std::numbers::pi)) / shot.contact.friction / shot.environment.gravity;
}

}  // namespace contensou::si
