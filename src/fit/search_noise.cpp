#include "fit/search.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::fit {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr Index min_of_unknown_noise = 10;
/// Smallest standard deviation of an observable, as a share of its largest value.
constexpr double least_sd = 1e-9;

/// Returns the step of which all differences of values are multiples, by Euclid's algorithm; 0 if all values are equal.
double resolution(const VectorXd& data, const std::vector<Index>& rows) {
  const VectorXd values = data(rows);
  constexpr double sharp = 1e-9;
  const double none = sharp * (values.maxCoeff() - values.minCoeff());
  double step = 0;
  for (double value : values) {
    for (double other = std::abs(value - values[0]); other > none;) {
      const double rest = std::abs(std::remainder(step, other));
      step = other;
      other = rest;
    }
  }
  return step;
}

/// Returns the errors of a series, estimated from the distance of each value to the line through its neighbours.
std::vector<double> local_errors(const Track& track, const Series& series) {
  std::vector<Index> known;
  for (Index i = 0; i < track.t.size(); ++i) {
    if (!std::isnan(series.value[i])) known.push_back(i);
  }
  std::vector<double> errors;
  for (std::size_t i = 1; i + 1 < known.size(); ++i) {
    const Index before = known[i - 1], at = known[i], after = known[i + 1];
    const double fraction = (track.t[at] - track.t[before]) / (track.t[after] - track.t[before]);
    const double error = series.value[at] - (1 - fraction) * series.value[before] - fraction * series.value[after];
    errors.push_back(std::abs(error) / std::sqrt(1 + fraction * fraction + (1 - fraction) * (1 - fraction)));
  }
  return errors;
}

}  // namespace

std::size_t other_axis(std::size_t place) {
  using enum Observable;
  constexpr std::pair<Observable, Observable> axes[]{{x, y}, {y, x}, {vx, vy}, {vy, vx}};
  const auto* found =
      std::ranges::find(axes, static_cast<Observable>(place), &std::pair<Observable, Observable>::first);
  return found == std::end(axes) ? place : static_cast<std::size_t>(found->second);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double sd_by_median(std::vector<double> sizes) { return median(std::move(sizes)) / 0.6744897501960817; }

void Search::begin_noise() {
  std::vector<double> errors[7];
  for (const Track& track : request.tracks) {
    for (const Series& series : track.series) {
      if (series.sd.size() != 0) continue;
      const std::vector<double> more = local_errors(track, series);
      std::vector<double>& all = errors[static_cast<std::size_t>(series.observable)];
      all.insert(all.end(), more.begin(), more.end());
    }
  }
  for (const auto& [observable, name, unit, meaning] : observable_kinds()) {
    const auto place = static_cast<std::size_t>(observable);
    if (!estimated[place]) continue;
    const auto count = static_cast<Index>(rows_of[place].size());
    if (count < min_of_unknown_noise || errors[place].empty()) {
      throw std::domain_error(fmt::format(
          "fit: {} has {} values and no standard deviations; from fewer than {} values they cannot be estimated", name,
          count, min_of_unknown_noise));
    }
    rounding[place] = resolution(data, rows_of[place]);
    if (rounding[place] == 0) {
      // If all values of a column are equal, the other axis gives the standard deviation, as the camera is the same.
      const std::size_t other = other_axis(place);
      const bool varies = other != place && !rows_of[other].empty() && resolution(data, rows_of[other]) > 0;
      if (!varies) {
        throw std::domain_error(
            fmt::format("fit: {0} has the same value in all of its {1} rows, which tells no standard deviation of it: "
                        "give one, or leave {0} out",
                        name, count));
      }
      sharp_as[place] = other;
      continue;
    }
    set_sd(place, sd_by_median(errors[place]));
  }
  follow_other_axes();
}

double Search::set_sd(std::size_t place, double sd) {
  double largest = 0;
  for (Index row : rows_of[place]) largest = std::max(largest, std::abs(data[row]));
  sd = std::max(sd, least_sd * largest);
  const double change = std::abs(sd * weight[rows_of[place].front()] - 1);
  for (Index row : rows_of[place]) weight[row] = 1 / sd;
  return change;
}

void Search::follow_other_axes() {
  for (std::size_t place = 0; place < std::size(rows_of); ++place) {
    if (!sharp_as[place]) continue;
    for (Index row : rows_of[place]) weight[row] = weight[rows_of[*sharp_as[place]].front()];
  }
}

bool Search::any_estimated() const {
  return std::ranges::any_of(estimated, [](bool each) { return each; });
}

double Search::estimate_noise(const VectorXd& parameters) {
  const VectorXd all = model.values(parameters) - data;
  const double share =
      std::max(1.0, static_cast<double>(values) - static_cast<double>(free.size())) / static_cast<double>(values);
  double largest = 0;
  for (std::size_t place = 0; place < std::size(rows_of); ++place) {
    if (!estimated[place] || sharp_as[place]) continue;
    const std::vector<Index>& rows = rows_of[place];
    double sd = 0;
    if (request.robust) {
      std::vector<double> sizes;
      for (Index row : rows) sizes.push_back(std::abs(all[row]));
      sd = sd_by_median(std::move(sizes)) / std::sqrt(share);
    } else {
      for (Index row : rows) sd += all[row] * all[row];
      sd = std::sqrt(sd / (share * static_cast<double>(rows.size())));
    }
    largest = std::max(largest, set_sd(place, sd));
  }
  follow_other_axes();
  return largest;
}

std::vector<Track> Search::with_noise(std::vector<Track> tracks) const {
  for (Track& track : tracks) {
    for (Series& series : track.series) {
      if (series.sd.size() != 0) continue;
      const Index row = rows_of[static_cast<std::size_t>(series.observable)].front();
      series.sd = Eigen::ArrayXd::Constant(track.t.size(), 1 / weight[row]);
    }
  }
  return tracks;
}

}  // namespace contensou::fit
