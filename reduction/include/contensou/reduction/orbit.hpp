#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/orbit_point.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "contensou/reduction/similarity_solution.hpp"

namespace contensou::reduction {

class Flow;

/// The motion from one start to its stop (Flow::orbit): the system's similarity curve, scaled to pass through the
/// start. Times are by README (R4) and (R5), slip and angle by (R13), (R38) and (R50), beta by (R7).
///
/// There are no time steps: any instant is found by itself. Invariant axes (u0 = 0, v0 = 0), the invariant ray and rest
/// are ordinary starts.
///
/// Accuracy  u and ln v to 1e-12 relative at any fraction of the stop time for 1e-4 <= mu <= 1 (tests/reference), beta
///           to 1e-8, and to 1e-5 within 1e-3 of an invariant ray. Near the stop the conditioning is that of the
///           question: the speeds are proportional to stop_time() - tau, so ask at_time_left().
class Orbit {
 public:
  /// What is left of the speeds and of the time until the stop.
  struct Remaining {
    double u, v, ln_v;
    double tau_left;
  };

  /// An instant with what lies between the start and it, in speeds squared: where tau is turned into a time, a length
  /// and R times an angle.
  struct Instant {
    double u, v, ln_v;
    double slip_length;  ///< the integral of v dtau
    double turned;       ///< the integral of u dtau, of the sign of u
  };

  double stop_time() const;

  /// Relative error of stop_time().
  double accuracy() const;

  /// How often the law was called for the curve.
  long evaluations() const;

  /// The state tau after the start; past the stop, rest.
  /// @throws std::domain_error  if tau is negative or not a number
  OrbitPoint at_time(double tau) const;

  /// The state that has time_left until the stop; rest for 0.
  /// @throws std::domain_error  unless 0 <= time_left <= stop_time()
  OrbitPoint at_time_left(double time_left) const;

  /// The state at a nearness xi to the terminal ratio (SimilarityCurve), at most that of the start. Not on the axes.
  /// @throws std::domain_error  on an axis, or if xi is above the start's
  OrbitPoint at_coordinate(double xi) const;

  /// What is left there: the time to its last digits also next to the stop, where stop_time() less tau has none. Takes
  /// half the work of at_coordinate. Throws as at_coordinate.
  Remaining remaining_at_coordinate(double xi) const;

  /// The state at which ln k has the given value. Not on the axes.
  /// @throws std::domain_error  on an axis, or if ln_k is not between the start's and the terminal ratio's
  OrbitPoint at_log_ratio(double ln_k) const;

  /// The whole instant by one root: all but beta, which costs more than the rest. Past the stop, rest.
  /// @throws std::domain_error  as at_time
  Instant instant(double tau) const;

  /// slip_length of the instant: needs less of the curve.
  /// @throws std::domain_error  as at_time
  double slip_length(double tau) const;

  /// tau when the sliding speed has fallen to v, when |u| has to a value >= 0; 0 where it is never larger, and the stop
  /// time for 0. With a drive the sliding speed may grow before it falls: tau from which on it is no larger.
  /// @throws std::domain_error  if the speed is negative or not a number
  double time_of_v(double v) const;
  double time_of_u(double u) const;

  /// The integral of a function of v over [0, tau], tau not beyond the stop: without a root for each of its values.
  /// @param edges     values of v where the function is not smooth
  /// @throws std::domain_error  as at_time
  ///
  /// Accuracy  1e-10 of the integral of its absolute value.
  double integral(const std::function<double(double v)>& of_v, double tau, const std::vector<double>& edges = {}) const;

  /// Whether the start is on u = 0 or v = 0, where k does not change. With a drive it does on v = 0.
  bool on_axis() const { return u0_ == 0 || (v0_ == 0 && system_.drive() == 0); }

  /// ln k at the start; +inf for u0 = 0; for v0 = 0 -inf, or with a drive least_log_ratio.
  double start_log_ratio() const { return ln_k0_; }

  /// xi at the start, where it is not on an axis.
  double start_coordinate() const { return xi0_; }

  /// The curve that the motion is a scaled copy of. Not on the axes: there k does not change.
  /// @throws std::domain_error  on an axis
  const SimilarityCurve& curve() const;

  /// How k tends to its terminal ratio. Throws as curve().
  const TerminalChart& chart() const { return curve().chart(); }

  /// at_time for each entry, in the order given.
  OrbitColumns at_times(const Eigen::ArrayXd& times) const;

  /// Equidistant instants from the start to the stop, both included.
  /// @throws std::domain_error  for fewer than 2
  OrbitColumns sample(Eigen::Index count) const;

 private:
  friend class Flow;
  Orbit(const ReducedSystem& system, State start, const SimilaritySolution& solution);

  void require_coordinate(const char* function, double xi) const;
  OrbitPoint rest(double tau) const;
  OrbitPoint on_axis_at(double tau, double fraction_left) const;

  /// What is left of the speeds of the start: w and v as fractions, and their logarithms.
  struct Progress {
    double ln_w, ln_v;
    double w, v;
  };
  static constexpr Progress at_start{0, 0, 1, 1};
  double log_start() const;
  Progress fallen(double xi) const;               ///< the logarithms alone
  double sliding(const Progress& now) const;      ///< v
  double log_sliding(const Progress& now) const;  ///< ln v
  Progress progress(double xi) const;
  Progress progress(double xi, double left) const;
  double beta(double xi, const Progress& now) const;
  OrbitPoint point(double tau, double xi, const Progress& now) const;
  OrbitPoint point_with_left(double tau, double xi, double left) const;

  double whole() const { return pivoting_ + v_ * m0_; }  ///< the stop time, scaled
  double slip_left(double xi, const Progress& now) const;
  double turned_left(double xi, const Progress& now) const;
  double length_of(double scaled_square) const;
  double coordinate_of_fall(double Progress::*ln_speed, double ln_fraction, double from) const;
  double coordinate_of_fastest() const;  ///< where v is largest
  double time_of_fall(double Progress::*ln_speed, double speed, double start, double from) const;
  double scaled_elapsed(double xi, const Progress& now) const;
  double scaled_left(double xi, const Progress& now) const;
  double scaled_left_slope(double xi, const Progress& now) const;
  double left_at(double tau) const;
  double coordinate_at_time(double tau) const;
  double coordinate_at_elapsed(double elapsed) const;
  double coordinate_at_left(double left) const;
  double tau_of(double scaled) const;
  double scaled_of(double tau) const;

  /// A number that is not known before it is needed; threads that need it at once compute the same.
  struct OnDemand {
    OnDemand() = default;
    OnDemand(const OnDemand& other) : value(other.value.load()) {}
    OnDemand& operator=(const OnDemand& other) {
      value = other.value.load();
      return *this;
    }
    std::atomic<double> value = std::numeric_limits<double>::quiet_NaN();
  };

  ReducedSystem system_;
  SimilaritySolution::Curve curve_;  ///< null on the axes
  double u0_, v0_;
  bool creeps_ = false;  ///< begins so near v = 0 that a drive gives it v_ in no time
  int exponent_;         ///< speeds are divided by 2^exponent_ inside
  double w_, v_;         ///< mu |u0| and v0, scaled; where it begins to creep, v when it has begun
  double pivoting_;      ///< P, scaled
  double ln_k0_;
  double xi0_ = 0;
  mutable OnDemand ln_w0_;
  double m0_;             ///< m(k0)
  double pivoting_rate_;  ///< r Psi(0) = -dw/ds at k = 0
};

}  // namespace contensou::reduction
