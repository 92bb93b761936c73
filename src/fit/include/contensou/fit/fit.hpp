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

/// The numbers that a fit can find. The first three describe the contact and are shared by all tracks; the others
/// belong to the start of each track. `rolling` is the rolling speed along the slip. It replaces vx and vy for a ball
/// with rolling friction, which must roll in the direction in which it slides, or not at all.
enum class Parameter { friction, patch_radius, rolling_friction, slip, spin, direction, vx, vy, x, y, angle, rolling };
inline constexpr int contact_parameters = 2;  ///< friction and patch_radius; the search uses their logarithms
inline constexpr int shared_parameters = 3;
inline constexpr int start_parameters = 9;

/// The name of a parameter, its unit and its meaning.
struct ParameterKind {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning;
};
const ParameterKind& kind_of(Parameter parameter);

/// The numbers that are to be found; all others have the ball's values. Numbers that only place a track on the plane
/// (direction, velocity, position and angle at the start) are always free if the data contain them.
struct Free {
  bool friction = true;
  bool patch_radius = true;
  bool slip = true;
  bool spin = true;
  bool rolling_friction = false;
  bool patch_if_seen = false;  ///< true: the patch radius of a flat body becomes free if the film determines it
};

/// Returns the numbers that are free by default: all, except rolling friction if the ball has none. The patch radius of
/// a body that rests on its whole face is free if the film determines a smaller patch.
Free usually_free(const si::Experiment& ball);

/// The films, the model and the free numbers of a fit.
struct FitRequest {
  si::Experiment ball;  ///< radius, gravity, and the values of numbers that are not free
  reduction::Law law;
  std::vector<Track> tracks;
  Free free = {};
  bool robust = false;                     ///< true: Huber's loss, under which outliers count less
  std::function<void()> each_search = {};  ///< called at the beginning of each of the many minimisations
};

/// A range of a number.
struct Interval {
  double low;
  double high;
};

/// The estimate of one parameter.
struct Estimate {
  Parameter parameter;
  std::size_t track;      ///< index of the track, for a number of a start
  double value;           ///< SI units; one of many values if the number is not determined
  double standard_error;  ///< infinite if the number is not determined; 0 if it is not free
  Interval interval;      ///< 95 % confidence; an end that the data do not determine is the limit of the number
  bool free;

  bool determined() const { return std::isfinite(standard_error); }

  /// Returns true if one end of the interval is more than twice as far from the value as the other end. Then a single
  /// standard error does not describe the interval.
  bool skewed() const {
    const double below = value - interval.low, above = interval.high - value;
    return std::max(below, above) > 2 * std::min(below, above);
  }
};

/// The place of an outlier.
struct Outlier {
  std::size_t track;
  double t;  ///< s
};

/// The noise of an observable.
struct Noise {
  Observable observable;
  Eigen::Index values;            ///< number of measured values
  double rms;                     ///< root mean square of the residuals, SI units
  double sd;                      ///< root mean square of the standard deviations that the weights imply
  bool estimated;                 ///< true if sd is estimated from the residuals
  std::vector<Outlier> outliers;  ///< values whose residual exceeds 6 standard deviations (from the median residual)
  /// Share of the values farther than 4 standard deviations from most values. Many outliers increase the standard
  /// deviation and shift the fit, and then none of them is farther than 6 standard deviations from the fit.
  double far_from_most = 0;
  double neighbours = 0;  ///< correlation of a residual with the next one; 0 if it may be due to chance

  /// Returns true if far_from_most is larger than normal errors make it by chance in one of a thousand films.
  bool hides_outliers() const { return far_from_most > 0.08; }
};

/// The only combination f^a eps^b that the data determine, f friction, eps patch radius: f, eps, f eps or f/eps.
struct Combination {
  double friction_power, patch_power;
  double value;           ///< SI units
  double relative_error;  ///< standard error divided by the value
  Interval interval;      ///< 95 % confidence

  /// Returns the name, such as "the product friction patch_radius" or "friction".
  std::string name() const;
  std::string unit() const;  ///< returns "m", "1/m" or an empty text
};

/// Possible errors of an angle by whole turns.
struct Turns {
  /// Spin, rad/s, at which a mark turns by half a turn between two pictures. At faster spins turns are found by trial.
  /// Infinite if the film shows no angle, or if it shows the spin.
  double half_turn_spin = INFINITY;
  std::vector<double> other_spins = {};  ///< spins at the start that fit the data equally well
};

/// Another motion that fits the data equally well, such as that of a puck with less spin and less friction.
struct OtherMotion {
  std::size_t track;            ///< the track whose start differs
  double friction, slip, spin;  ///< SI units; slip and spin are those at the start of the track
  double chi2_more;             ///< sum of squares of this motion minus that of the estimate
};

/// Rolling friction that is not free but would make the fit far better, estimated by one step from a fit without it.
struct RollingFrictionSeen {
  double value, standard_error;
  double friction;   ///< coefficient of sliding friction in the fit with this rolling friction
  double chi2_less;  ///< decrease of the sum of squares
};

/// Neighbouring residuals depend on each other, and the errors of all numbers are widened for this.
struct Widened {
  double friction_varies;  ///< standard deviation of the friction along the path, divided by the friction
  double least, most;      ///< smallest and largest factor of an error of friction, patch radius, slip or spin
};

/// A patch smaller than the face of a flat body that makes the fit far better.
struct PatchSeen {
  double radius;    ///< m
  double friction;  ///< coefficient of friction in the fit with this patch
  double aic_less;  ///< decrease of Akaike's criterion
};

/// The result of a fit.
struct Fit {
  std::string law;
  si::Experiment ball;  ///< ball with the fitted contact and the start of the first track
  /// Friction, patch_radius, and rolling_friction if the ball has it or it is free. Then, for each track, slip, spin
  /// and the numbers that place the track.
  std::vector<Estimate> estimates;
  Eigen::MatrixXd correlation;  ///< correlations of the free numbers, in the order of estimates
  std::vector<Noise> noise;
  Eigen::Index values = 0;  ///< number of measured values
  double chi2 = 0;
  double degrees_of_freedom = 0;
  double aic = 0;                        ///< Akaike's criterion; smaller for a better law
  std::optional<Combination> only = {};  ///< set if the data do not determine friction and patch radius separately
  bool robust = false;                   ///< true for Huber's loss
  bool profiled = false;                 ///< true if the intervals are by profile likelihood
  std::vector<std::vector<Eigen::ArrayXd>> predicted;  ///< values of the fitted motion for each track and series

  /// Reasons, in words, why the model does not describe the data; empty if there are none.
  std::vector<std::string> misfits = {};
  std::vector<Turns> turns = {};                ///< one for each track
  std::vector<OtherMotion> other_motions = {};  ///< minima other than the estimate; the intervals contain them
  std::optional<RollingFrictionSeen> rolling_friction_seen = {};
  std::optional<PatchSeen> patch_seen = {};  ///< set only if the whole face does not fit within the noise
  std::optional<Widened> widened = {};       ///< set if neighbouring residuals depend on each other

  const Estimate& estimate(Parameter parameter, std::size_t track = 0) const;
  bool rolls_with_friction() const;  ///< true if rolling friction is among the estimates
  std::vector<const Estimate*> free_estimates() const;
  double correlation_of_contact() const;  ///< correlation of friction and patch radius; 0 unless both are free
  /// Returns the spins at the start that fit the data equally well, by other turns of an angle or by another motion.
  std::vector<double> other_spins(std::size_t track) const;
  bool fits() const { return misfits.empty(); }
  double reduced_chi2() const { return chi2 / degrees_of_freedom; }  ///< NaN or infinite without degrees of freedom
};

/// Finds the motion of the highest likelihood for independent normal errors, by weighted least squares.
///
/// The starts of the search are guessed from the data. Unknown standard deviations of a series are estimated from its
/// residuals. The model is accurate to 1e-9 of the speeds. The velocity of a body that lies flat is its slip, so no
/// other velocity is free. A ball with rolling friction, given or free, must roll in the direction in which it slides,
/// or not roll at first.
///
/// @throws std::domain_error   on a slope; for rolling friction of a body that lies flat, or of a ball that first rolls
///                             in another direction than it slides; for a track that `require` rejects; if fewer than
///                             10 values have no standard deviation; if no number is free; if a fixed friction or patch
///                             radius is outside the model: friction 1e-4 to 10, patch radius 8.3e-7 R to R, for a ball
///                             also so small that the law has no invariant ray
/// @throws std::runtime_error  if the search does not converge
Fit fit(const FitRequest& asked);

/// Fits several laws. The result is sorted: the best law by Akaike's criterion comes first.
std::vector<Fit> fit_laws(const FitRequest& request, const std::vector<reduction::Law>& laws);

/// Returns the estimates that a film of the ball's own motion would give, with their errors by the bound of Cramer and
/// Rao. The tracks contain times and standard deviations; their values are not used.
/// @throws std::domain_error  as fit, and for a series without standard deviations
Fit plan(const FitRequest& asked);

}  // namespace contensou::fit
