#pragma once

#include <limits>

#include "contensou/reduction/detail/infinity.hpp"

using contensou::infinity;
inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double eps = std::numeric_limits<double>::epsilon();
