#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contensou/fit/fit.hpp"
#include "fit/film_orbit.hpp"

namespace contensou::fit {

/// The motion of tracks under a law as a function of parameters, and its derivatives by them.
///
/// A vector of parameters has ln f, ln eps and u_r, then, for each track, the numbers of its start in the order of Parameter.
/// The slip may be negative: the same slip in the opposite direction. With rolling friction it is not.
class TrackModel {
 public:
  /// @param tracks    checked; they are kept by reference
  /// @param accuracy  of orbits, as FilmOrbit
  /// @param resisted  whether there is rolling friction
  TrackModel(const si::Experiment& ball, const reduction::Law& law, const std::vector<Track>& tracks, double accuracy,
             bool resisted = false);

  Eigen::Index parameters() const {
    return shared_parameters + start_parameters * static_cast<Eigen::Index>(tracks_.size());
  }

  /// One for each value of each series, and one for each stop time.
  Eigen::Index rows() const { return rows_; }

  static Eigen::Index place(Parameter parameter, std::size_t track = 0) {
    const int number = static_cast<int>(parameter);
    return number < shared_parameters ? number : number + start_parameters * static_cast<Eigen::Index>(track);
  }

  static Parameter parameter_at(Eigen::Index place) {
    return static_cast<Parameter>(
        place < shared_parameters ? place : shared_parameters + (place - shared_parameters) % start_parameters);
  }

  /// Of a place of a start.
  static std::size_t track_of(Eigen::Index place) {
    return static_cast<std::size_t>((place - shared_parameters) / start_parameters);
  }

  /// What the motion gives, row by row: the series of the first track, its stop time, then the next.
  Eigen::VectorXd values(const Eigen::VectorXd& free) const;

  /// Derivatives of the values by these of the parameters, a column each: by scaling and by the orbit's.
  Eigen::MatrixXd derivatives(const Eigen::VectorXd& free, const std::vector<Eigen::Index>& wanted) const;

  /// What a parameter may be: eps <= R, of a ball without an invariant ray, slip and R spin up to max_speed.
  struct Range {
    double low, high;
  };
  Range range(Eigen::Index place) const;
  static constexpr double max_speed = 100;  ///< m/s

  /// The parameters within what they may be.
  Eigen::VectorXd limited(Eigen::VectorXd parameters) const;

 private:
  /// The orbit of track i, up to its last instant: the last one where only the friction has changed since.
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
