#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/fit/fit.hpp"
#include "fit/track_model.hpp"

namespace contensou::fit {

/// Standard deviations from which Huber's loss is linear. With it the fit is 95 % efficient on normal errors.
inline constexpr double huber_bend = 1.345;
/// Largest number of instants in the first solution of a film.
inline constexpr Eigen::Index max_of_first_solution = 5000;

/// A number that is held while all others are fitted: the logarithm of f^a eps^b, or a number of a start.
struct Coordinate {
  Eigen::Vector2d powers = Eigen::Vector2d::Zero();  ///< a and b
  Eigen::Index place = -1;                           ///< place of the number of a start; -1 for f^a eps^b

  bool of_contact() const { return place < contact_parameters; }

  double of(const Eigen::VectorXd& parameters) const {
    return of_contact() ? powers.dot(parameters.head<2>()) : parameters[place];
  }

  /// Returns the nearest parameters at which the number has the value `to`.
  Eigen::VectorXd moved(Eigen::VectorXd parameters, double to) const {
    if (of_contact()) {
      parameters.head<2>() += (to - of(parameters)) / powers.squaredNorm() * powers;
    } else {
      parameters[place] = to;
    }
    return parameters;
  }
};

/// Relative accuracy of orbits in a quick search; no film is more accurate.
inline constexpr double accuracy_of_guess = 1e-6;

/// Returns the series of an observable; nullptr if the track has none.
template <class AnyTrack>
auto series_of(AnyTrack& track, Observable observable) -> decltype(track.series.data()) {
  const auto found = std::ranges::find(track.series, observable, &Series::observable);
  return found == track.series.end() ? nullptr : &*found;
}

/// The place of an observable's other axis: y for x and so on; of others it is their own.
std::size_t other_axis(std::size_t place);

/// Returns the median; the upper one of two in the middle.
/// @param values  at least one
double median(std::vector<double> values);

/// The standard deviation that normal errors of this median of their sizes have.
double sd_by_median(std::vector<double> sizes);

/// The weighted residuals of tracks, and the parameters that are free in them.
class Search {
 public:
  /// @param asked     with checked tracks; kept by reference
  /// @param accuracy  as TrackModel
  explicit Search(const FitRequest& asked, double accuracy = FilmOrbit::standard_accuracy);

  const FitRequest& request;
  const bool resisted;  ///< true if there is rolling friction
  TrackModel model;
  Eigen::VectorXd data;                  ///< row by row of the model; 0 where none was measured
  Eigen::VectorXd weight;                ///< 1/sd; 0 where none was measured
  std::vector<Eigen::Index> rows_of[7];  ///< the measured rows of each observable
  bool estimated[7] = {};                ///< true if the sd of the observable is unknown
  std::vector<Eigen::Index> free;        ///< places of parameters
  Eigen::Index values = 0;               ///< number of measured values
  std::vector<Eigen::VectorXd> guesses;  ///< starts of solve(), the best first

  double rounding[7] = {};  ///< step to which values with unknown sd are rounded; tiny if they are not rounded

  bool any_estimated() const;

  /// Residuals over standard deviations.
  Eigen::VectorXd residuals(const Eigen::VectorXd& parameters) const;

  /// Sum of squares of these, or twice Huber's loss.
  double cost(const Eigen::VectorXd& parameters) const;

  /// Returns the derivative of cost() along a direction.
  double slope(const Eigen::VectorXd& parameters, const Eigen::VectorXd& direction) const;

  /// Returns the free parameters at a limit beyond which the sum of squares would be lower.
  std::vector<Eigen::Index> pushed_out(const Eigen::VectorXd& parameters) const;

  /// Returns the parameters with the best velocity, place and angle of the body. The model is linear in these, so one
  /// linear least-squares solution finds them.
  Eigen::VectorXd carried(Eigen::VectorXd parameters) const;

  /// Improves the free parameters by Levenberg and Marquardt's method, between their limits.
  /// @param held       number that keeps its value; null: none
  /// @param tolerance  relative tolerance of the sum of squares
  /// @throws std::runtime_error  if they do not converge
  Eigen::VectorXd improved(Eigen::VectorXd parameters, const Coordinate* held = nullptr,
                           double tolerance = 1e-11) const;

  /// Sets the unknown standard deviations to those of the residuals.
  /// @return  largest relative change of a standard deviation
  double estimate_noise(const Eigen::VectorXd& parameters);

  /// Returns the parameters of the ball as given, and those of its start in each track.
  Eigen::VectorXd given() const;

  /// Returns the estimate; sets the unknown standard deviations.
  Eigen::VectorXd solve();

  /// Returns the estimate next to these parameters; sets the unknown standard deviations.
  Eigen::VectorXd settled(Eigen::VectorXd parameters);

  /// Akaike's criterion, up to a constant.
  double criterion(const Eigen::VectorXd& parameters) const;

 private:
  /// Fills data, weight and rows_of from the tracks.
  void read_data();
  /// Sets the unknown standard deviations from the distances of values from the line between their neighbours.
  void begin_noise();
  /// Fills `free`.
  void choose_free();

  /// Sets the standard deviation of one observable, or a tiny share of its largest value if that is larger.
  /// @return  the relative change
  double set_sd(std::size_t place, double sd);

  /// For an observable that shows no noise: the other axis, whose standard deviation it takes.
  std::optional<std::size_t> sharp_as[7] = {};
  void follow_other_axes();

  /// Returns the tracks with the estimated standard deviations where none are given.
  std::vector<Track> with_noise(std::vector<Track> tracks) const;

  /// Returns the best estimate from several starts of the search, which are guessed from the data.
  Eigen::VectorXd improved_from_guesses();

  /// A possible start of a track, in the units of Parameter.
  struct Begun {
    double slip, spin, rolling;
  };
  /// @param given  result of given()
  std::vector<Begun> starts_of(const Track& track, const Eigen::VectorXd& given) const;

  /// Fits the parameters that place a single track on the plane, by linear least squares.
  Eigen::VectorXd placed(Eigen::VectorXd parameters) const;
};

/// Returns tracks with each k-th instant, so that no track has more than `most` instants.
std::vector<Track> thinned(const std::vector<Track>& tracks, Eigen::Index most);

}  // namespace contensou::fit
