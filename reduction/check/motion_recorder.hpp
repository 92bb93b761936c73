#pragma once

#include <vector>

#include "check/asymptotic_tail.hpp"
#include "contensou/reduction/motion.hpp"

namespace contensou::reduction {

/// What both steppers say and in which unit: the start in logarithms, the instants still to be reported, the Motion
/// that grows. No equation of motion lives here.
class MotionRecorder {
 public:
  /// @param caller  named in error messages
  /// @throws std::domain_error  if start is not a state, or times are negative, not finite or decreasing
  MotionRecorder(const char* caller, const ReducedSystem& system, State start, const Eigen::ArrayXd& times);

  /// The start, speeds in the report's unit; -inf for a speed of 0. It is reported already where it was asked for.
  const LogState& start() const { return start_; }

  /// An upper estimate of the whole scaled time, the unit of its error.
  double time_scale() const { return time_scale_; }

  /// The next instant asked for, in scaled time; infinity when there is none.
  double next_time() const;

  /// True when accepted steps are to be reported, because no instants were asked for.
  bool every_step() const { return every_step_; }

  void add(const LogState& state);

  /// Reports what lies in the tail and the stop, and closes the motion.
  Motion finish(const AsymptoticTail& tail, long steps, long evaluations);

  /// The motion of a body that is at rest from the start.
  Motion finish_at_rest();

  /// Gives up; what was reported so far stays.
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
