#include "fit/report.hpp"

#include <algorithm>
#include <cmath>

#include "contensou/reduction/detail/infinity.hpp"

namespace contensou::fit {

using Eigen::Index;

namespace {

/// Rise of the sum of squares if there are several minima, divided by the rise for one minimum.
constexpr double of_two_numbers = 5.991 / (normal_quantile * normal_quantile);

}  // namespace

/// A motion depends on k = slip/(patch radius |spin|) at the start. If no series shows the spin, two k with different
/// frictions may give nearly the same slip. The same holds for the spin if no series shows the slip.
void Reporter::set_other_motions(Profile& profile) {
  // If the patch radius is free, it compensates for any spin. Then profiles are wide, and cover the other motions.
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
    // Beyond |ln k| = `farthest` one of slip and spin has hardly any effect on the other.
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
  // A film is less accurate than 1e-6, so orbits of this accuracy suffice.
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
  // Most films determine the patch radius worst of all numbers, so its valley is the longest and comes first.
  std::ranges::stable_sort(numbers, {},
                           [](const Number& number) { return number.coordinate.powers != Eigen::Vector2d(0, 1); });
  // Several motions may fit equally well if other motions were found. The same holds for a slip or a spin that no
  // series shows, if the interval of the friction has no end on one side.
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

}  // namespace contensou::fit
