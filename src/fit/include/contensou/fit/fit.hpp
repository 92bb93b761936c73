#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "contensou/fit/track.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::fit {

/// The numbers that a motion may be asked for, those of the contact first, which all tracks share, then those of the
/// start of each track.
///
/// A ball with rolling friction rolls the way it slides, or does not roll at first: in place of vx and vy it has the speed
/// at which it rolls along the slip.
enum class Parameter { friction, patch_radius, rolling_friction, slip, spin, direction, vx, vy, x, y, angle, rolling };
inline constexpr int contact_parameters = 2;  ///< the first, which are searched by their logarithms
inline constexpr int shared_parameters = 3;
inline constexpr int start_parameters = 9;

/// What a parameter is called, its unit, and what it is.
struct ParameterKind {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
};
const ParameterKind& kind_of(Parameter parameter);

/// Which numbers the data decide; the others keep the ball's values. What only places a track on the plane (direction,
/// velocity, position and angle at the start) is always free where the data have it.
struct Free {
  bool friction = true;
  bool patch_radius = true;
  bool slip = true;
  bool spin = true;
  bool rolling_friction = false;
};

/// What is searched where nothing else is asked for: all, but for the patch of a body that rests on its whole face, and
/// rolling friction where the ball has none.
Free usually_free(const si::Experiment& ball);

/// What is fitted to which films.
struct FitRequest {
  si::Experiment ball;  ///< radius, gravity, and the values of what is not free
  reduction::Law law;
  std::vector<Track> tracks;
  Free free = {};
  bool robust = false;                     ///< Huber's loss: values far off count for less
  std::function<void()> each_search = {};  ///< called at each of the many searches for a least sum of squares
};

/// A range of a number.
struct Interval {
  double low;
  double high;
};

/// What the data say of one parameter.
struct Estimate {
  Parameter parameter;
  std::size_t track;      ///< of a number of a start: of which track
  double value;           ///< SI; any of many where the data do not decide it
  double standard_error;  ///< infinite where the data do not decide it; 0 where it is not free
  Interval interval;      ///< of 95 % confidence: an end that the data do not set is that of what the number can be
  bool free;

  bool determined() const { return std::isfinite(standard_error); }

  /// Whether one end of the interval is more than twice as far as the other: then no single error tells it.
  bool skewed() const {
    const double below = value - interval.low, above = interval.high - value;
    return std::max(below, above) > 2 * std::min(below, above);
  }
};

/// Where a value is that is far off.
struct Outlier {
  std::size_t track;
  double t;  ///< s
};

/// The noise of an observable.
struct Noise {
  Observable observable;
  Eigen::Index values;            ///< how many were measured
  double rms;                     ///< of the residuals, SI
  double sd;                      ///< that the weights have, of their root mean square
  bool estimated;                 ///< from the residuals
  std::vector<Outlier> outliers;  ///< farther off than six standard deviations, by the median of the residuals
};

/// The only combination f^a eps^b that the data decide: friction, patch radius, their product or their ratio.
struct Combination {
  double friction_power, patch_power;
  double value;           ///< SI
  double relative_error;  ///< standard error over value
  Interval interval;      ///< of 95 % confidence

  /// "the product friction patch_radius", "friction", ...
  std::string name() const;
  std::string unit() const;  ///< "m", "1/m" or none
};

/// How far whole turns of an angle may be mistaken.
struct Turns {
  /// The spin, rad/s, with which a mark turns by half a turn from picture to picture: beyond it, turns are found by trial.
  /// Infinite where no angle is seen, or the spin, too.
  double half_turn_spin = INFINITY;
  std::vector<double> other_spins = {};  ///< at the start, which explain the data as well
};

/// Another motion that explains the data as well: of a puck seen by x and y, say, one with less spin and less friction.
struct OtherMotion {
  std::size_t track;            ///< its start is what differs
  double friction, slip, spin;  ///< SI; the last two at the start of the track
  double chi2_more;             ///< difference of the sums of squares
};

/// Rolling friction that was not searched, and by which the data would be explained better by far: by one step from a fit
/// without it.
struct RollingFrictionSeen {
  double value, standard_error;
  double friction;   ///< what the coefficient of sliding friction would be then
  double chi2_less;  ///< by how much the sum of squares would be less
};

/// What a fit has found.
struct Fit {
  std::string law;
  si::Experiment ball;  ///< with the fitted contact and the start of the first track
  /// Friction, patch_radius, rolling_friction where the ball has it or it was searched, then slip, spin and the placing
  /// ones of each track.
  std::vector<Estimate> estimates;
  Eigen::MatrixXd correlation;  ///< of those that are free, in that order
  std::vector<Noise> noise;
  Eigen::Index values = 0;  ///< measured ones
  double chi2 = 0;
  double degrees_of_freedom = 0;
  double aic = 0;                                      ///< Akaike's criterion: the smaller, the better the law
  std::optional<Combination> only = {};                ///< where the data do not decide friction and patch radius each
  bool robust = false;                                 ///< whether by Huber's loss
  bool profiled = false;                               ///< whether the intervals are by profile likelihood
  std::vector<std::vector<Eigen::ArrayXd>> predicted;  ///< of each track, each series: what the fitted motion gives

  /// Why this is not the motion of the data, in words; empty where it may be.
  std::vector<std::string> misfits = {};
  std::vector<Turns> turns = {};                ///< of each track
  std::vector<OtherMotion> other_motions = {};  ///< minima apart from the estimate; the intervals contain them
  std::optional<RollingFrictionSeen> rolling_friction_seen = {};

  const Estimate& estimate(Parameter parameter, std::size_t track = 0) const;
  bool rolls_with_friction() const;  ///< whether rolling friction is among the estimates
  std::vector<const Estimate*> free_estimates() const;
  double correlation_of_contact() const;  ///< of friction and patch radius; 0 unless both are free
  /// Returns the spins at the start that explain the data as well, by other turns of an angle or by another motion.
  std::vector<double> other_spins(std::size_t track) const;
  bool fits() const { return misfits.empty(); }
  double reduced_chi2() const { return chi2 / degrees_of_freedom; }  ///< NaN or infinite without degrees of freedom
};

/// Weighted least squares: the motion that the data are most probably of, where their errors are independent and normal.
///
/// A start for the search is found from the data. Standard deviations that a series does not have are estimated from its
/// residuals. The model is the closed orbit, to 1e-9 of its speeds. Of a body that lies flat the velocity of the centre is
/// the slip: no velocity of its own is searched. A ball with rolling friction, its own or one that is searched, rolls
/// the way it slides, or does not roll at first.
///
/// @throws std::domain_error   on a slope; for rolling friction of a body that lies flat, or of a ball that begins to roll
///                             another way than it slides; for a track as checked, where fewer values than 10 have no standard deviations, or
///                             where nothing is free, or where a friction or patch radius that is not searched is
///                             beyond what the model allows: friction 1e-4 to 10, patch radius 8.3e-7 R to R, and of a
///                             ball none under which the law has an invariant ray
/// @throws std::runtime_error  if the search does not converge
Fit fit(const FitRequest& asked);

/// The same by several laws, the best by Akaike's criterion first.
std::vector<Fit> fit_laws(const FitRequest& request, const std::vector<reduction::Law>& laws);

/// What a film would give of the ball's own motion (Cramer and Rao's bound): the estimates with the errors that tracks
/// with these times and standard deviations have; their values are not read.
/// @throws std::domain_error  as fit, and for a series without standard deviations
Fit plan(const FitRequest& asked);

}  // namespace contensou::fit
