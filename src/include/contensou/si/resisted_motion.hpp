#pragma once

#include <memory>
#include <optional>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/si/motion.hpp"

namespace contensou::si {

/// m/s: a ball that no longer turns about a horizontal axis and slides no faster rests. While it spins the last of its
/// sliding lasts as long, and takes it less than a tenth of a millimetre.
inline constexpr double resting_slip = 1e-4;

/// The whole motion of a ball with rolling resistance: a torque chi J u_r g/R, (7/5) u_r m g R of a homogeneous ball,
/// against its turning about a horizontal axis, under which it rolls without slip at u_r g slower each second. It acts
/// while the ball slides, too; a ball that does not turn it holds, up to that torque.
///
/// A ball that rolls the way it slides is found without time steps, as a reduced motion with the drive u_r/f
/// (reduction/README.md, (R53)): until slip and spin end, after which it rolls to its rest; or until it no longer turns,
/// and slides on like a puck. Any other is integrated: the five equations (2.5) with that torque, by Cash-Karp 5(4).
///
/// A value that never changes. Copies share the solution.
class ResistedMotion {
 public:
  /// @param rolling_friction  u_r, > 0
  /// @param in_steps          to integrate it in any case
  /// @throws std::domain_error   as require_experiment, for a body that lies flat, and unless u_r is positive and finite
  /// @throws std::runtime_error  if the integration does not reach the stop
  ResistedMotion(const Experiment& experiment, const reduction::Law& law, double rolling_friction,
                 bool in_steps = false);

  /// Whether it was found without time steps.
  bool is_reduced() const;

  /// v/(eps |omega_z|) at which it creeps while it spins, if there is such a ratio and it spins.
  std::optional<double> creep_ratio() const;

  /// @param t  s, >= 0
  /// @throws std::domain_error  if t is negative or not a number
  MotionPoint at_time(double t) const;

  /// s until it neither slides nor spins, and until it spins no more.
  double stop_time() const;
  double spin_end() const;

  /// s from which on the slip is no faster than that many m/s.
  double slip_time(double speed) const;

  /// s until its centre rests, and where that is, in m.
  double rest_time() const;
  Eigen::Vector2d rest_position() const;

  /// m that the contact point slides, rad about the vertical, J that rolling resistance takes, all in all.
  double slip_length() const;
  double spin_angle() const;
  double rolling_loss() const;

  /// m along the path of the centre until that time in s.
  double path_length(double t) const;

  class Course;

 private:
  std::shared_ptr<const Course> course_;
};

}  // namespace contensou::si
