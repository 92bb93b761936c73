#pragma once

#include <Eigen/Core>

namespace contensou::reduction {

/// Returns exp(A) of a real 2 x 2 matrix. For a diagonal matrix each entry is accurate to its last bits.
Eigen::Matrix2d matrix_exponential(const Eigen::Matrix2d& matrix);

}  // namespace contensou::reduction
