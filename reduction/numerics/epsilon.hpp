#pragma once

#include <limits>

namespace contensou::reduction {

inline constexpr double eps = std::numeric_limits<double>::epsilon();

}  // namespace contensou::reduction
