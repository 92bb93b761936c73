#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contensou/fit/fit.hpp"
#include "fit/film_orbit.hpp"

namespace contensou::fit {

/// The motion of tracks under a law as a function of parameters, and its derivatives by the parameters.
///
/// A vector of parameters: ln f, ln eps, u_r, and for each track the numbers of its start in the order of Parameter. A
/// negative slip is a slip in the opposite direction. Under rolling friction u_r the slip is >= 0.
class TrackModel {
 public:
  /// @param tracks    checked; they are kept by reference
  /// @param accuracy  accuracy of orbits, as for FilmOrbit
  /// @param resisted  true if there is rolling friction
  TrackModel(const si::Experiment& ball, const reduction::Law& law, const std::vector<Track>& tracks, double accuracy,
             bool resisted = false);

  Eigen::Index parameters() const {
    return shared_parameters + start_parameters * static_cast<Eigen::Index>(tracks_.size());
  }

  /// Returns the number of values: one for each value of each series, and one for each stop time.
  Eigen::Index rows() const { return rows_; }

  static Eigen::Index place(Parameter parameter, std::size_t track = 0) {
    const int number = static_cast<int>(parameter);
    return number < shared_parameters ? number : number + start_parameters * static_cast<Eigen::Index>(track);
  }

  static Parameter parameter_at(Eigen::Index place) {
    return static_cast<Parameter>(
        place < shared_parameters ? place : shared_parameters + (place - shared_parameters) % start_parameters);
  }

  /// Returns the track to which a number of a start belongs.
  /// @param place  place of the number in the parameters, >= shared_parameters
  static std::size_t track_of(Eigen::Index place) {
    return static_cast<std::size_t>((place - shared_parameters) / start_parameters);
  }

  /// Returns the values of the model row by row: the series of the first track, its stop time, then the next track.
  Eigen::VectorXd values(const Eigen::VectorXd& free) const;

  /// Returns the derivatives of the values by the wanted parameters, one column for each.
  Eigen::MatrixXd derivatives(const Eigen::VectorXd& free, const std::vector<Eigen::Index>& wanted) const;

  /// Returns the changes of the values if the friction of a track varies along its path, f (1 + c cos(pi j s)): the
  /// derivatives by c, for each track one column for each j from 1 to `modes`. The part s of the path that is behind
  /// the body is measured on the rim of the patch: ds ~ (v + eps |omega|) dt.
  Eigen::MatrixXd by_uneven_friction(const Eigen::VectorXd& free, Eigen::Index modes) const;

  /// Limits of a parameter. eps is at most R, and so small that a ball has no invariant ray. Slip and R |spin| are at
  /// most max_speed.
  struct Range {
    double low, high;
  };
  Range range(Eigen::Index place) const;
  static constexpr double max_speed = 100;  ///< m/s

  /// Returns the parameters clamped to their limits.
  Eigen::VectorXd limited(Eigen::VectorXd parameters) const;

 private:
  /// Returns the orbit of track i up to its last instant. The orbit is kept for calls with the same numbers.
  const FilmOrbit& orbit_of(std::size_t i, const Eigen::VectorXd& parameters) const;

  FilmOrbit::Numbers orbit_numbers(std::size_t i, const Eigen::VectorXd& parameters) const;

  reduction::Inertia inertia_;
  Kind kind_;
  double radius_, gravity_, accuracy_, max_ln_patch_radius_;
  reduction::Law law_;
  const std::vector<Track>& tracks_;
  Eigen::Index rows_ = 0;
  struct Known {
    FilmOrbit::Numbers numbers;
    FilmOrbit orbit;
  };
  mutable std::vector<std::optional<Known>> orbits_;
};

}  // namespace contensou::fit
