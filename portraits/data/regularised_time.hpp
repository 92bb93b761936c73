#pragma once

#include <Eigen/Core>

#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// Returns true if a motion is one orbit of a flow and therefore has a regularised time. A ball that, under
/// rolling friction, turns during only a part of its motion has several orbits.
bool is_one_orbit(const reduction::Flow& flow, const PortraitOrbit& motion);

/// Returns the regularised time beta (reduction::ReducedSystem) since the first state, for each state of an orbit, in
/// the inverse of the unit of speed; infinity at the stop. Empty for a motion that is not one orbit.
Eigen::ArrayXd regularised_times(const reduction::Flow& flow, const PortraitOrbit& motion);

}  // namespace contensou::portraits
