// What the data of the portraits share: arrays as lists of JSON, and infinity.
#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

namespace contensou::portraits {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline std::vector<double> list(const Eigen::ArrayXd& values) { return {values.begin(), values.end()}; }

}  // namespace contensou::portraits
