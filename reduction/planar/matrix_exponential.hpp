#pragma once

#include <Eigen/Core>

namespace contensou::reduction {

/// exp(A) of a real 2 x 2 matrix. Each entry of a diagonal one's to its last bits, whatever the others are.
Eigen::Matrix2d matrix_exponential(const Eigen::Matrix2d& matrix);

}  // namespace contensou::reduction
