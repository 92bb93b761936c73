#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contensou/fit/fit.hpp"
#include "fit/track_model.hpp"

namespace contensou::fit {

/// Beyond this many standard deviations Huber's loss is linear. For normal errors the fit is then 95 % efficient.
inline constexpr double huber_bend = 1.345;
/// Largest number of instants of a film that the first fit uses.
inline constexpr Eigen::Index max_of_first_solution = 5000;

/// A number held in a fit of all others: ln(f^a eps^b) of friction f and patch radius eps, or a number of a start.
struct Coordinate {
  Eigen::Vector2d powers = Eigen::Vector2d::Zero();  ///< the exponents a and b
  Eigen::Index place = -1;                           ///< place of a number of a start among the parameters; else -1

  bool of_contact() const { return place < contact_parameters; }

  double of(const Eigen::VectorXd& parameters) const {
    return of_contact() ? powers.dot(parameters.head<2>()) : parameters[place];
  }

  /// Returns the nearest parameters for which the number has the value `to`.
  Eigen::VectorXd moved(Eigen::VectorXd parameters, double to) const {
    if (of_contact()) {
      parameters.head<2>() += (to - of(parameters)) / powers.squaredNorm() * powers;
    } else {
      parameters[place] = to;
    }
    return parameters;
  }
};

/// Relative accuracy of orbits in a quick search. No film is more accurate.
inline constexpr double accuracy_of_guess = 1e-6;

/// Returns the series of an observable; nullptr if the track has none.
template <class AnyTrack>
auto series_of(AnyTrack& track, Observable observable) -> decltype(track.series.data()) {
  const auto found = std::ranges::find(track.series, observable, &Series::observable);
  return found == track.series.end() ? nullptr : &*found;
}

/// Returns the place of the observable for the other axis: y for x and so on; the same place if there are no axes.
std::size_t other_axis(std::size_t place);

/// Returns the median; for an even number of values the larger one of the two in the middle.
/// @param values  at least one
double median(std::vector<double> values);

/// Returns the standard deviation of normal errors whose absolute values have the same median as the given sizes.
double sd_by_median(std::vector<double> sizes);

/// The weighted residuals of all tracks, and the free parameters.
class Search {
 public:
  /// @param asked     request with checked tracks; kept by reference
  /// @param accuracy  as for TrackModel
  explicit Search(const FitRequest& asked, double accuracy = FilmOrbit::standard_accuracy);

  const FitRequest& request;
  const bool resisted;  ///< true if there is rolling friction
  TrackModel model;
  Eigen::VectorXd data;                  ///< measured values in the rows of the model; 0 for a missing value
  Eigen::VectorXd weight;                ///< 1/sd for each row; 0 for a missing value
  std::vector<Eigen::Index> rows_of[7];  ///< for each observable the rows with measured values
  bool estimated[7] = {};                ///< true if the sd of the observable is unknown and estimated
  std::vector<Eigen::Index> free;        ///< places of the free parameters
  Eigen::Index values = 0;               ///< number of measured values
  std::vector<Eigen::VectorXd> guesses;  ///< starts for solve(), the best first

  double rounding[7] = {};  ///< step to which values with unknown sd are rounded; tiny if there is none

  bool any_estimated() const;

  /// Returns residuals divided by standard deviations.
  Eigen::VectorXd residuals(const Eigen::VectorXd& parameters) const;

  /// Returns the sum of squares of residuals(), or twice Huber's loss in a robust fit.
  double cost(const Eigen::VectorXd& parameters) const;

  /// Returns the derivative of cost() along a direction.
  double slope(const Eigen::VectorXd& parameters, const Eigen::VectorXd& direction) const;

  /// Returns the free parameters that lie at a limit beyond which the sum of squares would be lower.
  std::vector<Eigen::Index> pushed_out(const Eigen::VectorXd& parameters) const;

  /// Returns the parameters with the best velocity, position and angle of the body. The model is linear in
  /// these numbers, so one linear least-squares solution finds them.
  Eigen::VectorXd carried(Eigen::VectorXd parameters) const;

  /// Improves the free parameters by Levenberg and Marquardt's method, between their limits.
  /// @param held       number that keeps its value; null if there is none
  /// @param tolerance  relative tolerance of the sum of squares
  /// @throws std::runtime_error  if the method does not converge
  Eigen::VectorXd improved(Eigen::VectorXd parameters, const Coordinate* held = nullptr,
                           double tolerance = 1e-11) const;

  /// Sets the unknown standard deviations to the standard deviations of the residuals.
  /// @return  largest relative change of a standard deviation
  double estimate_noise(const Eigen::VectorXd& parameters);

  /// Returns the parameters that belong to the given ball and, for each track, to the ball's start.
  Eigen::VectorXd given() const;

  /// Finds the estimate and sets the unknown standard deviations.
  Eigen::VectorXd solve();

  /// Finds the estimate next to the given parameters and sets the unknown standard deviations.
  Eigen::VectorXd settled(Eigen::VectorXd parameters);

  /// Returns Akaike's criterion, up to a constant.
  double criterion(const Eigen::VectorXd& parameters) const;

 private:
  /// Fills data, weight and rows_of from the tracks.
  void read_data();
  /// Sets the unknown standard deviations from the distance of each value to the line through its neighbours.
  void begin_noise();
  /// Fills `free` from the request.
  void choose_free();

  /// Sets the standard deviation of one observable; it is at least a tiny share of the observable's largest value.
  /// @return  relative change of the standard deviation
  double set_sd(std::size_t place, double sd);

  /// For an observable that shows no noise: the place of the other axis, whose standard deviation is used instead.
  std::optional<std::size_t> sharp_as[7] = {};
  void follow_other_axes();

  /// Returns the tracks. Series without given standard deviations contain the estimated ones.
  std::vector<Track> with_noise(std::vector<Track> tracks) const;

  /// Returns the best of several estimates. The starts of their searches are guessed from the data.
  Eigen::VectorXd improved_from_guesses();

  /// A possible start of a track, as values of Parameter.
  struct Begun {
    double slip, spin, rolling;
  };
  /// @param given  result of given()
  std::vector<Begun> starts_of(const Track& track, const Eigen::VectorXd& given) const;

  /// Fits the parameters that place a single track on the plane, by linear least squares.
  Eigen::VectorXd placed(Eigen::VectorXd parameters) const;
};

/// Returns the tracks with every k-th instant, k so large that no track has more than `most` instants.
std::vector<Track> thinned(const std::vector<Track>& tracks, Eigen::Index most);

}  // namespace contensou::fit
