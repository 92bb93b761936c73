#pragma once

#include <vector>

#include "motion/asymptotic_tail.hpp"
#include "contensou/reduction/detail/stepped_motion.hpp"

namespace contensou::reduction {

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
