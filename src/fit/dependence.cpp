#include "fit/dependence.hpp"

#include <algorithm>
#include <cmath>

namespace contensou::fit {

using Eigen::Index;

Dependence dependence_of(const std::vector<Eigen::MatrixXd>& runs) {
  double values = 0, squares = 0;
  for (const Eigen::MatrixXd& z : runs) {
    values += static_cast<double>(z.rows());
    squares += z.squaredNorm();
  }
  const double variance = squares / values;
  const auto window = static_cast<Index>(std::max(2.0, std::round(std::sqrt(values))));
  double pairs = 0, products = 0, expected = 0, seen = 0;
  for (const Eigen::MatrixXd& z : runs) {
    for (Index i = 1; i < z.rows(); ++i) products += z.row(i).dot(z.row(i - 1));
    pairs += static_cast<double>(std::max<Index>(z.rows() - 1, 0));
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(z.cols());
    for (Index i = 0; i < z.rows(); ++i) {
      sum += z.row(i);
      if (i >= window) sum -= z.row(i - window);
      if (i + 1 < window) continue;
      seen += sum[0] * sum[0];
      expected += static_cast<double>(window) * variance - sum.tail(sum.size() - 1).squaredNorm();
    }
  }
  Dependence result;
  // Chance takes the estimate of a correlation near 1 beyond 1.
  if (pairs > 0 && variance > 0) result.neighbours = std::clamp(products / (pairs * variance), -1.0, 1.0);
  if (expected > 0) result.growth = seen / expected;
  return result;
}

}  // namespace contensou::fit
