#include "numerics/decomposition.hpp"

#include <cmath>

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
