#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/orbit.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "system/balance.hpp"

namespace contensou::reduction {

/// The state of a stepper: logarithms of w = mu |u| and v, scaled time s and regularised time beta since the start.
struct LogState {
  double ln_w;
  double ln_v;
  double s;
  double beta;  ///< integral of ds/((16 w + 15 pi v)(8 w + 3 pi v))
};

/// The tail of a motion, in which either pivoting alone or sliding alone determines the friction. Letters as in
/// ReducedSystem, k = v/w. For k -> 0, w falls at the rate r Psi(0) in s, and v is a power of w by the linearised law.
/// For k -> infinity, v falls at the rate 1 - rho, and w is a power of v.
class AsymptoticTail {
 public:
  /// Returns the tail from this state on, with an error below 1e-17 of the time s; empty if there is no such tail.
  static std::optional<AsymptoticTail> at(const ReducedSystem& system, const LogState& state);

  /// Returns the scaled time from the start to the stop.
  double stop() const { return from_.s + left_; }

  /// Returns the state at a scaled time between `from` and stop().
  LogState at_time(double s) const { return at_fraction((stop() - s) / left_); }

  /// Returns the state at which the given fraction of the tail's time is left, 0 < fraction <= 1.
  LogState at_fraction(double fraction) const;

 private:
  AsymptoticTail(const ReducedSystem& system, const LogState& from, bool pivoting);

  LogState from_;
  double left_;
  double ln_v_slope_;  ///< d ln v/d ln (time left)
  double ln_w_slope_;
  double beta_scale_;  ///< beta since `from` is beta_scale_ (1/f - 1); f is the share left of the tail's time
};

/// The right sides of the equations of motion, theory.md (R1), times the larger of w and v, so that no divisor
/// vanishes. Only one division, by `larger`, remains:
///   -d ln w/ds = r of_spin/larger,   -d ln v/ds = of_slip/larger
struct Braking {
  double larger, of_spin, of_slip;
  double weight;  ///< dtau/dbeta of (2.8) at these speeds w and v
};

/// Returns the right sides at scaled speeds. If v/w is NaN, all numbers are NaN, and the stepper ends as not_finite.
inline Braking braking(const ReducedSystem& system, double ln_w, double ln_v) {
  const double w = std::exp(ln_w), v = std::exp(ln_v), k = std::exp(ln_v - ln_w);
  if (std::isnan(k)) return {k, k, k, k};
  const Balance balance = Balance::of(system.law(), system.r(), system.drive(), k);
  const double net = balance.force, moment = balance.moment, weight = regularising_weight(w, v);
  return k > 1 ? Braking{v, k * moment, net, weight} : Braking{w, moment, net / k, weight};
}

/// The common part of integrate_directly and integrate_regularised: units, the start in logarithms, the times that are
/// still to be reported, and the Motion, to which states are added. The class contains no equation of motion.
class MotionRecorder {
 public:
  /// @param caller  function name for error messages
  /// @throws std::domain_error  if start is not a state, or times are negative, not finite or decreasing
  MotionRecorder(const char* caller, const ReducedSystem& system, State start, const Eigen::ArrayXd& times);

  /// Returns the start in the recorder's unit of speed; the logarithm of a speed 0 is -infinity. If the state at time 0
  /// was requested, it is already reported.
  const LogState& start() const { return start_; }

  /// Returns an upper bound of the scaled stop time. Errors of the scaled time are relative to this bound.
  double time_scale() const { return time_scale_; }

  /// Returns the next time to report, in scaled time; infinity if there is none.
  double next_time() const;

  /// Returns true if every accepted step is reported, because no times were requested.
  bool every_step() const { return every_step_; }

  void add(const LogState& state);

  /// Reports the requested times in the tail and the stop, and returns the motion.
  Motion finish(const AsymptoticTail& tail, long steps, long evaluations);

  /// Returns the motion of a body that is at rest from the start.
  Motion finish_at_rest();

  /// Returns the states reported so far, with the reason of the failure.
  Motion fail(Outcome::Kind kind, long steps, long evaluations);

 private:
  Motion close(double stop_time, long steps, long evaluations, Outcome outcome);

  const char* caller_;
  double scaled_time_rate_;
  double mu_;
  State given_;
  int exponent_ = 0;
  LogState start_{};
  double time_scale_ = 0;
  bool every_step_;
  std::vector<double> times_;
  std::vector<OrbitPoint> points_;
};

}  // namespace contensou::reduction
