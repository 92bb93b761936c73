#pragma once

#include <optional>

#include "contensou/reduction/flow.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::si {

/// Demands on a motion: two of distance, turns and time. Each is counted until slip and spin end, or, with rolling
/// friction, until the ball rests.
struct Goal {
  std::optional<double> distance;  ///< path of the centre, m
  std::optional<double> turns;     ///< turns about the vertical, of either sign
  std::optional<double> time;      ///< time, s
};

/// Finds the one start, without rolling, that fulfils two demands (reduction::aimed). Under rolling friction one demand
/// must be the turns; that the start is unique is then tested, not proved (reduction/numerics.md).
/// @param experiment  its start is not used
/// @param flow        flow of undriven_system(experiment, law)
/// @throws std::domain_error  unless two demands are given, finite, with distance and time >= 0; if no start fulfils
///                            both (the message contains the nearest possible values); if no start with finite doubles
///                            fulfils them to 1e-6; for distance and time with rolling friction; for a slope;
///                            as require_monotone
SlipAndSpin aimed(const Experiment& experiment, const reduction::Flow& flow, const Goal& goal);

/// Demands on the place and the speed at which a ball begins to roll, that is, its slip falls below rolling_slip.
struct RollingGoal {
  double place;     ///< distance from the start to the place where rolling begins, m, > 0
  double speed;     ///< speed of the final rolling, m/s, >= 0; 0: the ball stops there
  double spin = 0;  ///< spin about the vertical at the start, rad/s
};

/// Finds the one start along x with forward slip that fulfils the demands.
///
/// The start is unique for this reason. In a frame that moves with the speed of the final rolling, the slip alone moves
/// the centre. Take two starts with the same spin. The start with the greater slip always slips and spins faster: if
/// the slips became equal, the faster spin would brake the slip less, and likewise for equal spins. This start
/// therefore begins to roll later, and the distance of the place grows with the slip, from 0 without limit.
///
/// Accuracy  1e-9 of the place, because Motion::rolls is accurate to 1e-12 of the stop time. It is lower if the slip at
///           the start is just above rolling_slip and the spin lasts long: 1.5e-8 for a steel ball with 1e4 rad/s that
///           rolls on at 10 m/s after 1 cm.
///
/// @param flow  flow of undriven_system(experiment, law)
/// @throws std::domain_error  if a demand is out of its range; for a body that lies flat, rolling friction or a
///                            slope; if doubles miss the place by more than a share of 1e-6; as require_monotone
Velocities aimed_to_roll(const Experiment& experiment, const reduction::Flow& flow, const RollingGoal& goal);

/// Returns the level stroke of a standard cue that gives a ball this start along x: struck(ball, stroke) returns the
/// start. Empty for a body that lies flat, for a start without forward velocity, and if the tip would slip off.
std::optional<CueStrike> level_strike(const Ball& ball, const Velocities& start);

}  // namespace contensou::si
