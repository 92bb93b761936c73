#include "fit/report.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace contensou::fit {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Number of waves of the friction along a path. Shorter waves hardly move a body.
constexpr Index waves = 12;

/// Returns the expected variance sigma^2 of the relative friction.
///
/// The film determines independent combinations of the waves. Combination i was found as z_i in units of its error, and
/// friction of the standard deviation sigma gives z_i the variance 1 + sigma^2 l_i. The likelihood of sigma is the
/// product of these normal densities. The density of sigma before the film is proportional to 1/(1 + (sigma/2 %)^2)^2,
/// of which the variance is (2 %)^2: most real tables vary by about 2 %. The result is a mean, no best value: the best
/// value is often 0, and the errors would then be too small.
double variance_of_friction(const VectorXd& l, const VectorXd& z) {
  constexpr double usual = 0.02, least = 1e-4, most = 30, ratio = 1.1;
  double total = 0, sum = 0, highest = -std::numeric_limits<double>::infinity();
  for (double sigma = least; sigma < most; sigma *= ratio) {
    const double square = sigma * sigma;
    double log = std::log(sigma) - 2 * std::log1p(square / (usual * usual));  // the steps are proportional to sigma
    for (Index i = 0; i < l.size(); ++i) {
      const double more = square * std::max(0.0, l[i]);
      log += (z[i] * z[i] * more / (1 + more) - std::log1p(more)) / 2;
    }
    if (log > highest) {
      total *= std::exp(highest - log);
      sum *= std::exp(highest - log);
      highest = log;
    }
    total += std::exp(log - highest);
    sum += std::exp(log - highest) * square;
  }
  return sum / total;
}

}  // namespace

/// The errors of the film are e = e_0 + B b. Here e_0 are errors of the camera, and B b is the effect of friction
/// f (1 + sum b_j cos(pi j s)) that varies along the path s (TrackModel::by_uneven_friction). The amplitudes b_j are
/// independent with variances proportional to 1/j^2; the variance of the friction is sigma^2. `friction` is therefore
/// the mean friction over the path. In the columns of B, amplitudes are scaled to the variance sigma^2.
///
/// The errors of the camera depend on their neighbours. A wave of the friction changes the film slowly, and at low
/// frequencies these errors have the variance n_o g_o: n_o is the variance of the errors of the column o, and g_o the
/// growth of the variance of means (dependence.hpp). With weights 1/(n_o g_o), the change of the parameters and b
/// follow from least squares: M = X^T W X + (0, 1/sigma^2), X = (J, B). Residuals then have the covariance n_o
/// - X M^-1 X^T, if e_0 is independent. Therefore n_o is the mean of r_i^2 + x_i M^-1 x_i, and g_o follows from the
/// residuals r as it does without waves. sigma, n_o and g_o are computed in turn, at first with g_o = 1: what can be
/// due to friction is taken for friction.
///
/// The estimate itself stays that of least squares, with the covariance C J^T (N + sigma^2 B B^T) J C, C = (J^T J)^-1,
/// and N of the n_o g_o.
void Reporter::set_widened(const VectorXd& residuals) {
  const MatrixXd effects = search_.model.by_uneven_friction(parameters_, waves);
  const Index p = inverse_.root.cols(), q = effects.cols();
  VectorXd shape(q);
  for (Index j = 0; j < q; ++j) shape[j] = 1 / static_cast<double>(j % waves + 1);
  shape /= std::sqrt(shape.head(waves).squaredNorm() / 2);  // the mean of cos^2 is 1/2
  MatrixXd X(residuals.size(), p + q);
  X << derivatives_ * inverse_.root, search_.weight.asDiagonal() * effects * shape.asDiagonal();
  VectorXd noise = VectorXd::Ones(residuals.size()), growth = noise;
  double variance = 0;
  constexpr int most_rounds = 20;
  for (int round = 0; round < most_rounds; ++round) {
    const MatrixXd weighted = noise.cwiseProduct(growth).cwiseInverse().asDiagonal() * X;
    MatrixXd M = X.transpose() * weighted;
    const VectorXd found = weighted.transpose() * residuals;
    const MatrixXd others = Eigen::LLT<MatrixXd>(M.topLeftCorner(p, p)).solve(M.topRightCorner(p, q));
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(M.bottomRightCorner(q, q) - M.bottomLeftCorner(q, p) * others);
    const double before = variance;
    const VectorXd scale = solver.eigenvalues().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
    variance = variance_of_friction(
        solver.eigenvalues(),
        scale.cwiseProduct(solver.eigenvectors().transpose() * (found.tail(q) - others.transpose() * found.head(p))));
    M.diagonal().tail(q).array() += 1 / variance;
    const Eigen::LLT<MatrixXd> factors(M);
    const VectorXd rest = residuals - X * factors.solve(found);
    const MatrixXd rows_of_A = X * factors.matrixU().solve(MatrixXd::Identity(p + q, p + q));
    for (std::size_t place = 0; place < std::size(dependence_); ++place) {
      const std::vector<Index>& rows = search_.rows_of[place];
      if (!search_.estimated[place]) continue;
      double squares = 0;
      for (Index row : rows) squares += rest[row] * rest[row] + rows_of_A.row(row).squaredNorm();
      const double of_column = squares / static_cast<double>(rows.size());
      const double grown =
          std::max(1.0, dependence_of(place, rest, growth.cwiseSqrt().cwiseInverse().asDiagonal() * rows_of_A).growth);
      for (Index row : rows) noise[row] = of_column, growth[row] = grown;
      rest_[place] = std::sqrt(of_column) / search_.weight[rows.front()];
    }
    constexpr double hardly = 1e-3;
    if (std::abs(variance - before) < hardly * variance) break;
  }
  Widened& widened = fit_.widened.emplace(Widened{std::sqrt(variance), 1, 1});
  // Such a film is refused, and its profiles would be very long.
  if (widened.friction_varies > most_varying) return;
  const MatrixXd by_waves = derivatives_.transpose() * X.rightCols(q);
  const MatrixXd by_camera = derivatives_.transpose() * noise.cwiseProduct(growth).asDiagonal() * derivatives_;
  set_covariance(variance_ * inverse_.covariance * (by_camera + variance * by_waves * by_waves.transpose()) *
                 inverse_.covariance);
  widened.least = std::numeric_limits<double>::infinity();
  widened.most = 0;
  for (std::size_t i = 0; i < search_.free.size(); ++i) {
    const Parameter parameter = TrackModel::parameter_at(search_.free[i]);
    if (static_cast<int>(parameter) >= static_cast<int>(Parameter::direction)) continue;
    const auto at = static_cast<Index>(i);
    const double factor = deviation_[at] / std::sqrt(variance_ * inverse_.covariance(at, at));
    widened.least = std::min(widened.least, factor);
    widened.most = std::max(widened.most, factor);
  }
}

}  // namespace contensou::fit
