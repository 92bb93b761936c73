#pragma once

#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/motion.hpp"

namespace contensou::si {

/// The textbook's ball, whose sliding and pivoting do not know of each other: the slip falls at chi f g, the spin at
/// its rate without sliding. It ends in the same rolling as BallMotion, but elsewhere and at another time.
class UncoupledMotion {
 public:
  /// @param law  gives Psi(0), the moment of pure pivoting
  /// @throws std::domain_error  as require_experiment
  UncoupledMotion(const Experiment& experiment, const reduction::Law& law);

  /// s until the slip has fallen to that speed in m/s, >= 0; 0 for a ball that starts no faster. To 0: v0/(chi f g).
  double slip_time(double speed) const;

  /// s until the spin has ended: R |omega_z|/(gamma mu Psi(0) f g).
  double spin_end() const { return spin_end_; }

  /// m that the contact point slides on the ball.
  double slip_length() const { return slip_at_start(experiment_) * slip_end_ / 2; }

  /// rad that the ball turns about the vertical.
  double spin_angle() const { return spin_at_start(experiment_) * spin_end_ / 2; }

  /// m along the path of the centre until that time in s, at most slip_time(0), to 1e-9.
  double path_length(double t) const;

  /// @param t  s, >= 0
  /// @throws std::domain_error  if t is negative or not a number
  MotionPoint at_time(double t) const;

  /// at_time for each entry, in the order given.
  MotionColumns at_times(const Eigen::ArrayXd& times) const;

 private:
  Experiment experiment_;
  double slip_end_;
  double spin_end_;
};

}  // namespace contensou::si
