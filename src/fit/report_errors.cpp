#include "fit/report.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <Eigen/Eigenvalues>

#include "contensou/reduction/detail/infinity.hpp"

namespace contensou::fit {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// A combination counts as undetermined if its eigenvalue in the correlation matrix of the derivatives is below this.
constexpr double undecided = 1e-10;

/// A parabola is a poor model of the sum of squares in two cases. Either the correlation of friction and patch radius
/// exceeds `strongly_correlated` and a relative error `hardly_nonlinear`. Or a relative error is above `nonlinear`.
constexpr double strongly_correlated = 0.95, hardly_nonlinear = 0.01, nonlinear = 0.1;

/// Powers of f and eps in combinations that a film may show: a slip gives f, a spin f eps, the end of a slip f/eps.
const Eigen::Vector2d combinations[]{{1, 0}, {0, 1}, {1, 1}, {1, -1}};

Inverse inverse_of(const MatrixXd& information) {
  const VectorXd scale = information.diagonal().cwiseSqrt().unaryExpr([](double x) { return x > 0 ? x : 1; });
  const VectorXd inverse_scale = scale.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(inverse_scale.asDiagonal() * information *
                                                       inverse_scale.asDiagonal());
  const VectorXd values = solver.eigenvalues().cwiseMax(undecided);
  const MatrixXd& vectors = solver.eigenvectors();
  Inverse result;
  result.root = inverse_scale.asDiagonal() * vectors * values.cwiseInverse().cwiseSqrt().asDiagonal();
  result.covariance = result.root * result.root.transpose();
  for (Index i = 0; i < information.rows(); ++i) {
    double share = 0;
    for (Index k = 0; k < values.size(); ++k) {
      if (values[k] <= undecided) share += vectors(i, k) * vectors(i, k);
    }
    result.undecided.push_back(share > 1e-6);
  }
  return result;
}

/// Returns the 2 by 2 information matrix of ln f and ln eps. All other free parameters remain free.
Eigen::Matrix2d information_of_contact(const MatrixXd& information) {
  const Index others = information.rows() - 2;
  if (others == 0) return information;
  const MatrixXd beside = information.topRightCorner(2, others);
  return information.topLeftCorner<2, 2>() -
         beside * inverse_of(information.bottomRightCorner(others, others)).covariance * beside.transpose();
}

}  // namespace

void Reporter::set_errors() {
  derivatives_ = search_.weight.asDiagonal() * search_.model.derivatives(parameters_, search_.free);
  information_ = derivatives_.transpose() * derivatives_;
  if (request_.robust && !planned_) {
    double squares = 0, slopes = 0;
    for (double residual : residuals_) {
      const double size = std::abs(bounded(residual));
      squares += size * size;
      if (std::abs(residual) <= huber_bend) slopes += 1;
    }
    const auto missing = static_cast<double>(residuals_.size() - search_.values);
    const double share = (slopes - missing) / static_cast<double>(search_.values);
    variance_ = squares / std::max(fit_.degrees_of_freedom, 1.0) / (share * share);
  }
  inverse_ = inverse_of(information_);
  set_covariance(variance_ * inverse_.covariance);
  if (!planned_ && search_.any_estimated()) set_dependence();
}

void Reporter::set_covariance(const MatrixXd& covariance) {
  covariance_ = covariance;
  deviation_ = covariance_.diagonal().cwiseSqrt();
  const VectorXd inverse_deviation = deviation_.cwiseInverse();
  fit_.correlation = inverse_deviation.asDiagonal() * covariance_ * inverse_deviation.asDiagonal();
}

/// C J^T E[e e^T] J C is the covariance of the estimate, with the derivatives J of the residuals, C = (J^T J)^-1, and
/// errors e that may depend on each other. J changes little from value to value, and therefore J^T E[e e^T] J of an
/// observable is g J^T J with the growth g of the variance of means: n values are worth n/g independent values.
void Reporter::set_dependence() {
  const MatrixXd rows_of_A = derivatives_ * inverse_.root;
  const VectorXd sizes = residuals_.unaryExpr([this](double each) { return bounded(each); });
  VectorXd more = VectorXd::Zero(residuals_.size());  // g - 1 for each row
  double worth = static_cast<double>(search_.values);
  bool is_film = true;
  for (std::size_t place = 0; place < std::size(dependence_); ++place) {
    const std::vector<Index>& rows = search_.rows_of[place];
    if (!search_.estimated[place]) continue;
    const auto n = static_cast<double>(rows.size());
    double squares = 0, fitted = 0;
    for (Index row : rows) {
      squares += sizes[row] * sizes[row];
      fitted += rows_of_A.row(row).squaredNorm();
    }
    const double variance = squares / std::max(1.0, n - fitted);
    if (std::sqrt(variance) < sharpest_film * range_of(place) * search_.weight[rows.front()]) {
      is_film = false;
      continue;
    }
    dependence_[place] = dependence_of(place, sizes, std::sqrt(variance) * rows_of_A);
    // A growth below 1 is due to chance.
    const double growth = std::max(1.0, dependence_[place].growth);
    for (Index row : rows) more[row] = growth - 1;
    worth -= n * (1 - 1 / growth);
  }
  if (more.isZero()) return;
  set_covariance(covariance_ + variance_ * inverse_.covariance *
                                   (derivatives_.transpose() * more.asDiagonal() * derivatives_) * inverse_.covariance);
  const auto found = static_cast<double>(search_.free.size());
  quantile_ = student_quantile(std::max(1.0, std::floor(worth - found)));
  const auto depends = [&](const auto& kind) { return neighbours_depend(kind.observable); };
  if (is_film && std::ranges::any_of(observable_kinds(), depends)) set_widened(sizes);
}

double Reporter::range_of(std::size_t place) const {
  double range = 0;
  for (const std::size_t axis : {place, other_axis(place)}) {
    const VectorXd values = search_.data(search_.rows_of[axis]);
    if (values.size() > 0) range = std::max(range, values.maxCoeff() - values.minCoeff());
  }
  return range;
}

Dependence Reporter::dependence_of(std::size_t place, const VectorXd& residuals, const MatrixXd& rows_of_A) const {
  std::vector<MatrixXd> runs(request_.tracks.size());
  std::vector<std::vector<Index>> rows_of(runs.size());
  for (Index row : search_.rows_of[place]) rows_of[place_of(row).track].push_back(row);
  for (std::size_t track = 0; track < runs.size(); ++track) {
    const std::vector<Index>& of = rows_of[track];
    runs[track].resize(static_cast<Index>(of.size()), rows_of_A.cols() + 1);
    runs[track] << residuals(of), rows_of_A(of, Eigen::all);
  }
  return fit::dependence_of(runs);
}

double Reporter::growth_of(const Coordinate& number) const {
  VectorXd along = VectorXd::Zero(covariance_.rows());
  for (Index i = 0; i < along.size(); ++i) {
    const Index place = search_.free[static_cast<std::size_t>(i)];
    if (number.of_contact() ? place < contact_parameters : place == number.place)
      along[i] = number.of_contact() ? number.powers[place] : 1;
  }
  return along.dot(covariance_ * along) / (variance_ * along.dot(inverse_.covariance * along));
}

bool Reporter::is_vague() const {
  if (std::ranges::any_of(inverse_.undecided, std::identity())) return true;
  for (std::size_t i = 0; i < search_.free.size(); ++i) {
    const Index place = search_.free[i];
    const double error = deviation_[static_cast<Index>(i)];
    if (place < contact_parameters && error > nonlinear) return true;
    // The orbit depends on the quotient of rolling friction and friction.
    if (place == TrackModel::place(Parameter::rolling_friction) && error > nonlinear * std::exp(parameters_[0]))
      return true;
    const Parameter parameter = TrackModel::parameter_at(place);
    const bool speed = parameter == Parameter::slip || parameter == Parameter::spin;
    if (speed && !is_seen(parameter, TrackModel::track_of(place)) && error > nonlinear * std::abs(parameters_[place]))
      return true;
  }
  return false;
}

bool Reporter::needs_profile() const {
  if (is_vague()) return true;
  return both_free() && std::abs(fit_.correlation(0, 1)) > strongly_correlated &&
         std::max(deviation_[0], deviation_[1]) > hardly_nonlinear;
}

void Reporter::set_only_by_curvature() {
  if (!both_free() || !planned_) return;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(information_of_contact(information_));
  constexpr double least_share = 1e-8;  // smallest eigenvalue that counts, divided by the larger eigenvalue
  const double strong = solver.eigenvalues()[1], weak = std::max(solver.eigenvalues()[0], least_share * strong);
  double least = infinity;
  for (const Eigen::Vector2d& powers : combinations) {
    const Eigen::Vector2d along = solver.eigenvectors().transpose() * powers;
    const double error = std::sqrt(along[0] * along[0] / weak + along[1] * along[1] / strong);
    if (error >= std::min(least, unknown)) continue;
    least = error;
    const double value = std::exp(powers.dot(parameters_.head<2>()));
    fit_.only = Combination{powers[0],
                            powers[1],
                            value,
                            error,
                            {value * std::exp(-quantile_ * error), value * std::exp(quantile_ * error)}};
  }
  if (weak * unknown * unknown >= 1) fit_.only = {};
}

}  // namespace contensou::fit
