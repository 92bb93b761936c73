#include "contensou/si/cue_strike.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::si {

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
  const double velocity =
      2 * speed / (1 + mass_for("a cue's stroke", ball) / cue_mass + gamma * offset * offset);  // P/m of cue_strike.hpp
  const double spin = gamma * velocity / ball.radius;
  const double angle = elevation * (std::numbers::pi / 180), sine = std::sin(angle), cosine = std::cos(angle);
  return {{velocity * cosine, 0}, {spin * right * sine, spin * above, spin * right * cosine}};
}

}  // namespace contensou::si
