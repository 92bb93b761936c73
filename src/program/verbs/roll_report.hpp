#pragma once

#include <string>

#include "options/roll_route.hpp"

namespace contensou::program {

/// `roll` on one screen: where and when the ball ceases to slip, how it rolls on, what friction took, and the
/// textbook's answer beside it. For the route integrated, how close its stop is.
std::string roll_report(const si::Shot& shot, const reduction::Law& law, RollRoute route, int digits);

}  // namespace contensou::program
