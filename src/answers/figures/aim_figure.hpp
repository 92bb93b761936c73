#pragma once

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/aim.hpp"

namespace contensou::answers {

/// The plane of what starts come to, distance and turns, each of whose points has one start: lines of equal time, slip
/// and spin of the start over it, and the point that was asked for. Scaling moves its points along lines through 0, on
/// which k of the start is the same: each line is a copy of one of its family.
/// @throws std::domain_error  as si::aimed
portraits::Figure aim_figure(const si::Experiment& ball, const reduction::Law& law, const si::Goal& goal,
                             const portraits::AskedSize& size);

}  // namespace contensou::answers
