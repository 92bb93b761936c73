#pragma once

#include "contensou/si/experiment.hpp"

namespace contensou::si {

/// Mass of a cue of 19 oz in kg.
inline constexpr double standard_cue_mass = 0.54;

/// A stroke with a cue that points along x. The tip hits the ball off its centre, as seen along the cue.
struct CueStrike {
  double speed;                     ///< speed of the cue, m/s, > 0
  double right;                     ///< offset to the right of the centre, in radii of the ball
  double above;                     ///< offset above the centre, in radii of the ball
  double elevation;                 ///< elevation of the cue's butt in degrees, 0 <= elevation < 90
  double mass = standard_cue_mass;  ///< mass of the cue, kg, > 0
};

/// Offset of the tip from the centre, in radii of the ball, above which the tip slips off.
inline constexpr double largest_tip_offset = 0.5;

/// Computes the velocities that a stroke gives to a ball at rest.
///
/// The cue is a rod of mass M and speed s at the elevation e. Its elastic impulse P acts along the cue; the tip has no
/// friction. The cue points along d = (cos e, 0, -sin e). The tip is at r = -c d - a y + b n, with the offsets a
/// (right), b (above) and c (along the cue), and n = (sin e, 0, cos e). For J = m R^2/gamma
///   m V = P d,  J omega = r x P d = P (a sin e, b, a cos e).
/// The points of contact separate as fast as they met. Therefore
///   P = 2 m s/(1 + m/M + gamma (a^2 + b^2)/R^2).
/// The table takes the downward part of V. The friction of the table during the impact is left out. The model is that
/// of W. Leckie and M. Greenspan, "An event-based pool physics simulator", LNCS 4250 (2006) 247,
/// doi:10.1007/11922155_19. Their b is measured in the vertical plane.
///
/// @throws std::domain_error  if a value is out of its range, or the tip slips off the ball
Velocities struck(const Ball& ball, const CueStrike& strike);

}  // namespace contensou::si
