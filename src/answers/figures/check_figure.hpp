#pragma once

#include <string>

#include "answers/verbs/check_against.hpp"
#include "contensou/portraits/figure.hpp"

namespace contensou::answers {

/// Slip and spin of a table against time, with the motion under the law and, where another is nearest, that one dashed.
/// @param ball  its name
portraits::Figure check_figure(const MotionsBeside& motions, const std::string& ball, const portraits::AskedSize& size);

}  // namespace contensou::answers
