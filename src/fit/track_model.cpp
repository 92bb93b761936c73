#include "fit/track_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace contensou::fit {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

using reduction::homogeneous_ball;

constexpr double min_ln_friction = -9.2, max_ln_friction = 2.3, min_ln_ratio = -14;

/// What friction takes of the velocity of the centre for each m/s of slip (Zh98 after (2.5)).
constexpr double velocity_for_slip = 1 / homogeneous_ball.chi;

/// The largest mu up to 1 under which the law has no invariant ray: (5/7) mu^2 k Psi < Phi for all k.
double max_ratio(const reduction::Law& law) {
  double least = 1;
  for (double ln_k = -20; ln_k <= 20; ln_k += 0.1) {
    const double k = std::exp(ln_k);
    const auto [force, moment] = law(reduction::slip_of_ratio(k));
    constexpr double some = 0.99;
    least = std::min(least, some * std::sqrt(homogeneous_ball.chi / homogeneous_ball.gamma * force / (k * moment)));
  }
  return least;
}

/// The motion of one track.
struct Motion {
  const Track& track;
  const VectorXd& parameters;
  std::size_t number;
  double radius;
  double rate;  ///< f g
  double cosine = std::cos(of(Parameter::direction)), sine = std::sin(of(Parameter::direction));

  double of(Parameter parameter) const { return parameters[TrackModel::place(parameter, number)]; }

  /// What the orbit, with the slip v0 at the start, makes of a series at t: linear in both, so also what changes of them
  /// do.
  double of_orbit(Observable observable, const Speeds& by, double v0, double t) const {
    switch (observable) {
      case Observable::slip:
        return by.v;
      case Observable::spin:
        return by.u / radius;
      case Observable::x:
        return velocity_for_slip * cosine * (by.slid - v0 * t);
      case Observable::y:
        return velocity_for_slip * sine * (by.slid - v0 * t);
      case Observable::vx:
        return velocity_for_slip * cosine * (by.v - v0);
      case Observable::vy:
        return velocity_for_slip * sine * (by.v - v0);
      case Observable::angle:
        break;
    }
    return by.turned / radius;
  }

  /// The derivative of a series by a number that only places the track, at t.
  double placing(Observable observable, Parameter parameter, const Speeds& now, double t) const {
    using enum Observable;
    if (parameter == Parameter::direction) {
      const double v0 = of(Parameter::slip);
      if (observable == x) return -velocity_for_slip * sine * (now.slid - v0 * t);
      if (observable == y) return velocity_for_slip * cosine * (now.slid - v0 * t);
      if (observable == vx) return -velocity_for_slip * sine * (now.v - v0);
      if (observable == vy) return velocity_for_slip * cosine * (now.v - v0);
      return 0;
    }
    if ((parameter == Parameter::vx && observable == x) || (parameter == Parameter::vy && observable == y)) return t;
    const bool itself =
        (parameter == Parameter::x && observable == x) || (parameter == Parameter::y && observable == y) ||
        (parameter == Parameter::vx && observable == vx) || (parameter == Parameter::vy && observable == vy) ||
        (parameter == Parameter::angle && observable == angle);
    return itself ? 1 : 0;
  }

  /// A series at t.
  double value(Observable observable, const Speeds& now, double t) const {
    double result = of_orbit(observable, now, of(Parameter::slip), t);
    for (Parameter parameter : {Parameter::vx, Parameter::vy, Parameter::x, Parameter::y, Parameter::angle}) {
      result += of(parameter) * placing(observable, parameter, now, t);
    }
    return result;
  }
};

}  // namespace

TrackModel::TrackModel(const si::Experiment& ball, const reduction::Law& law, const std::vector<Track>& tracks,
                       double accuracy)
    : radius_(ball.ball.radius),
      gravity_(ball.environment.gravity),
      accuracy_(accuracy),
      max_ln_patch_radius_(std::log(max_ratio(law) * radius_)),
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
    case Parameter::slip:
      return {-max_speed, max_speed};
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

const ScaledOrbit& TrackModel::orbit_of(std::size_t i, const VectorXd& parameters) const {
  const double patch_radius = parameters[1], slip = parameters[place(Parameter::slip, i)],
               spin = parameters[place(Parameter::spin, i)];
  std::optional<Known>& known = orbits_[i];
  if (!known || known->ln_patch_radius != patch_radius || known->slip != slip || known->spin != spin) {
    known = Known{patch_radius,
                  slip,
                  spin,
                  {law_, std::exp(patch_radius) / radius_, {.u = radius_ * spin, .v = slip}, accuracy_}};
  }
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
    const ScaledOrbit& orbit = orbit_of(i, parameters);
    const Motion motion{track, parameters, i, radius_, std::exp(parameters[0]) * gravity_};
    std::size_t cell = 0;
    for (Index row = 0; row < track.t.size(); ++row) {
      const double t = track.t[row] - track.start;
      const Speeds scaled = orbit.speeds_at(motion.rate * t, cell);
      const Speeds now{scaled.v, scaled.u, scaled.slid / motion.rate, scaled.turned / motion.rate};
      Index place = first + row;
      for (const Series& series : track.series) {
        result[place] = motion.value(series.observable, now, t);
        place += track.t.size();
      }
    }
    first += track.t.size() * static_cast<Index>(track.series.size());
    if (track.stop_time) result[first++] = orbit.stop().T / motion.rate;
  }
  return result;
}

Eigen::MatrixXd TrackModel::derivatives(const VectorXd& free, const std::vector<Index>& wanted) const {
  const VectorXd parameters = limited(free);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows_, static_cast<Index>(wanted.size()));
  Index first = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    const ScaledOrbit& orbit = orbit_of(i, parameters);
    const double rate = std::exp(parameters[0]) * gravity_;
    const Motion motion{track, parameters, i, radius_, rate};
    // The columns that change this track; beyond a limit a parameter changes nothing.
    std::vector<std::pair<Index, Parameter>> columns;
    for (std::size_t column = 0; column < wanted.size(); ++column) {
      const Index at = wanted[column];
      if (at >= shared_parameters && track_of(at) != i) continue;
      if (parameters[at] != free[at]) continue;
      columns.emplace_back(static_cast<Index>(column), parameter_at(at));
    }
    std::size_t cell = 0;
    for (Index row = 0; row < track.t.size(); ++row) {
      const double t = track.t[row] - track.start, T = rate * t;
      const ScaledOrbit::Moment moment = orbit.at(T, cell);
      const auto over_time = [&](const Speeds& by) { return Speeds{by.v, by.u, by.slid / rate, by.turned / rate}; };
      const Speeds now = over_time(moment.now);
      for (const auto& [column, parameter] : columns) {
        Speeds by{};
        double v0_by = 0;
        switch (parameter) {
          case Parameter::friction:  // which stretches time alone
            by = {T * moment.dv, T * moment.du, t * now.v - now.slid, t * now.u - now.turned};
            break;
          case Parameter::patch_radius:
            by = over_time(moment.by_ln_mu);
            break;
          case Parameter::slip:
            by = over_time(moment.by_v);
            v0_by = 1;
            break;
          case Parameter::spin:
            by = radius_ * over_time(moment.by_u);
            break;
          default:
            break;
        }
        const bool places = static_cast<int>(parameter) >= static_cast<int>(Parameter::direction);
        Index place = first + row;
        for (const Series& series : track.series) {
          result(place, column) = places ? motion.placing(series.observable, parameter, now, t)
                                         : motion.of_orbit(series.observable, by, v0_by, t);
          place += track.t.size();
        }
      }
    }
    first += track.t.size() * static_cast<Index>(track.series.size());
    if (!track.stop_time) continue;
    const ScaledOrbit::Stop stop = orbit.stop();
    for (const auto& [column, parameter] : columns) {
      result(first, column) = parameter == Parameter::friction       ? -stop.T / rate
                              : parameter == Parameter::patch_radius ? stop.by_ln_mu / rate
                              : parameter == Parameter::slip         ? stop.by_v / rate
                              : parameter == Parameter::spin         ? radius_ * stop.by_u / rate
                                                                     : 0;
    }
    ++first;
  }
  return result;
}

}  // namespace contensou::fit
