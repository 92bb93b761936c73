#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/detail/similarity_solution.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The state of a motion at one time. At the stop u = v = 0, ln_v = -infinity, beta = infinity.
struct OrbitPoint {
  double tau;   ///< the time tau of ReducedSystem since the start
  double u;     ///< pivoting speed; keeps the sign of u0
  double v;     ///< sliding speed; 0 if it underflows, while ln_v stays finite
  double ln_v;  ///< natural logarithm of v in the unit of the start
  double k;     ///< v/(mu |u|), the ratio of sliding to pivoting; infinity for u = 0
  /// Time beta of the regularised equations (2.7) since the start. Its error is relative to beta + 1/(16 mu |u0| + 15
  /// pi v0).
  double beta;
};

/// The states of a motion at several times: one column for each quantity, one row for each time.
struct OrbitColumns {
  Eigen::ArrayXd tau, u, v, ln_v, k, beta;

  explicit OrbitColumns(Eigen::Index rows = 0);
  Eigen::Index rows() const { return tau.size(); }
  void set(Eigen::Index row, const OrbitPoint& point);
  OrbitPoint row(Eigen::Index row) const;
};

class Flow;

/// The motion from one start to its stop, made by Flow::orbit.
///
/// The motion is the similarity curve of the system, scaled to pass through the start. There are no time steps: the
/// state at a time follows from one root of the formula for the time, theory.md and numerics.md (R4), (R32). Slip
/// length and angle follow from (R30), (R31), (R26); the regularised time beta (ReducedSystem::regularising_weight)
/// from (R39). The axes (u0 = 0 or v0 = 0), invariant rays and rest are ordinary starts. Times and speeds have the unit
/// of the start's speeds; lengths have the unit of a speed squared.
///
/// Accuracy  u and ln v 1e-12 relative at any fraction of the stop time for 1e-4 <= mu <= 1 (tests/reference); beta
///           1e-8, and 1e-5 within 1e-3 of an invariant ray. Near the stop the speeds are proportional to the time
///           left, stop_time() - tau. This difference loses digits; at_time_left() avoids the difference and keeps the
///           digits.
///
/// @throws std::domain_error  functions of a time tau, if tau is negative or not a number
class Orbit {
 public:
  /// The speeds and the time left until the stop.
  struct Remaining {
    double u, v, ln_v;
    double tau_left;
  };

  /// The speeds at one time, and the integrals of the speeds from the start to this time. Divided by (3 pi/2) f g, tau
  /// is a time, slip_length is a length, and `turned` is R times an angle.
  struct Instant {
    double u, v, ln_v;
    double slip_length;  ///< the integral of v dtau
    double turned;       ///< the integral of u dtau; has the sign of u
  };

  /// Returns the time tau from the start until u = v = 0.
  double stop_time() const;

  /// Returns a bound of the relative error of stop_time().
  double accuracy() const;

  /// Returns the number of calls of the law that were needed to compute the curve.
  long evaluations() const;

  /// Returns the state at the time tau after the start; rest if tau is beyond the stop.
  OrbitPoint at_time(double tau) const;

  /// Returns the state at the time time_left before the stop; rest for time_left = 0.
  /// @throws std::domain_error  unless 0 <= time_left <= stop_time()
  OrbitPoint at_time_left(double time_left) const;

  /// Returns the state at a coordinate xi of the curve (TerminalChart); towards the stop xi falls to -infinity.
  /// @throws std::domain_error  on an axis, or if xi is larger than start_coordinate()
  OrbitPoint at_coordinate(double xi) const;

  /// Returns speeds and time left at a coordinate xi. Next to the stop, this time has more digits than the difference
  /// stop_time() - tau. The call costs half of at_coordinate. Throws as at_coordinate.
  Remaining remaining_at_coordinate(double xi) const;

  /// Returns the state at which ln k has the given value, k = v/(mu |u|).
  /// @throws std::domain_error  on an axis, or if ln_k is not between start_log_ratio() and ln k at the stop
  OrbitPoint at_log_ratio(double ln_k) const;

  /// Returns speeds, slip length and angle at the time tau, by one root. The call leaves out beta, the most costly part
  /// of at_time. Beyond the stop the speeds are 0.
  Instant instant(double tau) const;

  /// Returns the integral of v over the time from 0 to tau. It costs less than instant().
  double slip_length(double tau) const;

  /// Returns the time tau from which on the sliding speed is at most v; 0 if the speed never exceeds v. Under a drive
  /// the sliding speed can grow before it falls.
  /// @param v  speed, >= 0; for v = 0 the result is the stop time
  /// @throws std::domain_error  if v is negative or not a number
  double time_of_v(double v) const;
  /// Returns the time tau from which on |u| is at most u; 0 if |u| never exceeds u. Range, exceptions as time_of_v.
  double time_of_u(double u) const;

  /// Returns the integral of a function of v over the time from 0 to tau, or from 0 to the stop if the stop is earlier.
  /// @param edges  values of v at which the function is not smooth
  ///
  /// Accuracy  1e-10 of the integral of the function's absolute value.
  double integral(const std::function<double(double v)>& of_v, double tau, const std::vector<double>& edges = {}) const;

  /// Returns true if the start lies on an axis, u = 0 or v = 0, and k stays constant. Under a drive k changes on v = 0.
  bool on_axis() const { return u0_ == 0 || (v0_ == 0 && system_.drive() == 0); }

  /// Returns ln k at the start: +infinity for u0 = 0. For v0 = 0 it is -infinity, or under a drive least_log_ratio.
  double start_log_ratio() const { return ln_k0_; }

  /// Returns the coordinate xi of the start; the value has no meaning on an axis.
  double start_coordinate() const { return xi0_; }

  /// Returns the curve of which the motion is a scaled copy.
  /// @throws std::domain_error  on an axis
  const SimilarityCurve& curve() const;

  /// Returns the chart of curve(), which maps k to xi. Throws as curve().
  const TerminalChart& chart() const { return curve().chart(); }

  /// Returns at_time for each of the times, in the order given.
  OrbitColumns at_times(const Eigen::ArrayXd& times) const;

  /// Returns `count` equidistant states from the start to the stop, both included.
  /// @throws std::domain_error  for fewer than 2
  OrbitColumns sample(Eigen::Index count) const;

 private:
  friend class Flow;
  Orbit(const ReducedSystem& system, State start, const SimilaritySolution& solution);

  void require_coordinate(const char* function, double xi) const;
  OrbitPoint rest(double tau) const;
  OrbitPoint on_axis_at(double tau, double fraction_left) const;

  /// The speeds w = mu |u| and v, each divided by its value at the start, and the logarithms of these fractions.
  struct Progress {
    double ln_w, ln_v;
    double w, v;
  };
  static constexpr Progress at_start{0, 0, 1, 1};
  double log_start() const;
  Progress fallen(double xi) const;               ///< computes the logarithms, not w and v
  double sliding(const Progress& now) const;      ///< returns v
  double log_sliding(const Progress& now) const;  ///< returns ln v
  Progress progress(double xi) const;
  Progress progress(double xi, double left) const;
  double beta(double xi, const Progress& now) const;
  OrbitPoint point(double tau, double xi, const Progress& now) const;
  OrbitPoint point_with_left(double tau, double xi, double left) const;

  double whole() const { return pivoting_ + v_ * m0_; }  ///< the stop time in scaled units
  double slip_left(double xi, const Progress& now) const;
  double turned_left(double xi, const Progress& now) const;
  double length_of(double scaled_square) const;
  double coordinate_of_fall(double Progress::*ln_speed, double ln_fraction, double from) const;
  double coordinate_of_fastest() const;  ///< returns the xi at which v is largest
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

  /// A number that is computed at its first use. If several threads use it first at once, all compute the same value.
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
  bool creeps_ = false;  ///< true: the start is so near v = 0 that the drive raises the sliding speed to v_ immediately
  int exponent_;         ///< speeds are divided by 2^exponent_; then their products neither overflow nor underflow
  double w_, v_;         ///< mu |u0| and v0, both scaled; if creeps_, v_ is the speed after the immediate rise
  double pivoting_;      ///< P of theory.md (R5), the stop time of pure pivoting, scaled
  double ln_k0_;
  double xi0_ = 0;
  mutable OnDemand ln_w0_;
  double m0_;             ///< sliding coefficient m of theory.md (R5) at the start
  double pivoting_rate_;  ///< r Psi(0) = -dw/ds at k = 0
};

}  // namespace contensou::reduction
