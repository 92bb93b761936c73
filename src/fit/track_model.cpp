#include "fit/track_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fit/rolling_orbit.hpp"

namespace contensou::fit {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double min_ln_friction = -9.2, max_ln_friction = 2.3, min_ln_ratio = -14, max_rolling_friction = 1;

/// The largest mu up to 1 under which the law has no invariant ray: gamma mu^2 k Psi < chi Phi for all k.
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

/// The same after that many m/s^2, f g, have made a time of T.
Speeds over_rate(const Speeds& by, double rate) {
  return {by.v, by.u, by.slid / rate, by.turned / rate, by.centre, by.way / rate};
}

/// The motion of one track.
struct Motion {
  const Track& track;
  const VectorXd& parameters;
  std::size_t number;
  double radius;
  double velocity_for_slip;  ///< 1/chi: what friction takes of the velocity of the centre for each m/s of slip
  bool lies_flat;            ///< the slip is the velocity of the centre
  bool resisted;             ///< by rolling friction: the orbit has the velocity of the centre
  double rate;               ///< f g
  double cosine = std::cos(of(Parameter::direction)), sine = std::sin(of(Parameter::direction));

  double of(Parameter parameter) const { return parameters[TrackModel::place(parameter, number)]; }

  /// What friction takes of the velocity of the centre along the slip, in units of the slip, and of its way; of what lies
  /// flat and with rolling friction all of both.
  double way(const Speeds& by, double v0, double t) const {
    return resisted ? by.way : lies_flat ? by.slid : velocity_for_slip * (by.slid - v0 * t);
  }
  double velocity(const Speeds& by, double v0) const {
    return resisted ? by.centre : lies_flat ? by.v : velocity_for_slip * (by.v - v0);
  }

  /// What the orbit, with the slip v0 at the start, makes of a series at t: linear in both, so also what changes of them
  /// do.
  double of_orbit(Observable observable, const Speeds& by, double v0, double t) const {
    switch (observable) {
      case Observable::slip:
        return by.v;
      case Observable::spin:
        return by.u / radius;
      case Observable::x:
        return cosine * way(by, v0, t);
      case Observable::y:
        return sine * way(by, v0, t);
      case Observable::vx:
        return cosine * velocity(by, v0);
      case Observable::vy:
        return sine * velocity(by, v0);
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
      if (observable == x) return -sine * way(now, v0, t);
      if (observable == y) return cosine * way(now, v0, t);
      if (observable == vx) return -sine * velocity(now, v0);
      if (observable == vy) return cosine * velocity(now, v0);
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
                       double accuracy, bool resisted)
    : inertia_(ball.ball.body.inertia),
      lies_flat_(ball.ball.body.lies_flat()),
      resisted_(resisted),
      radius_(ball.ball.radius),
      gravity_(ball.environment.gravity),
      accuracy_(accuracy),
      // What rolling friction holds slides like a puck.
      max_ln_patch_radius_(std::log(
          (lies_flat_ ? 1 : max_ratio(law, resisted ? reduction::Inertia{1, inertia_.gamma} : inertia_)) * radius_)),
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
      return {resisted_ ? 0 : -max_speed, max_speed};
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

std::unique_ptr<FilmOrbit> TrackModel::new_orbit(const OrbitNumbers& of) const {
  const double mu = std::exp(of.ln_patch_radius) / radius_;
  const reduction::State start{.u = radius_ * of.spin, .v = of.slip};
  if (resisted_) return std::make_unique<RollingOrbit>(law_, mu, start, of.rolling, of.drive, inertia_, accuracy_);
  if (!lies_flat_) return std::make_unique<ScaledOrbit>(law_, mu, start, accuracy_, inertia_);
  if (!flows_ || flows_->here.system().mu() != mu)
    flows_ = std::make_shared<const FlowsOfPatch>(reduction::ReducedSystem(law_, mu, inertia_));
  return std::make_unique<FlowOrbit>(flows_, start);
}

TrackModel::OrbitNumbers TrackModel::orbit_numbers(std::size_t i, const VectorXd& parameters) const {
  const auto of = [&](Parameter parameter) { return parameters[place(parameter, i)]; };
  OrbitNumbers numbers{of(Parameter::patch_radius), of(Parameter::slip), of(Parameter::spin), 0, 0};
  if (resisted_) {
    numbers.rolling = of(Parameter::rolling);
    numbers.drive = of(Parameter::rolling_friction) / std::exp(of(Parameter::friction));
  }
  return numbers;
}

const FilmOrbit& TrackModel::orbit_of(std::size_t i, const VectorXd& parameters) const {
  const OrbitNumbers numbers = orbit_numbers(i, parameters);
  std::optional<Known>& known = orbits_[i];
  if (!known || known->numbers != numbers) known = Known{numbers, new_orbit(numbers)};
  const Track& track = tracks_[i];
  known->orbit->reach(track.stop_time
                          ? std::numeric_limits<double>::infinity()
                          : std::exp(parameters[0]) * gravity_ * (track.t[track.t.size() - 1] - track.start));
  return *known->orbit;
}

VectorXd TrackModel::values(const VectorXd& free) const {
  const VectorXd parameters = limited(free);
  VectorXd result(rows_);
  Index first = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    const FilmOrbit& orbit = orbit_of(i, parameters);
    const Motion motion{
        track, parameters, i, radius_, 1 / inertia_.chi, lies_flat_, resisted_, std::exp(parameters[0]) * gravity_};
    std::size_t cell = 0;
    for (Index row = 0; row < track.t.size(); ++row) {
      const double t = track.t[row] - track.start;
      const Speeds scaled = orbit.speeds_at(motion.rate * t, cell);
      const Speeds now = over_rate(scaled, motion.rate);
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
    const FilmOrbit& orbit = orbit_of(i, parameters);
    const double rate = std::exp(parameters[0]) * gravity_;
    const Motion motion{track, parameters, i, radius_, 1 / inertia_.chi, lies_flat_, resisted_, rate};
    const double drive = orbit_numbers(i, parameters).drive;
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
      const FilmOrbit::Moment moment = orbit.at(T, cell);
      const auto over_time = [&](const Speeds& by) { return over_rate(by, rate); };
      const Speeds now = over_time(moment.now);
      for (const auto& [column, parameter] : columns) {
        Speeds by{};
        double v0_by = 0;
        switch (parameter) {
          case Parameter::friction:  // which stretches time, and is in the drive
            by = Speeds{T * moment.dv,          T * moment.du,      t * now.v - now.slid,
                        t * now.u - now.turned, T * moment.dcentre, t * now.centre - now.way} +
                 -drive * over_time(moment.by_drive);
            break;
          case Parameter::rolling_friction:
            by = 1 / std::exp(parameters[0]) * over_time(moment.by_drive);
            break;
          case Parameter::rolling:
            by = over_time(moment.by_rolling);
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
        const bool places =
            parameter != Parameter::rolling && static_cast<int>(parameter) >= static_cast<int>(Parameter::direction);
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
    const FilmOrbit::Stop stop = orbit.stop();
    for (const auto& [column, parameter] : columns) {
      result(first, column) = parameter == Parameter::friction           ? -(stop.T + drive * stop.by_drive) / rate
                              : parameter == Parameter::patch_radius     ? stop.by_ln_mu / rate
                              : parameter == Parameter::rolling_friction ? stop.by_drive * gravity_ / (rate * rate)
                              : parameter == Parameter::slip             ? stop.by_v / rate
                              : parameter == Parameter::spin             ? radius_ * stop.by_u / rate
                              : parameter == Parameter::rolling          ? stop.by_rolling / rate
                                                                         : 0;
    }
    ++first;
  }
  return result;
}

}  // namespace contensou::fit
