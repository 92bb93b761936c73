#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/fit/fit.hpp"
#include "fit/scaled_orbit.hpp"
#include "fit/track_model.hpp"

namespace contensou::fit {

/// From this many standard deviations on, Huber's loss is linear: 95 % efficient on normal errors.
inline constexpr double huber_bend = 1.345;

/// The weighted residuals of tracks, and the parameters that are free in them.
class Search {
 public:
  /// @param asked     with checked tracks; kept by reference
  /// @param accuracy  as TrackModel
  explicit Search(const FitRequest& asked, double accuracy = ScaledOrbit::standard_accuracy);

  const FitRequest& request;
  TrackModel model;
  Eigen::VectorXd data;                  ///< row by row of the model; 0 where none was measured
  Eigen::VectorXd weight;                ///< 1/sd; 0 where none was measured
  std::vector<Eigen::Index> rows_of[7];  ///< the measured rows of each observable
  bool estimated[7] = {};                ///< whether its sd is not known
  std::vector<Eigen::Index> free;        ///< places of parameters
  Eigen::Index values = 0;               ///< measured ones

  bool any_estimated() const;

  /// Residuals over standard deviations.
  Eigen::VectorXd residuals(const Eigen::VectorXd& parameters) const;

  /// Sum of squares of these, or twice Huber's loss.
  double cost(const Eigen::VectorXd& parameters) const;

  /// Improves the free parameters by Levenberg and Marquardt's method.
  /// @param held       another one that is not free now
  /// @param tolerance  of the sum of squares, relative
  /// @throws std::runtime_error  if they do not converge
  Eigen::VectorXd improved(Eigen::VectorXd parameters, std::optional<Eigen::Index> held = {},
                           double tolerance = 1e-11) const;

  /// Sets the standard deviations that are not known to those of the residuals.
  /// @return  by how much the largest change of one was, relative
  double estimate_noise(const Eigen::VectorXd& parameters);

  /// Parameters of the ball as it is asked for, and of its start in each track.
  Eigen::VectorXd given() const;

  /// The estimate, with standard deviations that are not known.
  Eigen::VectorXd solve();

 private:
  /// The tracks with standard deviations where they have none.
  std::vector<Track> with_noise(std::vector<Track> tracks) const;

  /// The best estimate from several starts, which the data tell.
  Eigen::VectorXd improved_from_guesses() const;

  /// Slips and spins that the track may have begun with.
  /// @param given  as given()
  std::vector<std::pair<double, double>> starts_of(const Track& track, const Eigen::VectorXd& given) const;

  /// Of one track: the parameters with those that place it on the plane, by linear least squares.
  Eigen::VectorXd placed(Eigen::VectorXd parameters) const;
};

/// Each k-th instant of tracks, so that no track has more than so many.
std::vector<Track> thinned(const std::vector<Track>& tracks, Eigen::Index most);

}  // namespace contensou::fit
