#include "fit/report.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <stdexcept>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "contensou/reduction/infinity.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/quantity.hpp"
#include "contensou/si/scaling.hpp"
#include "fit/dependence.hpp"
#include "fit/profile.hpp"
#include "fit/student.hpp"

namespace contensou::fit {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// An eigenvalue of the correlations of derivatives below which the data do not decide.
constexpr double undecided = 1e-10;
/// A relative error from which on a number counts as unknown: catalogues are better.
constexpr double unknown = 0.5;
/// Where friction and patch radius depend on each other more than that, and are known worse than that, a parabola is no
/// good model of the sum of squares; nor where a number is known worse than the last.
constexpr double strongly_correlated = 0.95, hardly_nonlinear = 0.01, nonlinear = 0.1;

/// Rarer by chance than in one of ten thousand films: so many standard deviations of a normal distribution.
constexpr double too_rare = 3.7;
/// Errors below this share of the range of the values are no noise of a film, but those of computed or rounded numbers.
constexpr double sharpest_film = 1e-4;

/// The rise of a sum of squares that is the least of several minima, over that of one.
constexpr double of_two_numbers = 5.991 / (normal_quantile * normal_quantile);

bool is_of_contact(Parameter parameter) { return static_cast<int>(parameter) < contact_parameters; }

/// The inverse of a matrix of information, and which parameters it does not decide.
struct Inverse {
  MatrixXd covariance;
  MatrixXd root;  ///< times its transpose: the covariance
  std::vector<bool> undecided;
};

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

/// What the data tell of ln f and ln eps when all else is free, too: of both by itself, the 2 by 2 matrix.
Eigen::Matrix2d information_of_contact(const MatrixXd& information) {
  const Index others = information.rows() - 2;
  if (others == 0) return information;
  const MatrixXd beside = information.topRightCorner(2, others);
  return information.topLeftCorner<2, 2>() -
         beside * inverse_of(information.bottomRightCorner(others, others)).covariance * beside.transpose();
}

/// The combinations that a film may decide alone: f of a slip, f eps of a spin, f/eps of the end of a slip.
const Eigen::Vector2d combinations[]{{1, 0}, {0, 1}, {1, 1}, {1, -1}};

/// A solution and what follows from it.
class Reporter {
 public:
  Reporter(const Search& search, const VectorXd& solution, bool planned)
      : search_(search),
        request_(search.request),
        planned_(planned),
        parameters_(search.model.limited(solution)),
        values_(search.model.values(parameters_)) {}

  Report report() {
    set_size();
    set_errors();
    set_estimates();
    set_only_by_curvature();
    if (!planned_) set_profiles();
    set_noise();
    set_predicted();
    set_ball();
    if (!planned_) set_misfits();
    if (fit_.fits()) set_spreads();
    if (!planned_ && !search_.resisted && !request_.ball.ball.body.lies_flat()) set_rolling_friction_seen();
    require_numbers();
    return {std::move(fit_), std::move(better_)};
  }

 private:
  /// What is fitted, how many values, how well.
  void set_size();
  /// Covariance and correlations, by curvature.
  void set_errors();
  void set_covariance(const MatrixXd& covariance);
  /// Finds the dependence of errors of unknown size on each other, and adds it to the covariance.
  void set_dependence();
  /// By what the variance of a number is larger than of independent errors.
  double growth_of(const Coordinate& number) const;
  void set_estimates();
  void add_estimate(Parameter parameter, std::size_t track);
  /// Of a plan: the combination that is known where friction and patch radius are not.
  void set_only_by_curvature();
  /// Whether a number is known so badly that a parabola is no good model of the sum of squares.
  bool is_vague() const;
  bool needs_profile() const;
  void set_profiles();
  /// What is profiled, and between which ends.
  struct Number {
    Coordinate coordinate;
    std::optional<std::size_t> estimate;  ///< whose it is
    double error;                         ///< by curvature
    double low, high;
    Interval interval;
  };
  std::optional<Number> number_of(std::size_t estimate) const;
  Number combined(const Eigen::Vector2d& powers) const;
  void set_other_motions(Profile& profile);
  void set_profile(const Number& number);
  void set_only(const std::vector<Number>& numbers);
  Outlier place_of(Eigen::Index row) const;
  void set_noise();
  void set_predicted();
  void set_ball();
  /// What the ball's numbers are known to; nothing where the data leave one of them open.
  void set_spreads();
  double held_back(std::size_t free) const;
  void set_misfits();
  void set_rolling_friction_seen();
  void require_numbers() const;

  bool is_free(Index place) const { return std::ranges::find(search_.free, place) != search_.free.end(); }
  bool both_free() const { return request_.free.friction && request_.free.patch_radius; }
  /// Whether a number of the start is in the data as such.
  bool is_seen(Parameter parameter, std::size_t track) const;
  /// True if x, y, vx or vy is in the data.
  bool moves(std::size_t track) const;
  /// A residual, or what Huber's loss lets it count for.
  double bounded(double residual) const {
    return request_.robust ? std::clamp(residual, -huber_bend, huber_bend) : residual;
  }

  const Search& search_;
  const FitRequest& request_;
  const bool planned_;
  VectorXd parameters_, values_, residuals_;
  MatrixXd derivatives_;  ///< of the residuals, by what is free
  MatrixXd information_;
  Inverse inverse_;
  MatrixXd covariance_;       ///< of the free parameters
  VectorXd deviation_;        ///< their standard errors
  Dependence dependence_[7];  ///< of the errors of each observable, where their size is not given
  double variance_ = 1;       ///< by which the robust loss needs more data for the same error
  double quantile_ = normal_quantile;
  Fit fit_;
  std::optional<VectorXd> better_;
};

void Reporter::set_size() {
  const auto count = static_cast<Index>(search_.free.size());
  fit_.law = request_.law.name();
  fit_.robust = request_.robust;
  fit_.ball = request_.ball;
  fit_.values = search_.values;
  fit_.degrees_of_freedom = static_cast<double>(search_.values - count);
  const bool by_student = search_.any_estimated() && !planned_;
  if (by_student && fit_.degrees_of_freedom < 1) {
    throw std::domain_error(
        fmt::format("fit: {} values without standard deviations do not decide {} numbers", search_.values, count));
  }
  if (by_student) quantile_ = student_quantile(fit_.degrees_of_freedom);
  residuals_ =
      planned_ ? VectorXd::Zero(values_.size()) : VectorXd((values_ - search_.data).cwiseProduct(search_.weight));
  fit_.chi2 = residuals_.squaredNorm();
  fit_.aic = search_.criterion(parameters_);
}

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

/// The covariance of the estimate is C J^T E[e e^T] J C. As the derivatives J change little from value to value, J^T E[e e^T] J of
/// a column is g J^T J, with g the growth of the variance of its means: n values are worth n/g.
void Reporter::set_dependence() {
  const MatrixXd rows_of_A = derivatives_ * inverse_.root;
  VectorXd more = VectorXd::Zero(residuals_.size());  // g - 1, row by row
  double worth = static_cast<double>(search_.values);
  for (std::size_t place = 0; place < std::size(dependence_); ++place) {
    const std::vector<Index>& rows = search_.rows_of[place];
    if (!search_.estimated[place]) continue;
    const auto n = static_cast<double>(rows.size());
    double squares = 0, fitted = 0;
    for (Index row : rows) {
      squares += std::pow(bounded(residuals_[row]), 2);
      fitted += rows_of_A.row(row).squaredNorm();
    }
    const double variance = squares / std::max(1.0, n - fitted);
    double range = 0;
    for (const std::size_t axis : {place, other_axis(place)}) {
      const VectorXd values = search_.data(search_.rows_of[axis]);
      if (values.size() > 0) range = std::max(range, values.maxCoeff() - values.minCoeff());
    }
    if (std::sqrt(variance) < sharpest_film * range * search_.weight[rows.front()]) continue;
    std::vector<MatrixXd> runs(request_.tracks.size());
    std::vector<std::vector<Index>> rows_of(runs.size());
    for (Index row : rows) rows_of[place_of(row).track].push_back(row);
    for (std::size_t track = 0; track < runs.size(); ++track) {
      const std::vector<Index>& of = rows_of[track];
      runs[track].resize(static_cast<Index>(of.size()), rows_of_A.cols() + 1);
      runs[track] << residuals_(of).unaryExpr([this](double each) { return bounded(each); }),
          std::sqrt(variance) * rows_of_A(of, Eigen::all);
    }
    dependence_[place] = dependence_of(runs);
    // Less than 1 is chance.
    const double growth = std::max(1.0, dependence_[place].growth);
    for (Index row : rows) more[row] = growth - 1;
    worth -= n * (1 - 1 / growth);
  }
  if (more.isZero()) return;
  set_covariance(covariance_ + variance_ * inverse_.covariance *
                                   (derivatives_.transpose() * more.asDiagonal() * derivatives_) * inverse_.covariance);
  const auto found = static_cast<double>(search_.free.size());
  quantile_ = student_quantile(std::max(1.0, std::floor(worth - found)));
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

void Reporter::add_estimate(Parameter parameter, std::size_t track) {
  const Index place = TrackModel::place(parameter, track);
  const auto found = std::ranges::find(search_.free, place);
  Estimate estimate{parameter, track, parameters_[place], 0, {}, found != search_.free.end()};
  double error = 0;
  if (estimate.free) {
    const auto at = static_cast<std::size_t>(found - search_.free.begin());
    error = inverse_.undecided[at] ? infinity : deviation_[static_cast<Index>(at)];
  }
  if (is_of_contact(parameter)) {
    estimate.value = std::exp(estimate.value);
    // No patch is larger than the ball, not even by rounding.
    if (parameter == Parameter::patch_radius) estimate.value = std::min(estimate.value, request_.ball.ball.radius);
    estimate.standard_error = error == 0 ? 0 : estimate.value * error;
    estimate.interval = {estimate.value * std::exp(-quantile_ * error), estimate.value * std::exp(quantile_ * error)};
  } else {
    estimate.standard_error = error;
    estimate.interval = {estimate.value - quantile_ * error, estimate.value + quantile_ * error};
    const bool can_be_negative = search_.model.range(place).low < 0;
    if (!can_be_negative) estimate.interval.low = std::max(estimate.interval.low, 0.0);
  }
  if (estimate.free || static_cast<int>(parameter) < static_cast<int>(Parameter::direction))
    fit_.estimates.push_back(estimate);
}

void Reporter::set_estimates() {
  add_estimate(Parameter::friction, 0);
  add_estimate(Parameter::patch_radius, 0);
  if (search_.resisted) add_estimate(Parameter::rolling_friction, 0);
  for (std::size_t track = 0; track < request_.tracks.size(); ++track) {
    for (int i = shared_parameters; i < shared_parameters + start_parameters; ++i) {
      add_estimate(static_cast<Parameter>(i), track);
    }
  }
  // No patch is larger than the ball.
  double& largest_patch = fit_.estimates[1].interval.high;
  if (request_.free.patch_radius) largest_patch = std::min(largest_patch, request_.ball.ball.radius);
}

void Reporter::set_only_by_curvature() {
  if (!both_free() || !planned_) return;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(information_of_contact(information_));
  constexpr double least_share = 1e-8;  // below which it counts as none
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

bool Reporter::is_seen(Parameter parameter, std::size_t track) const {
  const auto has = [&](Observable observable) {
    const auto& series = request_.tracks[track].series;
    return std::ranges::find(series, observable, &Series::observable) != series.end();
  };
  return parameter == Parameter::slip ? has(Observable::slip) : has(Observable::spin) || has(Observable::angle);
}

bool Reporter::moves(std::size_t track) const {
  return std::ranges::any_of(request_.tracks[track].series, [](const Series& series) {
    using enum Observable;
    return series.observable == x || series.observable == y || series.observable == vx || series.observable == vy;
  });
}

bool Reporter::is_vague() const {
  if (std::ranges::any_of(inverse_.undecided, std::identity())) return true;
  for (std::size_t i = 0; i < search_.free.size(); ++i) {
    const Index place = search_.free[i];
    const double error = deviation_[static_cast<Index>(i)];
    if (place < contact_parameters && error > nonlinear) return true;
    // The drive is that over friction.
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

/// A motion depends on k = v/(patch radius |spin|) at the start. Where nothing shows the spin, two k can give a slip that
/// slows down alike, with another friction each; so it is for a slip that nothing shows.
void Reporter::set_other_motions(Profile& profile) {
  // A patch that is free makes up for any spin: then profiles are wide.
  if (request_.free.patch_radius) return;
  const double patch = std::exp(parameters_[1]);
  for (std::size_t track = 0; track < request_.tracks.size() && !profile.better(); ++track) {
    const auto place_of_hidden = [&]() -> Index {
      for (const Parameter each : {Parameter::spin, Parameter::slip}) {
        const bool by_velocity = each == Parameter::slip && request_.ball.ball.body.lies_flat() && moves(track);
        if (is_free(TrackModel::place(each, track)) && !is_seen(each, track) && !by_velocity)
          return TrackModel::place(each, track);
      }
      return -1;
    }();
    if (place_of_hidden < 0) continue;
    const Coordinate hidden{.place = place_of_hidden};
    const double slip = std::abs(parameters_[TrackModel::place(Parameter::slip, track)]);
    const double spin = std::abs(parameters_[TrackModel::place(Parameter::spin, track)]);
    const bool is_spin = TrackModel::parameter_at(place_of_hidden) == Parameter::spin;
    // Beyond these k one of the speeds hardly changes the other.
    constexpr double farthest = 3.2, step = 0.4;
    std::vector<double> values;
    for (double ln_k = -farthest; ln_k <= farthest + step / 2; ln_k += step) {
      const double size = is_spin ? slip / (patch * std::exp(ln_k)) : spin * patch * std::exp(ln_k);
      if (size > 0 && size < search_.model.range(place_of_hidden).high)
        values.push_back(std::copysign(size, hidden.of(parameters_)));
    }
    std::ranges::sort(values);
    profile.set_rise(of_two_numbers * quantile_ * quantile_ * variance_ * growth_of(hidden));
    for (const auto& [parameters, excess] : profile.other_minima(hidden, values)) {
      fit_.other_motions.push_back({track, std::exp(parameters[0]),
                                    parameters[TrackModel::place(Parameter::slip, track)],
                                    parameters[TrackModel::place(Parameter::spin, track)], excess});
    }
  }
}

void Reporter::set_profiles() {
  // Orbits as sharp as a film is.
  Search quick(request_, accuracy_of_guess);
  quick.weight = search_.weight;
  quick.guesses = search_.guesses;
  const double least_rise = quantile_ * quantile_ * variance_;
  const bool wide = is_vague();
  Profile profile(quick, parameters_, least_rise, wide);
  set_other_motions(profile);
  better_ = profile.better();
  fit_.profiled = !fit_.other_motions.empty() || needs_profile();
  if (better_ || !fit_.profiled) return;
  std::vector<Number> numbers;
  for (std::size_t i = 0; i < fit_.estimates.size(); ++i) {
    const std::optional<Number> number = number_of(i);
    const bool all = wide || !fit_.other_motions.empty();
    if (number && (all || number->coordinate.of_contact())) numbers.push_back(*number);
  }
  if (both_free() && wide) {
    for (const Eigen::Vector2d& powers : {Eigen::Vector2d(1, 1), Eigen::Vector2d(1, -1)})
      numbers.push_back(combined(powers));
  }
  // The patch first: it is the number that most films tell least of, so that its valley is the longest.
  std::ranges::stable_sort(numbers, {},
                           [](const Number& number) { return number.coordinate.powers != Eigen::Vector2d(0, 1); });
  // The best motion may be one of many: where there are other ones, and of a slip or spin that nothing shows, with a
  // friction that nothing ends.
  const auto rise_of = [&](const Number& number) {
    const double rise = least_rise * growth_of(number.coordinate);
    if (!fit_.other_motions.empty()) return of_two_numbers * rise;
    if (!number.estimate || number.coordinate.of_contact()) return rise;
    const Estimate& estimate = fit_.estimates[*number.estimate];
    const auto is_open = [](const Number& each) {
      return each.coordinate.powers == Eigen::Vector2d(1, 0) &&
             (std::isinf(each.interval.low) || std::isinf(each.interval.high));
    };
    const bool many = static_cast<int>(estimate.parameter) >= shared_parameters &&
                      !is_seen(estimate.parameter, estimate.track) && std::ranges::any_of(numbers, is_open);
    return many ? of_two_numbers * rise : rise;
  };
  for (int round = 0; round < 2; ++round) {
    for (Number& number : numbers) {
      profile.set_rise(rise_of(number));
      if (round > 0 && !profile.reaches_beyond(number.coordinate, number.interval)) continue;
      number.interval = profile.of(number.coordinate, number.error, number.low, number.high);
      better_ = profile.better();
      if (better_) return;
    }
  }
  for (const Number& number : numbers) set_profile(number);
  if (both_free()) set_only(numbers);
}

std::optional<Reporter::Number> Reporter::number_of(std::size_t estimate) const {
  const Estimate& of = fit_.estimates[estimate];
  if (!of.free || static_cast<int>(of.parameter) >= static_cast<int>(Parameter::direction)) return {};
  const Index place = TrackModel::place(of.parameter, of.track);
  const auto column = std::ranges::find(search_.free, place) - search_.free.begin();
  const double error = inverse_.undecided[static_cast<std::size_t>(column)] ? infinity : deviation_[column];
  const auto [low, high] = search_.model.range(place);
  if (is_of_contact(of.parameter))
    return Number{{.powers = Eigen::Vector2d::Unit(place)}, estimate, error, low, high, {}};
  if (of.parameter == Parameter::rolling_friction) return Number{{.place = place}, estimate, error, low, high, {}};
  const bool either_sign = is_seen(of.parameter, of.track), negative = std::signbit(of.value);
  return Number{
      {.place = place}, estimate, error, either_sign || negative ? low : 0.0, either_sign || !negative ? high : 0, {}};
}

Reporter::Number Reporter::combined(const Eigen::Vector2d& powers) const {
  const TrackModel::Range friction = search_.model.range(0), patch = search_.model.range(1);
  const auto [low, high] = powers[1] > 0 ? patch : TrackModel::Range{-patch.high, -patch.low};
  const double variance = powers.dot(covariance_.topLeftCorner<2, 2>() * powers);
  return {{.powers = powers}, {}, std::sqrt(variance), friction.low + low, friction.high + high, {}};
}

void Reporter::set_profile(const Number& number) {
  if (!number.estimate) return;
  Estimate& estimate = fit_.estimates[*number.estimate];
  Interval interval = number.interval;
  if (number.coordinate.of_contact()) {
    estimate.standard_error = estimate.value * (interval.high - interval.low) / (2 * quantile_);
    interval = {std::exp(interval.low), std::exp(interval.high)};
    if (estimate.parameter == Parameter::patch_radius)
      interval.high = std::min(interval.high, request_.ball.ball.radius);
  } else {
    if (number.low == 0) interval.low = std::max(interval.low, 0.0);
    if (number.high == 0) interval.high = std::min(interval.high, 0.0);
    estimate.standard_error = (interval.high - interval.low) / (2 * quantile_);
  }
  estimate.interval = interval;
}

void Reporter::set_only(const std::vector<Number>& numbers) {
  const auto is_known = [](const Estimate& estimate) { return estimate.standard_error < unknown * estimate.value; };
  if (is_known(fit_.estimates[0]) && is_known(fit_.estimates[1])) return;
  double least = unknown;
  for (const auto& [coordinate, estimate, error, low, high, interval] : numbers) {
    const double relative = (interval.high - interval.low) / (2 * quantile_);
    if (!coordinate.of_contact() || !(relative < least)) continue;
    least = relative;
    fit_.only = Combination{coordinate.powers[0],
                            coordinate.powers[1],
                            std::exp(coordinate.of(parameters_)),
                            relative,
                            {std::exp(interval.low), std::exp(interval.high)}};
  }
}

/// The track and the time of a row of residuals: each series has one for each time of its track.
Outlier Reporter::place_of(Index row) const {
  for (std::size_t i = 0; i < request_.tracks.size(); ++i) {
    const Track& track = request_.tracks[i];
    const Index rows = track.t.size() * static_cast<Index>(track.series.size());
    if (row < rows) return {i, track.t[row % track.t.size()]};
    row -= rows + (track.stop_time ? 1 : 0);
  }
  throw std::logic_error("a stop time has no row of an observable");
}

void Reporter::set_noise() {
  for (const auto& [observable, name, unit, meaning] : observable_kinds()) {
    const auto place = static_cast<std::size_t>(observable);
    const std::vector<Index>& rows = search_.rows_of[place];
    if (rows.empty()) continue;
    double squares = 0, variances = 0;
    std::vector<double> sizes;
    for (Index row : rows) {
      const double sd = 1 / search_.weight[row];
      squares += residuals_[row] * residuals_[row] * sd * sd;
      variances += sd * sd;
      sizes.push_back(std::abs(residuals_[row]));
    }
    const auto n = static_cast<double>(rows.size());
    // The others' standard deviation, not less than what values are rounded to.
    constexpr double far = 6;
    const double border =
        far * std::max(sd_by_median(sizes),
                       search_.estimated[place] ? search_.rounding[place] * search_.weight[rows.front()] : 1);
    std::vector<Outlier> outliers;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (sizes[i] > border) outliers.push_back(place_of(rows[i]));
    }
    fit_.noise.push_back({observable, static_cast<Index>(rows.size()), std::sqrt(squares / n), std::sqrt(variances / n),
                          search_.estimated[place], std::move(outliers)});
  }
}

void Reporter::set_predicted() {
  Index row = 0;
  for (const Track& track : request_.tracks) {
    fit_.predicted.emplace_back();
    for (std::size_t i = 0; i < track.series.size(); ++i) {
      fit_.predicted.back().emplace_back(values_.segment(row, track.t.size()).array());
      row += track.t.size();
    }
    if (track.stop_time) ++row;
  }
}

void Reporter::set_ball() {
  const auto number = [&](Parameter parameter) { return fit_.estimate(parameter).value; };
  const bool whole_face = std::holds_alternative<si::WholeFace>(request_.ball.contact.patch);
  fit_.ball.contact = {.friction = number(Parameter::friction), .patch = request_.ball.contact.patch};
  if (search_.resisted) fit_.ball.contact.rolling_friction = number(Parameter::rolling_friction);
  if (request_.free.patch_radius || !whole_face)
    fit_.ball.contact.patch = si::PatchRadius{number(Parameter::patch_radius)};
  if (fit_.law != request_.ball.ball.body.law && reduction::find_law(fit_.law)) fit_.ball.contact.law = fit_.law;
  fit_.ball.spreads = {};
  const double slip = std::max(0.0, number(Parameter::slip)), spin = number(Parameter::spin);
  if (!is_free(TrackModel::place(Parameter::direction))) {
    fit_.ball.start = si::SlipAndSpin{slip, spin};
    return;
  }
  const double direction = number(Parameter::direction), radius = request_.ball.ball.radius;
  const Eigen::Vector2d of_contact(slip * std::cos(direction), slip * std::sin(direction));
  if (request_.ball.ball.body.lies_flat()) {
    fit_.ball.start = si::Velocities{of_contact, {0, 0, spin}};
    return;
  }
  const Eigen::Vector2d velocity = search_.resisted
                                       ? Eigen::Vector2d((slip + number(Parameter::rolling)) *
                                                         Eigen::Vector2d(std::cos(direction), std::sin(direction)))
                                       : Eigen::Vector2d(number(Parameter::vx), number(Parameter::vy));
  const Eigen::Vector2d difference = (velocity - of_contact) / radius;
  fit_.ball.start = si::Velocities{velocity, {-difference.y(), difference.x(), spin}};
}

void Reporter::set_spreads() {
  const auto number = [&](Parameter parameter) { return fit_.estimate(parameter).value; };
  const bool placed = is_free(TrackModel::place(Parameter::direction)), flat = request_.ball.ball.body.lies_flat();
  // A column of velocity and angular velocity: the ball rolls by what its centre is faster than the contact point.
  const double along = placed ? number(Parameter::direction) : 0;
  const Eigen::Vector2d e(std::cos(along), std::sin(along)), across(-e.y(), e.x()), none = Eigen::Vector2d::Zero();
  const auto start_by = [&](Parameter parameter) -> Eigen::Matrix<double, 5, 1> {
    const bool with_slip = flat || search_.resisted;
    const double slip = number(Parameter::slip);
    Eigen::Vector2d centre = none, contact = none;
    if (parameter == Parameter::slip) contact = e;
    if (parameter == Parameter::direction) contact = slip * across;
    if (with_slip) centre = contact;
    if (parameter == Parameter::direction && search_.resisted) centre += number(Parameter::rolling) * across;
    if (parameter == Parameter::rolling) centre = e;
    if (parameter == Parameter::vx) centre = {1, 0};
    if (parameter == Parameter::vy) centre = {0, 1};
    const Eigen::Vector2d rolls = (centre - contact) / request_.ball.ball.radius;
    return {centre.x(), centre.y(), -rolls.y(), rolls.x(), parameter == Parameter::spin ? 1.0 : 0.0};
  };
  std::vector<si::Component> named{{&si::friction, 0}, {&si::patch_radius, 0}, {&si::rolling_friction, 0}};
  if (placed) {
    for (const std::size_t i : {0U, 1U}) named.push_back({&si::velocity, i});
    for (const std::size_t i : {0U, 1U, 2U}) named.push_back({&si::angular_velocity, i});
  } else {
    named.insert(named.end(), {{&si::slip, 0}, {&si::spin, 0}});
  }
  const auto free = fit_.free_estimates();
  MatrixXd slopes = MatrixXd::Zero(static_cast<Index>(named.size()), static_cast<Index>(free.size()));
  VectorXd errors = VectorXd::Zero(slopes.cols());
  for (Index i = 0; i < errors.size(); ++i) {
    const auto& [parameter, track, value, error, interval, is_free] = *free[static_cast<std::size_t>(i)];
    const auto row = static_cast<Index>(parameter);
    const bool of_place = parameter == Parameter::x || parameter == Parameter::y || parameter == Parameter::angle;
    const bool in_ball = placed ? !of_place : row < slopes.rows();
    if (!in_ball || track > 0) continue;
    if (!std::isfinite(error)) return;  // of what the data do not decide no spread tells
    errors[i] = error;
    if (placed && row >= shared_parameters)
      slopes.col(i).tail<5>() = start_by(parameter);
    else
      slopes(row, i) = 1;  // slip and spin come next in named, too
  }
  slopes = slopes * errors.asDiagonal();
  fit_.ball.spreads = si::spreads_of(slopes * fit_.correlation * slopes.transpose(), named);
}

/// By how many standard errors a parameter would go beyond its limit.
double Reporter::held_back(std::size_t free) const {
  const Index place = search_.free[free];
  const auto [low, high] = search_.model.range(place);
  const bool below = parameters_[place] <= low, above = parameters_[place] >= high;
  if (!below && !above) return 0;
  const double outward = search_.slope(parameters_, VectorXd::Unit(parameters_.size(), place)) * (below ? -1 : 1);
  const auto at = static_cast<Index>(free);
  return -outward / 2 * inverse_.covariance(at, at) / deviation_[at];
}

void Reporter::set_misfits() {
  for (std::size_t i = 0; i < search_.free.size(); ++i) {
    if (held_back(i) < too_rare) continue;
    const Parameter parameter = TrackModel::parameter_at(search_.free[i]);
    if (parameter != Parameter::rolling) {
      fit_.misfits.push_back(fmt::format(
          "the film asks for a {} beyond what it may be: friction 1e-4 to 10, a patch not larger than the ball "
          "nor so large that the law has an invariant ray, slip and R spin up to 100 m/s; are the units right?",
          kind_of(parameter).name));
    } else {
      fit_.misfits.emplace_back(
          "the ball turns against its sliding at first, as after a draw, which a fit with rolling friction does not "
          "know: "
          "leave it out, and the film's end, too (until)");
    }
  }
  for (const Estimate& slip : fit_.estimates) {
    constexpr double clearly = 4;
    if (slip.parameter == Parameter::slip && slip.value < -clearly * slip.standard_error)
      fit_.misfits.push_back(fmt::format(
          "the slip at the start is {:.4g} m/s, and a speed is 0 or more: turn the sign of what was measured, "
          "vx - R wy of a ball that spins faster than it rolls",
          slip.value));
  }
  for (const Noise& noise : fit_.noise) {
    const auto& [observable, name, unit, meaning] = kind_of(noise.observable);
    const auto place = static_cast<std::size_t>(observable);
    // Rounded values are off as their neighbours are.
    const double correlation = noise.sd > search_.rounding[place] ? dependence_[place].neighbours : 0;
    // Chance allows any correlation of few values; 0.9 is that of values that are off the motion by four times of what their
    // neighbours are.
    constexpr double surely = 0.9, blurred = 0.5;
    const double by_chance = std::min(surely, too_rare / std::sqrt(static_cast<double>(noise.values)));
    if (observable == Observable::angle && noise.estimated && noise.sd > blurred) {
      fit_.misfits.push_back(fmt::format(
          "the angle is off by {:.2g} rad on the average, so that its whole turns are not known", noise.sd));
    } else if (noise.estimated && correlation > by_chance) {
      fit_.misfits.push_back(fmt::format(
          "{} is off by {:.2g} {} on the average, and neighbours are off alike: their correlation is {:.2f}, "
          "by chance up to {:.2f}",
          name, noise.sd, unit, correlation, by_chance));
    }
  }
  if (std::ranges::all_of(fit_.noise, &Noise::estimated) && !fit_.noise.empty()) return;
  // By Wilson and Hilferty's approximation the cube root of chi^2 is normal.
  constexpr double too_much = 2;
  const double n = fit_.degrees_of_freedom, share = 2 / (9 * n);
  double reduced = fit_.reduced_chi2();
  if (request_.robust) {  // which lets some values be far off
    std::vector<double> sizes;
    for (Index row = 0; row < residuals_.size(); ++row) {
      if (search_.weight[row] > 0) sizes.push_back(std::abs(residuals_[row]));
    }
    reduced = std::pow(sd_by_median(sizes), 2);
  }
  if (n >= 1 && reduced > too_much && std::cbrt(reduced) > 1 - share + too_rare * std::sqrt(share)) {
    fit_.misfits.push_back(fmt::format(
        "residuals are {:.2g} times as large as the standard deviations that are given (reduced chi^2 {:.3g})",
        std::sqrt(reduced), reduced));
  }
}

void Reporter::set_rolling_friction_seen() {
  // The same motion, as one with rolling friction 0.
  VectorXd start = parameters_;
  for (std::size_t track = 0; track < request_.tracks.size(); ++track) {
    const auto of = [&](Parameter parameter) -> double& { return start[TrackModel::place(parameter, track)]; };
    if (of(Parameter::slip) < 0) {
      of(Parameter::slip) *= -1;
      of(Parameter::direction) += std::numbers::pi;
    }
    const double along =
        std::cos(of(Parameter::direction)) * of(Parameter::vx) + std::sin(of(Parameter::direction)) * of(Parameter::vy);
    of(Parameter::rolling) = std::max(0.0, along - of(Parameter::slip));
  }
  const TrackModel model(request_.ball, request_.law, request_.tracks, accuracy_of_guess, true);
  VectorXd beside = start;
  constexpr double step = 0.01;  // of friction: wide, so that orbits as sharp as a guess do
  double& rolling_friction = beside[TrackModel::place(Parameter::rolling_friction)];
  rolling_friction = step * std::exp(start[0]);
  const VectorXd by_it = (model.values(beside) - model.values(start)).cwiseProduct(search_.weight) / rolling_friction;
  // What it changes that nothing else does.
  const VectorXd others = inverse_.covariance * (derivatives_.transpose() * by_it);
  const double alone = by_it.squaredNorm() - (derivatives_.transpose() * by_it).dot(others);
  constexpr double hardly_any = 1e-6, far_better = 12;
  if (!(alone > hardly_any * by_it.squaredNorm())) return;
  const VectorXd sizes = residuals_.unaryExpr([this](double each) { return bounded(each); });
  const double value = -sizes.dot(by_it - derivatives_ * others) / alone;
  const double chi2_less = value * value * alone / variance_;
  if (!(value > 0 && chi2_less > far_better)) return;
  const double friction = std::exp(parameters_[0] - (request_.free.friction ? others[0] * value : 0));
  fit_.rolling_friction_seen = {value, std::sqrt(variance_ / alone), friction, chi2_less};
}

void Reporter::require_numbers() const {
  for (const Estimate& estimate : fit_.estimates) {
    if (std::isfinite(estimate.value) && !std::isnan(estimate.standard_error) && !std::isnan(estimate.interval.low) &&
        !std::isnan(estimate.interval.high))
      continue;
    throw std::runtime_error(fmt::format("fit: no number was found for {}", kind_of(estimate.parameter).name));
  }
}

}  // namespace

Report report_on(const Search& search, const VectorXd& solution, bool planned) {
  return Reporter(search, solution, planned).report();
}

}  // namespace contensou::fit
