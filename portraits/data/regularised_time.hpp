#pragma once

#include <Eigen/Core>

#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// Returns true if a motion is one orbit of a flow, and so has a regularised time. A motion that rolling friction turns
/// only for a part of its time is not.
bool is_one_orbit(const reduction::Flow& flow, const PortraitOrbit& motion);

/// Returns the regularised time beta of (2.8) since the first state for each state of an orbit, in the inverse of the
/// unit of speed; infinity at the stop. Empty for a motion that is not one orbit.
Eigen::ArrayXd regularised_times(const reduction::Flow& flow, const PortraitOrbit& motion);

}  // namespace contensou::portraits
