#pragma once

#include <algorithm>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "contensou/si/motion.hpp"
#include "contensou/si/rolling_friction.hpp"

namespace contensou::si {

/// When something happens, and where the centre is then.
struct Event {
  double t;               ///< s
  Eigen::Vector2d place;  ///< m
};

/// A motion with the instant when it rolls, and with rolling friction from then on if there is any. A body that lies
/// flat does not roll: it comes to rest then.
/// @tparam Motion  BallMotion or UncoupledMotion
template <class Motion>
struct Course {
  Motion motion;
  double rolls;  ///< s until it does; of a body that lies flat until its centre rests
  std::optional<RollingFriction> friction;

  /// @param rolling_below     m/s, >= 0: a ball that slips no faster rolls; not of a body that lies flat
  /// @param rolling_friction  u_r; 0: none
  /// @throws std::domain_error  as slip_time, RollingFriction and require_finite_motion, and for rolling friction of a
  ///                            body that lies flat
  Course(const Experiment& experiment, Motion of_shot, double rolling_below, double rolling_friction)
      : motion(std::move(of_shot)), rolls(motion.slip_time(experiment.ball.body.lies_flat() ? 0 : rolling_below)) {
    if (rolling_friction != 0 && experiment.ball.body.lies_flat())
      throw std::domain_error("a body that lies flat never rolls: it has no rolling friction");
    double braked = std::max(rolls, motion.spin_end());
    require_finite_motion(experiment, braked);
    if (rolling_friction != 0) {
      friction.emplace(experiment.ball, motion.at_time(rolls), rolling_friction * experiment.environment.gravity);
      braked = std::max(braked, friction->rest_time());
      require_finite_motion(experiment, braked);
    }
  }

  MotionPoint at_time(double t) const { return friction ? (*friction)(motion.at_time(t)) : motion.at_time(t); }
  MotionColumns at_times(const Eigen::ArrayXd& times) const { return slowed(motion.at_times(times)); }

  /// Columns of the motion without rolling friction, with it.
  MotionColumns slowed(MotionColumns columns) const {
    for (Eigen::Index i = 0; friction && i < columns.rows(); ++i) columns.set(i, (*friction)(columns.row(i)));
    return columns;
  }

  Event event(double t) const { return {t, at_time(t).position}; }
};

/// What happens on a course.
struct Events {
  Event rolls, spin_ends;     ///< as Course::rolls
  std::optional<Event> rest;  ///< with rolling friction
  double slip_length;         ///< m
  double turns;               ///< about the vertical
  double path;                ///< m, of the centre until it rolls or, lying flat, rests
};

template <class Motion>
Events events_of(const Course<Motion>& course) {
  const auto& [motion, rolls, friction] = course;
  return {course.event(rolls),
          course.event(motion.spin_end()),
          friction ? std::optional(Event{friction->rest_time(), friction->rest_position()}) : std::nullopt,
          motion.slip_length(),
          motion.spin_angle() / (2 * std::numbers::pi),
          motion.path_length(rolls)};
}

}  // namespace contensou::si
