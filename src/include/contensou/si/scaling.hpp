#pragma once

#include "contensou/reduction/reduced_system.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::si {

/// The scaling between SI and the paper's variables; speeds and tau are in m/s.

/// mu = eps/R. Throws as patch_radius_of.
double patch_ratio(const Experiment& experiment, const reduction::Law& law);

/// u = R omega_z, v = slip.
reduction::State reduced_start(const Experiment& experiment);

/// The reduced system of the ball or body.
/// @throws std::domain_error  as require_experiment and patch_radius_of
reduction::ReducedSystem reduced_system(const Experiment& experiment, const reduction::Law& law);

/// Seconds that a tau of m/s lasts: t = 2 tau/(3 pi f g).
double seconds(const Experiment& experiment, double tau);

}  // namespace contensou::si
