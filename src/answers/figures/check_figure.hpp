#pragma once

#include <string>

#include "answers/verbs/check_against.hpp"
#include "contensou/portraits/figure.hpp"

namespace contensou::answers {

/// Draws slip and spin of a table against time, with the motion under the law. A model nearer to the table is dashed.
/// @param ball  name of the ball
portraits::Figure check_figure(const MotionsBeside& motions, const std::string& ball, const portraits::AskedSize& size);

}  // namespace contensou::answers
