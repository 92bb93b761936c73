#pragma once

#include <vector>

#include "contensou/fit/fit.hpp"

namespace contensou::fit {

/// As in Turns.
double half_turn_spin(const Track& track);

/// Sets the angles of all tracks to the turn that they are of: a mark shows its angle up to whole turns, and from picture to
/// picture the ball may have turned by more than half a turn.
///
/// Turn by turn the angle goes on as it did last. How fast it begins, up to whole turns between two pictures, is tried:
/// two more and two fewer, and what the ball's own spin says; the best fit of each track counts, of equally good ones the slowest spin.
/// Where a spin is seen, too,
/// it decides.
/// @param request  with tracks as require() asks for them; their angles are changed
std::vector<Turns> set_turns(FitRequest& request);

}  // namespace contensou::fit
