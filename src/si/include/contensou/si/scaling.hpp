#pragma once

#include <string_view>

#include "contensou/reduction/reduced_system.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::si {

// The scaling between SI units and the variables u, v, tau of reduction; u, v and tau are in m/s.

/// Returns mu = eps/R, the patch radius divided by the ball radius. Throws as patch_radius_of.
double patch_ratio(const Experiment& experiment, const reduction::Law& law);

/// Returns the start in the variables of reduction: u = R omega_z, v = slip.
reduction::State reduced_start(const Experiment& experiment);

/// Returns the reduced system of the ball or body, with its drive.
/// @throws std::domain_error  as require_experiment, patch_radius_of and drive_of
reduction::ReducedSystem reduced_system(const Experiment& experiment, const reduction::Law& law);

/// Returns the reduced system without the pull of a slope and without rolling resistance.
reduction::ReducedSystem undriven_system(const Experiment& experiment, const reduction::Law& law);

/// The drives of the slip, divided by f N (reduction/theory.md, (R21), (R22)).
struct Drives {
  double slope;    ///< tan(alpha)/(chi f) of a slope that falls in the direction of sliding; negative if it rises
  double rolling;  ///< u_r/f
  double turning() const { return slope + rolling; }  ///< drive while the body turns in the direction of sliding
};

/// Returns the drives along a direction of sliding.
/// @param along  direction of the slip
/// @param chi    chi of the body; 1 for a body that resistance holds, so that it does not turn
Drives drives_along(const Experiment& experiment, const Eigen::Vector2d& along, double chi);

/// Returns true if a vector points in a direction up to rounding, or is 0.
/// @param along  direction of length 1
bool points_along(const Eigen::Vector2d& vector, const Eigen::Vector2d& along);

/// Returns the direction of the slip at the start; without slip, the direction in which the ball rolls or is pulled.
Eigen::Vector2d direction_at_start(const Experiment& experiment);

/// Returns true if rolling friction or a slope acts.
bool is_driven(const Experiment& experiment);

/// Returns the drive rho of the motion from the start while the ball turns.
/// @throws std::domain_error  if the motion is not one reduced orbit: the ball slides up or across the slope, or
///                            not in the direction of rolling, so that the slip turns; as require_stop. The message
///                            contains the reason
double drive_of(const Experiment& experiment);

/// Throws for a slope on which a sliding body never stops.
/// @throws std::domain_error  with the largest angle at which friction stops the body
void require_stop(const Experiment& experiment);

/// Returns the time t in seconds for a tau in m/s: t = 2 tau/(3 pi f g).
double seconds(const Experiment& experiment, double tau);

/// Throws if rolling friction or a slope acts, on behalf of functions that do not allow them.
/// @param what  name of the function's result, for the message
/// @throws std::domain_error  with that name
void require_undriven(const Experiment& experiment, std::string_view what);

}  // namespace contensou::si
