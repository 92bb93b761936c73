#include "numerics/matrix_exponential.hpp"

#include <cmath>

#include <Eigen/LU>

namespace contensou::reduction {

Eigen::Matrix2d matrix_exponential(const Eigen::Matrix2d& matrix) {
  if (matrix(0, 1) == 0 && matrix(1, 0) == 0) {
    return Eigen::Vector2d(std::exp(matrix(0, 0)), std::exp(matrix(1, 1))).asDiagonal();
  }
  // Cayley and Hamilton: B = A - tr(A)/2 satisfies B^2 = d with a number d.
  const double half_trace = matrix.trace() / 2;
  const Eigen::Matrix2d b = matrix - half_trace * Eigen::Matrix2d::Identity();
  const double d = -b.determinant();
  const double root = std::sqrt(std::abs(d));
  double even = 1, odd = 1;  // cosh(root) and sinh(root)/root, but cos and sin for d < 0
  if (root > 1e-9) {
    even = d > 0 ? std::cosh(root) : std::cos(root);
    odd = (d > 0 ? std::sinh(root) : std::sin(root)) / root;
  }
  return std::exp(half_trace) * (even * Eigen::Matrix2d::Identity() + odd * b);
}

}  // namespace contensou::reduction
