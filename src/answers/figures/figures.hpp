#pragma once

#include <string>

#include "answers/verbs/check_answer.hpp"
#include "contensou/fit/fit.hpp"
#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/aim.hpp"

namespace contensou::answers {

/// Draws the plane of distance and turns, in which each point is the result of exactly one start. It shows curves
/// of equal time, slip and spin of the start, and the demanded point. Scaling a start moves its point along a ray from
/// 0, on which k is constant. Therefore curves of equal slip are scaled copies; likewise for time and spin.
/// @throws std::domain_error  as si::aimed
portraits::Figure aim_figure(const si::Experiment& ball, const reduction::Law& law, const si::Goal& goal,
                             const portraits::AskedSize& size);

/// Draws slip and spin of a table against time, with the motion under the law. A model nearer to the table is dashed.
/// @param ball  name of the ball
portraits::Figure check_figure(const MotionsBeside& motions, const std::string& ball, const portraits::AskedSize& size);

/// Draws the data of tracks with the fitted motion, one observable beside the other, with the residuals below each. A
/// further panel shows the ellipses of 68 and 95 % confidence for friction and patch radius. For slip, spin and angle a
/// dashed line shows the motion of the uncoupled model from the same start, without rolling friction.
/// @param laws  laws that were compared; the law of the fit is one of them
/// @param size  requested size of the figure
portraits::Figure fit_figure(const fit::Fit& fit, const std::vector<reduction::Law>& laws,
                             const std::vector<fit::Track>& tracks, const portraits::AskedSize& size);

}  // namespace contensou::answers
