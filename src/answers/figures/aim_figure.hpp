#pragma once

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

}  // namespace contensou::answers
