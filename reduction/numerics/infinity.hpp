#pragma once

#include <limits>

namespace contensou::reduction {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace contensou::reduction
