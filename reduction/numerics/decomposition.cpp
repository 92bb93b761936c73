#include "numerics/decomposition.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

#include "numerics/epsilon.hpp"

namespace contensou::reduction {

using Eigen::MatrixXd;
using Eigen::VectorXd;

SingularValues::SingularValues(const MatrixXd& matrix) {
  const Eigen::JacobiSVD<MatrixXd, Eigen::HouseholderQRPreconditioner> svd(matrix,
                                                                           Eigen::ComputeThinU | Eigen::ComputeThinV);
  values = svd.singularValues();
  U = svd.matrixU();
  V = svd.matrixV();
}

VectorXd SingularValues::solution(const VectorXd& right, Eigen::Index rank) const {
  const VectorXd along = U.transpose() * right;
  VectorXd result = VectorXd::Zero(V.rows());
  for (Eigen::Index i = 0; i < rank; ++i) result += V.col(i) * (along[i] / values[i]);
  return result;
}

VectorXd solution(const MatrixXd& matrix, const VectorXd& right) { return matrix.partialPivLu().solve(right); }

VectorXd least_squares(const MatrixXd& matrix, const VectorXd& right) {
  const SingularValues svd(matrix);
  const double smallest = eps * static_cast<double>(matrix.cols()) * svd.values[0];
  return svd.solution(right, (svd.values.array() > smallest).count());
}

MatrixXd echelon(MatrixXd basis) {
  for (Eigen::Index i = 0; i < basis.cols(); ++i) {
    Eigen::Index row = 0, column = 0;
    basis.rightCols(basis.cols() - i).cwiseAbs().maxCoeff(&row, &column);
    basis.col(i).swap(basis.col(i + column));
    basis.col(i) /= basis(row, i);
    for (Eigen::Index j = 0; j < basis.cols(); ++j) {
      if (j != i) basis.col(j) -= basis(row, j) * basis.col(i);
    }
  }
  return basis;
}

MatrixXd product(const MatrixXd& left, const MatrixXd& right) { return left * right; }
VectorXd product(const MatrixXd& left, const VectorXd& right) { return left * right; }

}  // namespace contensou::reduction
