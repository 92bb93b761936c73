#include "fit/track_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/scaled_orbit.hpp"

namespace contensou::fit {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Steps of central differences: of ln eps, and of the angle of (slip, R spin).
constexpr double ratio_step = 1e-3;
constexpr double angle_step = 1e-4;

constexpr double min_ln_friction = -9.2, max_ln_friction = 2.3, min_ln_ratio = -14;

/// What friction takes of the velocity of the centre for each m/s of slip (Zh98 after (2.5)).
constexpr double velocity_for_slip = 2.0 / 7;

double number(const VectorXd& parameters, Parameter parameter, std::size_t track) {
  return parameters[TrackModel::place(parameter, track)];
}

/// Slip and pivoting speed over time, their integrals over it, and the stop time; or the derivatives of all these.
struct Columns {
  ArrayXd v, u, slid, turned;
  double stop = 0;
};

Columns operator-(const Columns& a, const Columns& b) {
  return {a.v - b.v, a.u - b.u, a.slid - b.slid, a.turned - b.turned, a.stop - b.stop};
}

Columns operator+(const Columns& a, const Columns& b) {
  return {a.v + b.v, a.u + b.u, a.slid + b.slid, a.turned + b.turned, a.stop + b.stop};
}

Columns operator*(double c, const Columns& a) { return {c * a.v, c * a.u, c * a.slid, c * a.turned, c * a.stop}; }

}  // namespace

/// The motion of one track.
struct TrackModel::Motion {
  const Track& track;
  const VectorXd& parameters;
  std::size_t number;
  double radius, accuracy;
  double rate;  ///< f g
  ArrayXd t = track.t - track.start;

  double of(Parameter parameter) const { return fit::number(parameters, parameter, number); }
  double v0() const { return of(Parameter::slip); }
  double u0() const { return radius * of(Parameter::spin); }

  /// From another start: derivatives by T = f g t come with it.
  Columns columns(const reduction::Flow& flow, double v, double u, OrbitColumns* whole = nullptr) const {
    const ArrayXd at = rate * t;
    const ScaledOrbit orbit(flow, {.u = u, .v = v}, at.size() > 0 ? at[at.size() - 1] : 0, accuracy);
    OrbitColumns now = orbit(at);
    Columns result{now.v, now.u, now.slid / rate, now.turned / rate, orbit.stop() / rate};
    if (whole != nullptr) *whole = std::move(now);
    return result;
  }

  /// What the orbit, with the slip v0 at the start, makes of a series with that direction of the slip: linear in both, so
  /// also what changes of them do.
  ArrayXd of_orbit(Observable observable, const Columns& by, double v0_by, double direction) const {
    const double cosine = std::cos(direction), sine = std::sin(direction);
    switch (observable) {
      case Observable::slip:
        return by.v;
      case Observable::spin:
        return by.u / radius;
      case Observable::x:
        return velocity_for_slip * cosine * (by.slid - v0_by * t);
      case Observable::y:
        return velocity_for_slip * sine * (by.slid - v0_by * t);
      case Observable::vx:
        return velocity_for_slip * cosine * (by.v - v0_by);
      case Observable::vy:
        return velocity_for_slip * sine * (by.v - v0_by);
      case Observable::angle:
        break;
    }
    return by.turned / radius;
  }
  ArrayXd of_orbit(Observable observable, const Columns& by, double v0_by) const {
    return of_orbit(observable, by, v0_by, of(Parameter::direction));
  }

  /// A series, from the columns of the orbit.
  ArrayXd value(Observable observable, const Columns& now) const {
    ArrayXd result = of_orbit(observable, now, v0());
    if (observable == Observable::x) result += of(Parameter::x) + of(Parameter::vx) * t;
    if (observable == Observable::y) result += of(Parameter::y) + of(Parameter::vy) * t;
    if (observable == Observable::vx) result += of(Parameter::vx);
    if (observable == Observable::vy) result += of(Parameter::vy);
    if (observable == Observable::angle) result += of(Parameter::angle);
    return result;
  }

  /// The derivative of a series by a number that only places the track.
  ArrayXd placing(Observable observable, Parameter parameter, const Columns& now) const {
    using enum Observable;
    const bool turns = observable != slip && observable != spin && observable != angle;
    if (parameter == Parameter::direction && turns)
      return of_orbit(observable, now, v0(), of(Parameter::direction) + std::numbers::pi / 2);
    if ((parameter == Parameter::vx && observable == x) || (parameter == Parameter::vy && observable == y)) return t;
    const bool itself =
        (parameter == Parameter::x && observable == x) || (parameter == Parameter::y && observable == y) ||
        (parameter == Parameter::vx && observable == vx) || (parameter == Parameter::vy && observable == vy) ||
        (parameter == Parameter::angle && observable == angle);
    return ArrayXd::Constant(t.size(), itself ? 1 : 0);
  }
};

TrackModel::TrackModel(const si::Experiment& ball, const reduction::Law& law, const std::vector<Track>& tracks,
                       double accuracy)
    : radius_(ball.ball.radius), gravity_(ball.environment.gravity), accuracy_(accuracy), law_(law), tracks_(tracks) {
  for (const Track& track : tracks) {
    rows_ += track.t.size() * static_cast<Index>(track.series.size()) + (track.stop_time ? 1 : 0);
  }
}

VectorXd TrackModel::limited(VectorXd parameters) const {
  parameters[0] = std::clamp(parameters[0], min_ln_friction, max_ln_friction);
  parameters[1] = std::clamp(parameters[1], min_ln_ratio + std::log(radius_), std::log(radius_));
  return parameters;
}

reduction::Flow TrackModel::solved_flow(double ln_patch_radius) const {
  return reduction::Flow({law_, std::exp(ln_patch_radius) / radius_});
}

const reduction::Flow& TrackModel::flow(double ln_patch_radius) const {
  if (!last_ || last_->first != ln_patch_radius) last_.emplace(ln_patch_radius, solved_flow(ln_patch_radius));
  return last_->second;
}

VectorXd TrackModel::values(const VectorXd& free) const {
  const VectorXd parameters = limited(free);
  const reduction::Flow& solved = flow(parameters[1]);
  VectorXd result(rows_);
  Index row = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Motion motion{tracks_[i], parameters, i, radius_, accuracy_, std::exp(parameters[0]) * gravity_};
    const Columns now = motion.columns(solved, motion.v0(), motion.u0());
    for (const Series& series : tracks_[i].series) {
      result.segment(row, motion.t.size()) = motion.value(series.observable, now).matrix();
      row += motion.t.size();
    }
    if (tracks_[i].stop_time) result[row++] = now.stop;
  }
  return result;
}

Eigen::MatrixXd TrackModel::derivatives(const VectorXd& free, const std::vector<Index>& wanted) const {
  const VectorXd parameters = limited(free);
  const reduction::Flow& solved = flow(parameters[1]);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows_, static_cast<Index>(wanted.size()));
  const auto is_wanted = [&](Index place) { return std::ranges::find(wanted, place) != wanted.end(); };
  std::optional<reduction::Flow> more, less;
  if (is_wanted(place(Parameter::patch_radius))) {
    more = solved_flow(parameters[1] + ratio_step);
    less = solved_flow(parameters[1] - ratio_step);
  }
  Index first_row = 0;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    const Motion motion{track, parameters, i, radius_, accuracy_, std::exp(parameters[0]) * gravity_};
    const double v0 = motion.v0(), u0 = motion.u0(), size = std::hypot(v0, u0);
    OrbitColumns orbit;
    const Columns now = motion.columns(solved, v0, u0, &orbit);
    const ArrayXd T = motion.rate * motion.t;
    // Friction stretches time alone.
    const Columns by_friction{T * orbit.dv, T * orbit.du, motion.t * now.v - now.slid, motion.t * now.u - now.turned,
                              -now.stop};
    // The motion from c (u, v) is c times that from (u, v), c times slower.
    const Columns by_size{now.v - T * orbit.dv, now.u - T * orbit.du, 2 * now.slid - motion.t * now.v,
                          2 * now.turned - motion.t * now.u, now.stop};
    Columns by_patch, by_angle;
    if (more) by_patch = 0.5 / ratio_step * (motion.columns(*more, v0, u0) - motion.columns(*less, v0, u0));
    if (is_wanted(place(Parameter::slip, i)) || is_wanted(place(Parameter::spin, i))) {
      const double cosine = std::cos(angle_step), sine = std::sin(angle_step);
      const auto turned = [&](double sign) {
        return motion.columns(solved, cosine * v0 - sign * sine * u0, cosine * u0 + sign * sine * v0);
      };
      by_angle = 0.5 / angle_step * (turned(1) - turned(-1));
    }
    const auto by_start = [&](double by_v, double by_u) {
      const double along = (by_v * v0 + by_u * u0) / (size * size), across = (by_u * v0 - by_v * u0) / (size * size);
      return along * by_size + across * by_angle;
    };
    for (std::size_t column = 0; column < wanted.size(); ++column) {
      const Index at = wanted[column];
      const bool shared = at < shared_parameters;
      if (!shared && static_cast<std::size_t>((at - shared_parameters) / start_parameters) != i) continue;
      // Beyond a limit the parameter changes nothing.
      if (parameters[at] != free[at]) continue;
      const auto parameter =
          static_cast<Parameter>(shared ? at : shared_parameters + (at - shared_parameters) % start_parameters);
      Columns by;
      double v0_by = 0;
      bool is_of_orbit = true;
      switch (parameter) {
        case Parameter::friction:
          by = by_friction;
          break;
        case Parameter::patch_radius:
          by = by_patch;
          break;
        case Parameter::slip:
          by = by_start(1, 0);
          v0_by = 1;
          break;
        case Parameter::spin:
          by = by_start(0, radius_);
          break;
        default:
          is_of_orbit = false;
      }
      Index row = first_row;
      for (const Series& series : track.series) {
        result.col(static_cast<Index>(column)).segment(row, T.size()) =
            is_of_orbit ? motion.of_orbit(series.observable, by, v0_by).matrix()
                        : motion.placing(series.observable, parameter, now).matrix();
        row += T.size();
      }
      if (track.stop_time && is_of_orbit) result(row, static_cast<Index>(column)) = by.stop;
    }
    first_row += T.size() * static_cast<Index>(track.series.size()) + (track.stop_time ? 1 : 0);
  }
  return result;
}

}  // namespace contensou::fit
