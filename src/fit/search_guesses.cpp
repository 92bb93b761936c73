#include "fit/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <Eigen/QR>

#include "contensou/si/scaling.hpp"

namespace contensou::fit {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr Index max_of_guess = 30;
constexpr double accuracy_of_score = 1e-4, tolerance_of_guess = 1e-5;

/// The value and the slope of a series at its beginning.
struct Beginning {
  double value = NAN;
  double slope = NAN;
};
Beginning beginning(const Track& track, Observable observable) {
  const Series* series = series_of(track, observable);
  if (series == nullptr) return {};
  const Index wanted = std::clamp<Index>(track.t.size() / 30, 3, 30);
  std::vector<double> t, y;
  for (Index i = 0; i < track.t.size() && static_cast<Index>(t.size()) < wanted; ++i) {
    if (std::isnan(series->value[i])) continue;
    t.push_back(track.t[i] - track.start);
    y.push_back(series->value[i]);
  }
  if (y.empty()) return {};
  return {median(y), t.size() > 1 ? (y.back() - y.front()) / (t.back() - t.front()) : NAN};
}

}  // namespace

VectorXd Search::given() const {
  VectorXd parameters = VectorXd::Zero(model.parameters());
  const si::Experiment& ball = request.ball;
  parameters[0] = std::log(ball.contact.friction);
  parameters[1] = std::log(si::patch_radius_of(ball, request.law));
  parameters[2] = ball.contact.rolling_friction;
  const Eigen::Vector2d slip = si::slip_velocity_at_start(ball);
  const si::Velocities start = si::velocities_of(ball.start);
  for (std::size_t i = 0; i < request.tracks.size(); ++i) {
    const auto set = [&](Parameter parameter, double value) { parameters[TrackModel::place(parameter, i)] = value; };
    const auto has = [&](Observable observable) { return series_of(request.tracks[i], observable) != nullptr; };
    const bool along_x = has(Observable::x) || has(Observable::vx), along_y = has(Observable::y) || has(Observable::vy);
    set(Parameter::slip, slip.norm());
    set(Parameter::spin, si::spin_at_start(ball));
    set(Parameter::direction, along_y && !along_x ? std::numbers::pi / 2 : std::atan2(slip.y(), slip.x()));
    if (ball.ball.body.lies_flat()) continue;
    if (resisted) {
      const Eigen::Vector2d along = si::direction_at_start(ball), rolling = start.velocity - slip;
      const bool is_searched = std::ranges::count(free, TrackModel::place(Parameter::rolling, i)) > 0;
      if (!is_searched && !si::points_along(rolling, along))
        throw std::domain_error("fit: with rolling friction a ball must roll the way it slides, or not at all");
      set(Parameter::rolling, std::max(0.0, rolling.dot(along)));
      continue;
    }
    if (along_x) set(Parameter::vx, start.velocity.x());
    if (along_y) set(Parameter::vy, start.velocity.y());
  }
  return parameters;
}

VectorXd Search::placed(VectorXd parameters) const {
  const Index direction = TrackModel::place(Parameter::direction);
  std::vector<Index> linear;
  for (Index place : free) {
    if (place > direction && TrackModel::parameter_at(place) != Parameter::rolling) linear.push_back(place);
  }
  const bool turns = std::ranges::find(free, direction) != free.end();
  if (linear.empty() && !turns) return parameters;
  VectorXd still = parameters;
  for (Index place : linear) still[place] = 0;
  const Eigen::MatrixXd matrix = model.derivatives(parameters, linear);
  const auto solved = [&](const Eigen::MatrixXd& columns, const VectorXd& right, const VectorXd& weights) {
    return VectorXd(
        Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(weights.asDiagonal() * columns).solve(weights.cwiseProduct(right)));
  };
  if (turns) {
    // In the direction d, friction has cos(d) times its effect for d = 0, plus sin(d) times its effect for d = pi/2.
    VectorXd weights = VectorXd::Zero(weight.size());
    for (Observable observable : {Observable::x, Observable::y, Observable::vx, Observable::vy}) {
      for (Index row : rows_of[static_cast<std::size_t>(observable)]) weights[row] = weight[row];
    }
    Eigen::MatrixXd columns(matrix.rows(), matrix.cols() + 2);
    columns.leftCols(matrix.cols()) = matrix;
    still[direction] = 0;
    columns.col(matrix.cols()) = model.values(still);
    still[direction] = std::numbers::pi / 2;
    columns.col(matrix.cols() + 1) = model.values(still);
    const VectorXd found = solved(columns, data, weights);
    still[direction] = std::atan2(found[matrix.cols() + 1], found[matrix.cols()]);
  }
  if (linear.empty()) return still;
  const VectorXd found = solved(matrix, data - model.values(still), weight);
  for (std::size_t i = 0; i < linear.size(); ++i) still[linear[i]] = found[static_cast<Index>(i)];
  return still;
}

VectorXd Search::improved_from_guesses() {
  constexpr std::size_t most_improved = 2;
  const VectorXd given = this->given();
  const double radius = request.ball.ball.radius;
  std::vector<double> frictions{given[0]}, patches{given[1]};
  if (request.free.friction) {
    for (double friction : {0.01, 0.03, 0.06, 0.1, 0.15, 0.22, 0.35, 0.6, 1.0}) frictions.push_back(std::log(friction));
  }
  if (request.free.patch_radius) {
    for (double ratio : {1e-3, 4e-3, 0.015, 0.05, 0.15, 0.5}) patches.push_back(std::log(ratio * radius));
  }
  // Fit each track by itself, with few instants.
  const std::vector<Track> few = with_noise(thinned(request.tracks, max_of_guess));
  std::vector<FitRequest> requests;
  for (const Track& track : few) {
    requests.push_back({request.ball, request.law, {track}, request.free, true});
  }
  std::vector<std::pair<double, VectorXd>> scored;
  for (double patch : patches) {
    for (double friction : frictions) {
      scored.emplace_back(0, given);
      scored.back().second.head<contact_parameters>() << friction, patch;
    }
  }
  for (std::size_t i = 0; i < few.size(); ++i) {
    const Search alone(requests[i], accuracy_of_score);
    for (auto& [cost, parameters] : scored) {
      double least = std::numeric_limits<double>::infinity();
      VectorXd best;
      for (const auto& [slip, spin, rolling] : starts_of(few[i], given)) {
        VectorXd guess(alone.model.parameters());
        guess << parameters.head(shared_parameters),
            given.segment(TrackModel::place(Parameter::slip, i), start_parameters);
        guess[TrackModel::place(Parameter::slip)] = slip;
        guess[TrackModel::place(Parameter::spin)] = spin;
        guess[TrackModel::place(Parameter::rolling)] = rolling;
        guess = alone.placed(guess);
        const double loss = alone.cost(guess);
        if (loss < least || best.size() == 0) {
          least = loss;
          best = guess;
        }
      }
      cost += least;
      parameters.segment(TrackModel::place(Parameter::slip, i), start_parameters) = best.tail(start_parameters);
    }
  }
  const VectorXd given_placed = scored.front().second;
  std::ranges::sort(scored, {}, [](const auto& guess) { return guess.first; });
  for (const auto& [cost, parameters] : scored) guesses.push_back(parameters);
  // The ball's own values are improved first. They are kept unless another start is clearly better.
  constexpr double no_better = 0.1;
  VectorXd best = improved(given_placed, nullptr, tolerance_of_guess);
  double least = cost(best) - no_better;
  for (std::size_t i = 0; i < std::min(most_improved, guesses.size()); ++i) {
    const VectorXd parameters = improved(guesses[i], nullptr, tolerance_of_guess);
    if (const double loss = cost(parameters); loss < least) {
      least = loss;
      best = parameters;
    }
  }
  return best;
}

std::vector<Search::Begun> Search::starts_of(const Track& track, const VectorXd& given) const {
  const double slip_of_ball = given[TrackModel::place(Parameter::slip)];
  const double spin_of_ball = given[TrackModel::place(Parameter::spin)];
  const double radius = request.ball.ball.radius;
  std::vector<double> slips{slip_of_ball}, spins{spin_of_ball};
  const auto first = [&](Observable place, Observable velocity) {
    const double by_velocity = beginning(track, velocity).value;
    if (!std::isnan(by_velocity)) return by_velocity;
    const double by_place = beginning(track, place).slope;
    return std::isnan(by_place) ? 0 : by_place;
  };
  const double speed = std::hypot(first(Observable::x, Observable::vx), first(Observable::y, Observable::vy));
  if (request.free.slip) {
    if (const double seen = beginning(track, Observable::slip).value; !std::isnan(seen)) {
      slips = {seen};
    } else if (speed > 0) {
      slips = {speed / 2, speed, 2 * speed};
    }
  }
  if (request.free.spin) {
    if (const double seen = beginning(track, Observable::spin).value; !std::isnan(seen)) {
      spins = {seen};
    } else if (const double turning = beginning(track, Observable::angle).slope; !std::isnan(turning)) {
      spins = {turning};
    } else if (spin_of_ball == 0) {
      spins = {slips[slips.size() / 2] / radius};
    }
  }
  const bool rolls = std::ranges::any_of(free, [](Index place) {  // the speed of the centre contains the rolling
    return TrackModel::parameter_at(place) == Parameter::rolling;
  });
  const auto begun = [&](double slip, double spin) {
    return Begun{slip, spin, rolls ? std::max(0.0, speed - slip) : given[TrackModel::place(Parameter::rolling)]};
  };
  std::vector<Begun> starts;
  for (double slip : slips) {
    for (double spin : spins) {
      if (slip != 0 || spin != 0) starts.push_back(begun(slip, spin));
    }
  }
  if (starts.empty()) starts.push_back(begun(slip_of_ball, spin_of_ball));
  return starts;
}

}  // namespace contensou::fit
