#pragma once

#include "contensou/reduction/flow.hpp"
#include "contensou/si/motion.hpp"

namespace contensou::si {

/// The whole motion of a ball, Zh98 (2.1) to (2.5), from the similarity solution: slip and spin are one orbit of the
/// reduced system, the rest follows from the first integrals (motion_by_slip). Any instant is found by itself, by one root.
///
/// After the stop the ball rolls on a straight line at constant velocity: rolling resistance and the pull of a slope are
/// those of ResistedMotion.
///
/// Accuracy  1e-12 of the scales of the motion against integrate_motion, for mu from 1e-3 to 1.
class BallMotion {
 public:
  /// @throws std::domain_error  as require_experiment
  BallMotion(const Experiment& experiment, const reduction::Law& law);

  /// With what is known already.
  /// @param flow  of undriven_system(experiment, law)
  BallMotion(const Experiment& experiment, const reduction::Flow& flow);

  const reduction::Law& law() const { return law_; }

  /// s from the start until the ball neither slides nor spins.
  double stop_time() const { return stop_; }

  /// s until it no longer spins: with spin at the start, slip lasts as long; 0 without.
  double spin_end() const { return spin_at_start(experiment_) == 0 ? 0 : stop_; }

  /// @param t  s, >= 0
  /// @throws std::domain_error  if t is negative or not a number
  MotionPoint at_time(double t) const;

  /// at_time for each entry, in the order given.
  MotionColumns at_times(const Eigen::ArrayXd& times) const;

  /// s until the slip has fallen to that speed in m/s, >= 0; 0 for a ball that starts no faster.
  /// @throws std::domain_error  if the speed is negative or not a number
  double slip_time(double speed) const;

  /// s until the spin, of either sign, has fallen to that many rad/s, >= 0; 0 for a ball that spins no faster.
  /// @throws std::domain_error  if the speed is negative or not a number
  double spin_time(double speed) const;

  /// m that the contact point slides on the ball, that is the integral of slip over time, until the stop.
  double slip_length() const;

  /// rad that the ball turns about the vertical until the stop, of the sign of its spin.
  double spin_angle() const;

  /// m along the path of the centre until that time in s, to 1e-9.
  double path_length(double t) const;

 private:
  double paper_time(double t) const;

  Experiment experiment_;
  reduction::Law law_;
  reduction::Orbit orbit_;
  double stop_;
  double scale_;  ///< tau per s
};

}  // namespace contensou::si
