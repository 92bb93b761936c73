#pragma once

#include <limits>

namespace contensou::fit {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace contensou::fit
