#include "fit/track_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace contensou::fit {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double min_ln_friction = -9.2, max_ln_friction = 2.3, min_ln_ratio = -14, max_rolling_friction = 1;

/// Returns the largest mu <= 1 for which the law has no invariant ray: gamma mu^2 k Psi < chi Phi for all k.
double max_ratio(const reduction::Law& law, reduction::Inertia inertia) {
  double least = 1;
  for (double ln_k = -20; ln_k <= 20; ln_k += 0.1) {
    const double k = std::exp(ln_k);
    const auto [force, moment] = law(reduction::slip_of_ratio(k));
    constexpr double some = 0.99;
    least = std::min(least, some * std::sqrt(inertia.chi / inertia.gamma * force / (k * moment)));
  }
  return least;
}

/// Converts integrals over T = f g t into integrals over t. Speeds do not change.
/// @param rate  f g, m/s^2, > 0
Speeds over_rate(const Speeds& by, double rate) {
  return {by.v, by.u, by.slid / rate, by.turned / rate, by.centre, by.way / rate};
}

/// The motion of one track, given by its parameters.
struct Motion {
  const VectorXd& parameters;
  std::size_t number;
  double radius;
  double cosine = std::cos(of(Parameter::direction)), sine = std::sin(of(Parameter::direction));

  double of(Parameter parameter) const { return parameters[TrackModel::place(parameter, number)]; }

  /// Returns the part of an observable that the orbit determines. It is linear in `by`, which may be a derivative.
  double of_orbit(Observable observable, const Speeds& by) const {
    switch (observable) {
      case Observable::slip:
        return by.v;
      case Observable::spin:
        return by.u / radius;
      case Observable::x:
        return cosine * by.way;
      case Observable::y:
        return sine * by.way;
      case Observable::vx:
        return cosine * by.centre;
      case Observable::vy:
        return sine * by.centre;
      case Observable::angle:
        break;
    }
    return by.turned / radius;
  }

  /// Returns the derivative of an observable at t with respect to a parameter that only places the track.
  double placing(Observable observable, Parameter parameter, const Speeds& now, double t) const {
    using enum Observable;
    if (parameter == Parameter::direction) {
      if (observable == x) return -sine * now.way;
      if (observable == y) return cosine * now.way;
      if (observable == vx) return -sine * now.centre;
      if (observable == vy) return cosine * now.centre;
      return 0;
    }
    if ((parameter == Parameter::vx && observable == x) || (parameter == Parameter::vy && observable == y)) return t;
    const bool itself =
        (parameter == Parameter::x && observable == x) || (parameter == Parameter::y && observable == y) ||
        (parameter == Parameter::vx && observable == vx) || (parameter == Parameter::vy && observable == vy) ||
        (parameter == Parameter::angle && observable == angle);
    return itself ? 1 : 0;
  }

  /// Returns the value of a series at the time t.
  double value(Observable observable, const Speeds& now, double t) const {
    double result = of_orbit(observable, now);
    for (Parameter parameter : {Parameter::vx, Parameter::vy, Parameter::x, Parameter::y, Parameter::angle}) {
      result += of(parameter) * placing(observable, parameter, now, t);
    }
    return result;
  }
};

}  // namespace

TrackModel::TrackModel(const si::Experiment& ball, const reduction::Law& law, const std::vector<Track>& tracks,
                       double accuracy, bool resisted)
    : inertia_(ball.ball.body.inertia),
      kind_(resisted                     ? Kind::resisted
            : ball.ball.body.lies_flat() ? Kind::flat
                                         : Kind::ball),
      radius_(ball.ball.radius),
      gravity_(ball.environment.gravity),
      accuracy_(accuracy),
      // A ball that rolling friction keeps from turning slides like a puck, with chi = 1.
      max_ln_patch_radius_(std::log(
          (kind_ == Kind::flat ? 1 : max_ratio(law, resisted ? reduction::Inertia{1, inertia_.gamma} : inertia_)) *
          radius_)),
      law_(law),
      tracks_(tracks),
      orbits_(tracks.size()) {
  for (const Track& track : tracks) {
    rows_ += track.t.size() * static_cast<Index>(track.series.size()) + (track.stop_time ? 1 : 0);
  }
}

TrackModel::Range TrackModel::range(Index place) const {
  switch (parameter_at(place)) {
    case Parameter::friction:
      return {min_ln_friction, max_ln_friction};
    case Parameter::patch_radius:
      return {min_ln_ratio + std::log(radius_), max_ln_patch_radius_};
    case Parameter::rolling_friction:
      return {0, max_rolling_friction};
    case Parameter::slip:
      return {kind_ == Kind::resisted ? 0 : -max_speed, max_speed};
    case Parameter::rolling:
      return {0, max_speed};
    case Parameter::spin:
      return {-max_speed / radius_, max_speed / radius_};
    default:
      return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
}

VectorXd TrackModel::limited(VectorXd parameters) const {
  for (Index place = 0; place < parameters.size(); ++place) {
    const auto [low, high] = range(place);
    parameters[place] = std::clamp(parameters[place], low, high);
  }
  return parameters;
}

FilmOrbit::Numbers TrackModel::orbit_numbers(std::size_t i, const VectorXd& parameters) const {
  const auto of = [&](Parameter parameter) { return parameters[place(parameter, i)]; };
  FilmOrbit::Numbers numbers{of(Parameter::patch_radius) - std::log(radius_), of(Parameter::slip),
                             radius_ * of(Parameter::spin)};
  if (kind_ == Kind::resisted) {
    numbers[FilmOrbit::drive] = of(Parameter::rolling_friction) / std::exp(of(Parameter::friction));
    numbers[FilmOrbit::rolling] = of(Parameter::rolling);
  }
  return numbers;
}

const FilmOrbit& TrackModel::orbit_of(std::size_t i, const VectorXd& parameters) const {
  const FilmOrbit::Numbers numbers = orbit_numbers(i, parameters);
  std::optional<Known>& known = orbits_[i];
  if (!known || known->numbers != numbers) known.emplace(Known{numbers, {law_, inertia_, kind_, numbers, accuracy_}});
  const Track& track = tracks_[i];
  known->orbit.reach(track.stop_time
                         ? std::numeric_limits<double>::infinity()
                         : std::exp(parameters[0]) * gravity_ * (track.t[track.t.size() - 1] - track.start));
  return known->orbit;
}

VectorXd TrackModel::values(const VectorXd& free) const {
  const VectorXd parameters = limited(free);
  VectorXd result(rows_);
  Index first = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    const FilmOrbit& orbit = orbit_of(i, parameters);
    const double rate = std::exp(parameters[0]) * gravity_;
    const Motion motion{parameters, i, radius_};
    for (Index row = 0; row < track.t.size(); ++row) {
      const double t = track.t[row] - track.start;
      const Speeds now = over_rate(orbit.speeds_at(rate * t), rate);
      Index place = first + row;
      for (const Series& series : track.series) {
        result[place] = motion.value(series.observable, now, t);
        place += track.t.size();
      }
    }
    first += track.t.size() * static_cast<Index>(track.series.size());
    if (track.stop_time) result[first++] = orbit.stop() / rate;
  }
  return result;
}

Eigen::MatrixXd TrackModel::derivatives(const VectorXd& free, const std::vector<Index>& wanted) const {
  const VectorXd parameters = limited(free);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows_, static_cast<Index>(wanted.size()));
  Index first = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    const FilmOrbit& orbit = orbit_of(i, parameters);
    const double rate = std::exp(parameters[0]) * gravity_;
    const Motion motion{parameters, i, radius_};
    /// Returns the number of the orbit that a parameter changes, and the derivative of this number by the parameter.
    const auto number_of = [&](Parameter parameter) -> std::pair<FilmOrbit::Number, double> {
      switch (parameter) {
        case Parameter::friction:  // friction also stretches time: see below
          return {FilmOrbit::drive, -orbit_numbers(i, parameters)[FilmOrbit::drive]};
        case Parameter::rolling_friction:
          return {FilmOrbit::drive, 1 / std::exp(parameters[0])};
        case Parameter::patch_radius:
          return {FilmOrbit::ln_mu, 1};
        case Parameter::slip:
          return {FilmOrbit::slip, 1};
        case Parameter::spin:
          return {FilmOrbit::spin, radius_};
        case Parameter::rolling:
          return {FilmOrbit::rolling, 1};
        default:
          return {FilmOrbit::rolling, 0};
      }
    };
    // Collect the parameters that change this track. A parameter beyond its limit changes nothing.
    std::vector<std::pair<Index, Parameter>> columns;
    for (std::size_t column = 0; column < wanted.size(); ++column) {
      const Index at = wanted[column];
      if (at >= shared_parameters && track_of(at) != i) continue;
      if (parameters[at] != free[at]) continue;
      columns.emplace_back(static_cast<Index>(column), parameter_at(at));
    }
    for (Index row = 0; row < track.t.size(); ++row) {
      const double t = track.t[row] - track.start;
      const Speeds now = over_rate(orbit.speeds_at(rate * t), rate);
      for (const auto& [column, parameter] : columns) {
        const auto [number, factor] = number_of(parameter);
        Speeds by{};
        if (factor != 0) by = factor * over_rate(orbit.by(number, rate * t), rate);
        if (parameter == Parameter::friction)
          by =
              by + over_rate(rate * t * orbit.by_T(rate * t), rate) + Speeds{0, 0, -now.slid, -now.turned, 0, -now.way};
        const bool places =
            parameter != Parameter::rolling && static_cast<int>(parameter) >= static_cast<int>(Parameter::direction);
        Index place = first + row;
        for (const Series& series : track.series) {
          result(place, column) =
              places ? motion.placing(series.observable, parameter, now, t) : motion.of_orbit(series.observable, by);
          place += track.t.size();
        }
      }
    }
    first += track.t.size() * static_cast<Index>(track.series.size());
    if (!track.stop_time) continue;
    for (const auto& [column, parameter] : columns) {
      const auto [number, factor] = number_of(parameter);
      const double by = (factor != 0 ? factor * orbit.stop_by(number) : 0);
      result(first, column) = (by - (parameter == Parameter::friction ? orbit.stop() : 0)) / rate;
    }
    ++first;
  }
  return result;
}

/// All accelerations are proportional to f. If f varies, the speeds are therefore those of the even motion at T = g
/// times the integral of f over t, and a small change of T changes them by their derivatives by T.
Eigen::MatrixXd TrackModel::by_uneven_friction(const VectorXd& free, Index modes) const {
  const VectorXd parameters = limited(free);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows_, modes * static_cast<Index>(tracks_.size()));
  Index first = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    const Index count = track.t.size(), rows = count * static_cast<Index>(track.series.size());
    const FilmOrbit& orbit = orbit_of(i, parameters);
    const double rate = std::exp(parameters[0]) * gravity_, mu = std::exp(parameters[1]) / radius_;
    const Motion motion{parameters, i, radius_};
    constexpr Index steps = 512;
    const double seen = count > 0 ? track.t[count - 1] - track.start : 0;
    const double dt = (track.stop_time ? orbit.stop() / rate : seen) / steps;
    std::vector<Speeds> by_T;
    std::vector<double> path{0};
    double before = 0;
    for (Index k = 0; k <= steps; ++k) {
      const double T = rate * dt * static_cast<double>(k);
      const Speeds now = orbit.speeds_at(T);
      const double speed = std::abs(now.v) + mu * std::abs(now.u);
      if (k > 0) path.push_back(path.back() + (before + speed) / 2);
      before = speed;
      by_T.push_back(orbit.by_T(T));
    }
    if (path.back() == 0) path.back() = 1;
    for (Index mode = 1; mode <= modes; ++mode) {
      const Index column = modes * static_cast<Index>(i) + mode - 1;
      std::vector<Speeds> changes;
      double more = 1, later = 0;  // c cos(pi j s)/c, and the change of T
      for (std::size_t k = 0; k < path.size(); ++k) {
        const double now = std::cos(std::numbers::pi * static_cast<double>(mode) * path[k] / path.back());
        if (k > 0) later += rate * dt * (more + now) / 2;
        more = now;
        Speeds change{later * by_T[k].v, later * by_T[k].u, 0, 0, later * by_T[k].centre, 0};
        if (k > 0) {
          const Speeds& last = changes.back();
          change.slid = last.slid + dt * (last.v + change.v) / 2;
          change.turned = last.turned + dt * (last.u + change.u) / 2;
          change.way = last.way + dt * (last.centre + change.centre) / 2;
        }
        changes.push_back(change);
      }
      for (Index row = 0; row < count; ++row) {
        const double at = dt > 0 ? std::min((track.t[row] - track.start) / dt, static_cast<double>(steps)) : 0;
        const auto k = std::min(static_cast<std::size_t>(at), path.size() - 2);
        const double part = at - static_cast<double>(k);
        const Speeds change = (1 - part) * changes[k] + part * changes[k + 1];
        Index place = first + row;
        for (const Series& series : track.series) {
          result(place, column) = motion.of_orbit(series.observable, change);
          place += count;
        }
      }
      if (track.stop_time) result(first + rows, column) = -later / rate;
    }
    first += rows + (track.stop_time ? 1 : 0);
  }
  return result;
}

}  // namespace contensou::fit
