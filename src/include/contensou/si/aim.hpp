#pragma once

#include <optional>

#include "contensou/reduction/flow.hpp"
#include "contensou/si/cue_strike.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::si {

/// What a start is to come to by the time when slip and spin end, with rolling friction when nothing moves any more: two of
/// the three.
struct Goal {
  std::optional<double> distance;  ///< m, of the centre
  std::optional<double> turns;     ///< about the vertical, of either sign
  std::optional<double> time;      ///< s
};

/// The one slip with a spin, without rolling at the start, that comes to the goal (reduction::aimed). With rolling
/// friction there is one where turns are among them: verified, not proved (reduction/README.md).
/// @param flow  of undriven_system(experiment, law); of the experiment its start is not used
/// @throws std::domain_error  unless two are given, finite, distance and time >= 0; where no start comes to both, with what
///                            is nearest; for distance and time with rolling friction, and for a slope
SlipAndSpin aimed(const Experiment& experiment, const reduction::Flow& flow, const Goal& goal);

/// The level stroke of a standard cue that gives a ball this slip and spin, struck(ball, it): at the height of the centre,
/// to the side. None for a body that lies flat, without slip, and where the tip would slip off the ball.
std::optional<CueStrike> level_strike(const Ball& ball, const SlipAndSpin& start);

}  // namespace contensou::si
