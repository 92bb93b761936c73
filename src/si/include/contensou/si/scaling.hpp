#pragma once

#include <string_view>

#include "contensou/reduction/reduced_system.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::si {

/// The scaling between SI and the paper's variables; speeds and tau are in m/s.

/// mu = eps/R. Throws as patch_radius_of.
double patch_ratio(const Experiment& experiment, const reduction::Law& law);

/// u = R omega_z, v = slip.
reduction::State reduced_start(const Experiment& experiment);

/// The reduced system of the ball or body, with its drive.
/// @throws std::domain_error  as require_experiment, patch_radius_of and drive_of
reduction::ReducedSystem reduced_system(const Experiment& experiment, const reduction::Law& law);

/// The same without the slope's pull and without rolling resistance.
reduction::ReducedSystem undriven_system(const Experiment& experiment, const reduction::Law& law);

/// What drives the slip, over f N (reduction/README.md, (R53), (R54)).
struct Drives {
  double slope;    ///< tan(alpha)/(chi f), of a slope that falls the way the ball slides; negative where it rises
  double rolling;  ///< u_r/f
  double turning() const { return slope + rolling; }  ///< while it turns the way it slides
};

/// @param along  the direction of the slip
/// @param chi    1: of what is held and does not turn
Drives drives_along(const Experiment& experiment, const Eigen::Vector2d& along, double chi);

/// Whether a vector, or 0, points in that direction, to rounding.
/// @param along  of length 1
bool points_along(const Eigen::Vector2d& vector, const Eigen::Vector2d& along);

/// The direction of the slip at the start; where there is none, that in which it rolls or is pulled.
Eigen::Vector2d direction_at_start(const Experiment& experiment);

/// Returns whether rolling friction or a slope acts.
bool is_driven(const Experiment& experiment);

/// The drive rho of the motion from the start while the ball turns.
/// @throws std::domain_error  saying why there is none: up or across the slope, or if it does not roll the way it slides,
///                            the slip turns, and the motion is no orbit of a reduced system; as require_stop
double drive_of(const Experiment& experiment);

/// Rejects a slope on which what slides never stops.
/// @throws std::domain_error  with the angle up to which friction holds it
void require_stop(const Experiment& experiment);

/// Seconds that a tau of m/s lasts: t = 2 tau/(3 pi f g).
double seconds(const Experiment& experiment, double tau);

/// Rejects rolling friction and a slope, for an answer that knows none.
/// @param what  the answer
/// @throws std::domain_error  saying so
void require_undriven(const Experiment& experiment, std::string_view what);

}  // namespace contensou::si
