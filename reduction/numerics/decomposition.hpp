#pragma once

#include <Eigen/Core>

namespace contensou::reduction {

/// The singular value decomposition U diag(values) V^T of a matrix, with thin U and V.
struct SingularValues {
  explicit SingularValues(const Eigen::MatrixXd& matrix);

  /// Returns the least-squares solution of least norm that uses the largest singular values only.
  /// @param rank  number of singular values that are used
  Eigen::VectorXd solution(const Eigen::VectorXd& right, Eigen::Index rank) const;

  Eigen::VectorXd values;  ///< decreasing
  Eigen::MatrixXd U, V;
};

/// Returns the solution of matrix x = right, by LU with partial pivots.
Eigen::VectorXd solution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// Returns the least-squares solution of matrix x = right; if there are several, the one of least norm.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// Returns a basis of the same space with as many zeros as elimination can produce. Vectors are columns. In the result
/// each vector has an entry 1 at which all others are 0. The largest entries are taken as pivots.
Eigen::MatrixXd echelon(Eigen::MatrixXd basis);

Eigen::MatrixXd product(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right);
Eigen::VectorXd product(const Eigen::MatrixXd& left, const Eigen::VectorXd& right);

/// Returns exp(A) of a real 2 x 2 matrix. For a diagonal matrix each entry is accurate to its last bits.
Eigen::Matrix2d matrix_exponential(const Eigen::Matrix2d& matrix);

}  // namespace contensou::reduction
