#include "fit/report.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/detail/infinity.hpp"

namespace contensou::fit {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Returns the share of residuals farther than 4 standard deviations from the densest half of them. The densest half is
/// the shortest interval with half of the residuals (P. J. Rousseeuw, 1984, doi:10.1080/01621459.1984.10477105).
/// @param residuals  at least one
/// @param least      smallest standard deviation that counts
double far_from_most(std::vector<double> residuals, double least) {
  std::ranges::sort(residuals);
  const std::size_t n = residuals.size(), half = n / 2;
  std::size_t begin = 0;
  const auto width = [&](std::size_t first) { return residuals[first + half] - residuals[first]; };
  for (std::size_t first = 1; first + half < n; ++first) {
    if (width(first) < width(begin)) begin = first;
  }
  // Half of all normal errors lie within 0.6745 standard deviations. The densest half of n errors is narrower.
  constexpr double half_of_normal = 0.6745, far = 4;
  const double sd = width(begin) / (2 * half_of_normal) * (1 + 5 / static_cast<double>(n));
  const double centre = (residuals[begin] + residuals[begin + half]) / 2, border = far * std::max(sd, least);
  const auto count = std::ranges::count_if(residuals, [&](double each) { return std::abs(each - centre) > border; });
  return static_cast<double>(count) / static_cast<double>(n);
}

}  // namespace

Report Reporter::report() {
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
  const bool flat = request_.ball.ball.body.lies_flat();
  if (!planned_ && !search_.resisted && !flat) set_rolling_friction_seen();
  if ((!fit_.fits() || fit_.widened) && flat && !planned_ && !request_.free.patch_radius) set_patch_seen();
  require_numbers();
  return {std::move(fit_), std::move(better_), std::move(with_patch_)};
}

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
    // Rounding may make the estimate larger than the ball, but no patch is larger.
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

bool Reporter::is_seen(Parameter parameter, std::size_t track) const {
  const auto has = [&](Observable observable) { return series_of(request_.tracks[track], observable) != nullptr; };
  return parameter == Parameter::slip ? has(Observable::slip) : has(Observable::spin) || has(Observable::angle);
}

bool Reporter::moves(std::size_t track) const {
  return std::ranges::any_of(request_.tracks[track].series, [](const Series& series) {
    using enum Observable;
    return series.observable == x || series.observable == y || series.observable == vx || series.observable == vy;
  });
}

/// Returns the track and the time of a row of residuals. Each series has one row for each time of its track.
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
    // The deviation follows from the median of `sizes`, but is at least the rounding step or the given deviation.
    constexpr double outside = 6;
    const double least = search_.estimated[place] ? search_.rounding[place] * search_.weight[rows.front()] : 1;
    const double border = outside * std::max(sd_by_median(sizes), least);
    std::vector<Outlier> outliers;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (sizes[i] > border) outliers.push_back(place_of(rows[i]));
    }
    const VectorXd residuals = residuals_(rows), data = search_.data(rows);
    const double range = data.maxCoeff() - data.minCoeff();
    const bool is_film = std::sqrt(squares / n) > sharpest_film * range;
    const double far = is_film ? far_from_most({residuals.begin(), residuals.end()}, least) : 0;
    fit_.noise.push_back({observable, static_cast<Index>(rows.size()), std::sqrt(squares / n), std::sqrt(variances / n),
                          search_.estimated[place], std::move(outliers), far,
                          neighbours_depend(observable) ? dependence_[place].neighbours : 0});
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

void Reporter::require_numbers() const {
  for (const Estimate& estimate : fit_.estimates) {
    if (std::isfinite(estimate.value) && !std::isnan(estimate.standard_error) && !std::isnan(estimate.interval.low) &&
        !std::isnan(estimate.interval.high))
      continue;
    throw std::runtime_error(fmt::format("fit: no number was found for {}", kind_of(estimate.parameter).name));
  }
}

}  // namespace contensou::fit
