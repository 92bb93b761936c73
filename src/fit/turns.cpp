#include "fit/turns.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "fit/search.hpp"

namespace contensou::fit {

using Eigen::Index;

namespace {

constexpr double turn = 2 * std::numbers::pi;
/// Two fits count as equally good if their Akaike criteria differ by at most this.
constexpr double no_preference = 4;
/// Largest surface speed by spin, m/s, that is tried, unless the given spin of the ball is faster. A table-tennis ball
/// with 150 turns per second, one of the fastest, has 19 m/s.
constexpr double fastest_spin = 20;

/// Two successive measured angles: the time between them, s, and the growth of the angle, rad, up to whole turns.
struct Step {
  double time, growth;
};
std::vector<Step> steps_of(const Track& track, const Series& angle) {
  std::vector<Step> steps;
  Index last = -1;
  for (Index i = 0; i < track.t.size(); ++i) {
    if (std::isnan(angle.value[i])) continue;
    if (last >= 0) steps.push_back({track.t[i] - track.t[last], angle.value[i] - angle.value[last]});
    last = i;
  }
  return steps;
}

double usual_time(const std::vector<Step>& steps) {
  std::vector<double> times;
  for (const Step& step : steps) times.push_back(step.time);
  return median(std::move(times));
}

/// Returns the rate, rad/s, at which the angle grows in the first steps of usual duration, at most half a turn each.
double slow_rate(const std::vector<Step>& steps, double usual) {
  constexpr int most = 10;
  std::complex<double> sum = 0;
  int count = 0;
  for (const Step& step : steps) {
    if (count == most) break;
    if (std::abs(step.time - usual) > 0.01 * usual) continue;
    sum += std::polar(1.0, step.growth);
    ++count;
  }
  return std::arg(sum) / usual;
}

/// Adds whole turns to the angles of a track. @param rate  rate, rad/s, at which the angle grows at first
void unwrap(const Track& track, Series& angle, double rate) {
  constexpr double share_of_last = 0.3;  // weight of the last step in the smoothed rate
  Index last = -1;
  for (Index i = 0; i < track.t.size(); ++i) {
    double& value = angle.value[i];
    if (std::isnan(value)) continue;
    if (last >= 0) {
      const double time = track.t[i] - track.t[last];
      value += turn * std::round((angle.value[last] + rate * time - value) / turn);
      rate += share_of_last * ((value - angle.value[last]) / time - rate);
    }
    last = i;
  }
}

/// Returns true if the track contains a measured spin, which then determines the turns of the angle.
bool seen_by_spin(const Track& track) {
  const Series* spin = series_of(track, Observable::spin);
  return spin != nullptr && !spin->value.isNaN().all();
}

/// Sets the angles of one track to the turns that fit the data best.
Turns set_turns(const FitRequest& request, Track& track) {
  Series* angle = series_of(track, Observable::angle);
  if (angle == nullptr) return {};
  const std::vector<Step> steps = steps_of(track, *angle);
  if (steps.empty()) return {};
  if (seen_by_spin(track)) {
    const Eigen::ArrayXd& spin = series_of(track, Observable::spin)->value;
    unwrap(track, *angle, *std::ranges::find_if_not(spin, [](double each) { return std::isnan(each); }));
    return {};
  }
  const double usual = usual_time(steps), slow = slow_rate(steps, usual), own = si::spin_at_start(request.ball);
  const auto turns_more = [&](double rate) { return std::round((rate - slow) * usual / turn); };
  std::vector<double> more{0, -1, 1, -2, 2};
  std::erase_if(more, [&](double each) {
    return each != 0 && request.ball.ball.radius * std::abs(slow + each * turn / usual) > fastest_spin;
  });
  if (const double by_ball = turns_more(own); !std::ranges::count(more, by_ball)) more.push_back(by_ball);
  if (!request.free.spin) more = {turns_more(own)};

  struct Trial {
    Track track;
    double criterion, spin;
  };
  std::vector<Trial> trials;
  for (double each : more) {
    Track tried = track;
    unwrap(tried, *series_of(tried, Observable::angle), slow + each * turn / usual);
    if (more.size() == 1) {
      track = std::move(tried);
      return {half_turn_spin(track)};
    }
    FitRequest alone{request.ball, request.law,    thinned({tried}, max_of_first_solution),
                     request.free, request.robust, request.each_search};
    Search search(alone);
    try {
      const Eigen::VectorXd found = search.solve();
      trials.push_back({std::move(tried), search.criterion(found), found[TrackModel::place(Parameter::spin)]});
    } catch (const std::runtime_error&) {  // no fit converges with these turns
    }
  }
  if (trials.empty()) throw std::runtime_error("fit: the search for the parameters did not converge");
  // Among the fits that are as good as the best fit, take the fit with the slowest spin.
  const double best = std::ranges::min(trials, {}, &Trial::criterion).criterion;
  std::erase_if(trials, [&](const Trial& trial) { return trial.criterion >= best + no_preference; });
  std::ranges::stable_sort(trials, {}, [](const Trial& trial) { return std::abs(trial.spin); });
  track = std::move(trials.front().track);
  Turns result{half_turn_spin(track)};
  for (std::size_t i = 1; i < trials.size(); ++i) result.other_spins.push_back(trials[i].spin);
  return result;
}

}  // namespace

double half_turn_spin(const Track& track) {
  const Series* angle = series_of(track, Observable::angle);
  if (angle == nullptr || seen_by_spin(track)) return INFINITY;
  const std::vector<Step> steps = steps_of(track, *angle);
  return steps.empty() ? INFINITY : std::numbers::pi / usual_time(steps);
}

std::vector<Turns> set_turns(FitRequest& request) {
  std::vector<Turns> result;
  for (Track& track : request.tracks) result.push_back(set_turns(request, track));
  return result;
}

}  // namespace contensou::fit
