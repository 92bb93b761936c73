#pragma once

#include <vector>

#include "contensou/fit/fit.hpp"

namespace contensou::fit {

/// Returns the spin at which a mark turns by half a turn between two pictures, rad/s: Turns::half_turn_spin.
double half_turn_spin(const Track& track);

/// Adds whole turns to the angles of all tracks. A mark shows its angle up to whole turns, and the ball may turn by
/// more than half a turn between two pictures.
///
/// Each angle continues at the last rate. The first rate is found by trial: up to two turns more or fewer between two
/// pictures, and the turns by the spin of the ball as given. Each track takes the best fit; among equally good fits,
/// the slowest spin. A measured spin determines the turns without a trial.
/// @param request  its tracks satisfy require(); their angles are changed
std::vector<Turns> set_turns(FitRequest& request);

}  // namespace contensou::fit
