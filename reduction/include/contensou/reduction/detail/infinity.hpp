#pragma once

#include <limits>

namespace contensou {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace contensou
