#pragma once

#include <vector>

#include "contensou/fit/fit.hpp"

namespace contensou::fit {

/// Returns the spin, rad/s, at which a mark turns by half a turn between two pictures: Turns::half_turn_spin.
double half_turn_spin(const Track& track);

/// Adds whole turns to the angles of all tracks. A mark shows its angle only up to whole turns, and the ball may turn
/// by more than half a turn between two pictures.
///
/// Each angle is continued at its last rate. The first rate is found by trial: up to two turns more or fewer between
/// two pictures, and the turns that follow from the given spin of the ball. Each track takes the turns of the best fit;
/// among equally good fits, the slowest spin. A measured spin determines the turns without a trial.
/// @param request  its tracks satisfy require(); their angles are changed
std::vector<Turns> set_turns(FitRequest& request);

}  // namespace contensou::fit
