// Helpers that the files of the portraits' data share.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace contensou::portraits {

inline std::vector<double> list(const Eigen::ArrayXd& values) { return {values.begin(), values.end()}; }

}  // namespace contensou::portraits
