#pragma once

#include <Eigen/Core>

/// Linear algebra of matrices of any size. Only one source compiles Eigen's templates, which takes seconds.
namespace contensou::reduction {

/// The singular value decomposition U diag(values) V^T of a matrix, with thin U and V.
struct SingularValues {
  explicit SingularValues(const Eigen::MatrixXd& matrix);

  /// Returns the least-squares solution of least norm, using the largest singular values only.
  /// @param rank  number of singular values used
  Eigen::VectorXd solution(const Eigen::VectorXd& right, Eigen::Index rank) const;

  Eigen::VectorXd values;  ///< decreasing
  Eigen::MatrixXd U, V;
};

/// Returns the solution of matrix x = right, by LU with partial pivots.
Eigen::VectorXd solution(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// Returns the least-squares solution of matrix x = right, of least norm if there are several.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

Eigen::MatrixXd product(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right);
Eigen::VectorXd product(const Eigen::MatrixXd& left, const Eigen::VectorXd& right);

}  // namespace contensou::reduction
