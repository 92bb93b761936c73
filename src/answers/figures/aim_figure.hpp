#pragma once

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/aim.hpp"

namespace contensou::answers {

/// Draws the plane of distance and turns, in which each point is the result of exactly one start. It shows lines of
/// equal time, slip and spin of the start, and the demanded point. Scaling moves points along lines through 0, on which
/// k of the start is constant. So each line of a family is a scaled copy of the others.
/// @throws std::domain_error  as si::aimed
portraits::Figure aim_figure(const si::Experiment& ball, const reduction::Law& law, const si::Goal& goal,
                             const portraits::AskedSize& size);

}  // namespace contensou::answers
