#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/fit/fit.hpp"
#include "fit/track_model.hpp"

namespace contensou::fit {

/// From this many standard deviations on, Huber's loss is linear: 95 % efficient on normal errors.
inline constexpr double huber_bend = 1.345;
/// Of a longer film, a first solution is that of so many instants.
inline constexpr Eigen::Index max_of_first_solution = 5000;

/// What is held while all else is fitted anew: f^a eps^b, by its logarithm, or a number of a start.
struct Coordinate {
  Eigen::Vector2d powers = Eigen::Vector2d::Zero();  ///< a and b
  Eigen::Index place = -1;                           ///< of a number of a start

  bool of_contact() const { return place < contact_parameters; }

  double of(const Eigen::VectorXd& parameters) const {
    return of_contact() ? powers.dot(parameters.head<2>()) : parameters[place];
  }

  /// The nearest parameters where it has that value.
  Eigen::VectorXd moved(Eigen::VectorXd parameters, double to) const {
    if (of_contact()) {
      parameters.head<2>() += (to - of(parameters)) / powers.squaredNorm() * powers;
    } else {
      parameters[place] = to;
    }
    return parameters;
  }
};

/// Orbits as sharp as any film.
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
  const bool resisted;  ///< by rolling friction
  TrackModel model;
  Eigen::VectorXd data;                  ///< row by row of the model; 0 where none was measured
  Eigen::VectorXd weight;                ///< 1/sd; 0 where none was measured
  std::vector<Eigen::Index> rows_of[7];  ///< the measured rows of each observable
  bool estimated[7] = {};                ///< whether its sd is not known
  std::vector<Eigen::Index> free;        ///< places of parameters
  Eigen::Index values = 0;               ///< measured ones
  std::vector<Eigen::VectorXd> guesses;  ///< what solve() has begun from, the best first

  double rounding[7] = {};  ///< the step that values whose sd is not known are rounded to; tiny where they are not

  bool any_estimated() const;

  /// Residuals over standard deviations.
  Eigen::VectorXd residuals(const Eigen::VectorXd& parameters) const;

  /// Sum of squares of these, or twice Huber's loss.
  double cost(const Eigen::VectorXd& parameters) const;

  /// The derivative of cost() along a direction.
  double slope(const Eigen::VectorXd& parameters, const Eigen::VectorXd& direction) const;

  /// The free parameters at a limit beyond which the sum of squares would be lower.
  std::vector<Eigen::Index> pushed_out(const Eigen::VectorXd& parameters) const;

  /// The same with the velocity and the place of the body, in which what a film shows is linear, where they fit best.
  Eigen::VectorXd carried(Eigen::VectorXd parameters) const;

  /// Improves the free parameters by Levenberg and Marquardt's method, between their limits.
  /// @param held       what stays as it is
  /// @param tolerance  of the sum of squares, relative
  /// @throws std::runtime_error  if they do not converge
  Eigen::VectorXd improved(Eigen::VectorXd parameters, const Coordinate* held = nullptr,
                           double tolerance = 1e-11) const;

  /// Sets the standard deviations that are not known to those of the residuals.
  /// @return  by how much the largest change of one was, relative
  double estimate_noise(const Eigen::VectorXd& parameters);

  /// Parameters of the ball as it is asked for, and of its start in each track.
  Eigen::VectorXd given() const;

  /// The estimate, with standard deviations that are not known.
  Eigen::VectorXd solve();

  /// The estimate next to these parameters, with standard deviations that are not known.
  Eigen::VectorXd settled(Eigen::VectorXd parameters);

  /// Akaike's criterion, but for a constant.
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

  /// Where a column shows no noise, what its other axis has.
  std::optional<std::size_t> sharp_as[7] = {};
  void follow_other_axes();

  /// The tracks with standard deviations where they have none.
  std::vector<Track> with_noise(std::vector<Track> tracks) const;

  /// The best estimate from several starts, which the data tell.
  Eigen::VectorXd improved_from_guesses();

  /// What the track may have begun with.
  struct Begun {
    double slip, spin, rolling;
  };
  /// @param given  as given()
  std::vector<Begun> starts_of(const Track& track, const Eigen::VectorXd& given) const;

  /// Of one track: the parameters with those that place it on the plane, by linear least squares.
  Eigen::VectorXd placed(Eigen::VectorXd parameters) const;
};

/// Each k-th instant of tracks, so that no track has more than so many.
std::vector<Track> thinned(const std::vector<Track>& tracks, Eigen::Index most);

}  // namespace contensou::fit
