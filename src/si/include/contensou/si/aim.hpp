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
///                            is nearest, and none in doubles does to 1e-6; for distance and time with rolling friction, for
///                            a slope, and as reduction::require_monotone
SlipAndSpin aimed(const Experiment& experiment, const reduction::Flow& flow, const Goal& goal);

/// Where a ball is to begin to roll, its slip below rolling_slip, and how.
struct RollingGoal {
  double place;     ///< m from the start, > 0
  double speed;     ///< m/s with which it rolls on in the end, >= 0; 0: it stays there
  double spin = 0;  ///< rad/s about the vertical, at the start
};

/// The one start along x that comes to the goal with a slip forwards. In a frame that moves with the speed the centre is
/// carried by the slip alone, and of two such starts with one spin that with the greater slip slips on faster, turns on
/// faster and so begins to roll later: were the slips equal at some instant, the faster spin would brake its slip less,
/// and likewise for equal spins. So the place grows with the slip, from 0 to any.
/// Accuracy  what Motion's instant when it rolls has, 1e-12 of its stop time: so 1e-9 of the place but for a start whose
///           slip is just above rolling_slip and whose spin lasts long. A steel ball with 1e4 rad/s that rolls on at 10 m/s
///           after 1 cm is off by 1.5e-8.
/// @param flow  as above
/// @throws std::domain_error  for a goal out of its range, a body that lies flat, rolling friction and a slope, where the
///                            start in doubles is off by more than 1e-6 of the place, and as reduction::require_monotone
Velocities aimed_to_roll(const Experiment& experiment, const reduction::Flow& flow, const RollingGoal& goal);

/// The level stroke of a standard cue that gives a ball this start along x, struck(ball, it). None for a body that lies
/// flat, for a centre that does not move forwards, and where the tip would slip off the ball.
std::optional<CueStrike> level_strike(const Ball& ball, const Velocities& start);

}  // namespace contensou::si
