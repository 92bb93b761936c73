#pragma once

#include <algorithm>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "contensou/si/motion.hpp"
#include "contensou/si/resisted_motion.hpp"
#include "contensou/si/rolling_friction.hpp"

namespace contensou::si {

/// When something happens, and where the centre is then.
struct Event {
  double t;               ///< s
  Eigen::Vector2d place;  ///< m
};

/// A motion with the instant when it rolls, and with rolling friction if there is any: of a BallMotion it acts all the
/// time (ResistedMotion), the textbook's begins when it rolls. A body that lies flat does not roll: it comes to rest
/// then.
/// @tparam Motion  BallMotion or UncoupledMotion
template <class Motion>
struct Course {
  Motion motion;  ///< without rolling friction
  double rolls;   ///< s until it does; of a body that lies flat until its centre rests
  std::optional<RollingFriction> friction;
  std::optional<ResistedMotion> resisted;

  /// @param rolling_below     m/s, >= 0: a ball that slips no faster rolls; not of a body that lies flat
  /// @param rolling_friction  u_r; 0: none
  /// @throws std::domain_error  as slip_time, RollingFriction, ResistedMotion and require_finite_motion, and for rolling
  ///                            friction of a body that lies flat
  Course(const Experiment& experiment, Motion of_shot, double rolling_below, double rolling_friction)
      : motion(std::move(of_shot)), rolls(motion.slip_time(experiment.ball.body.lies_flat() ? 0 : rolling_below)) {
    if (rolling_friction != 0 && experiment.ball.body.lies_flat())
      throw std::domain_error("a body that lies flat never rolls: it has no rolling friction");
    require_finite_motion(experiment, std::max(rolls, motion.spin_end()));
    if (rolling_friction == 0) return;
    if constexpr (always_resisted) {
      resisted.emplace(experiment, motion.law(), rolling_friction);
      rolls = resisted->slip_time(rolling_below);
    } else {
      friction.emplace(experiment.ball, motion.at_time(rolls), rolling_friction * experiment.environment.gravity);
    }
    require_finite_motion(experiment, std::max({rolls, spin_end(), rest()->t}));
  }

  MotionPoint at_time(double t) const {
    if (resisted) return resisted->at_time(t);
    return friction ? (*friction)(motion.at_time(t)) : motion.at_time(t);
  }
  MotionColumns at_times(const Eigen::ArrayXd& times) const {
    if (!resisted && !friction) return motion.at_times(times);
    MotionColumns columns(times.size());
    for (Eigen::Index i = 0; i < times.size(); ++i) columns.set(i, at_time(times[i]));
    return columns;
  }

  double spin_end() const { return resisted ? resisted->spin_end() : motion.spin_end(); }
  double slip_length() const { return resisted ? resisted->slip_length() : motion.slip_length(); }
  double turns() const { return (resisted ? resisted->spin_angle() : motion.spin_angle()) / (2 * std::numbers::pi); }
  double path_length(double t) const { return resisted ? resisted->path_length(t) : motion.path_length(t); }

  /// With rolling friction.
  std::optional<Event> rest() const {
    if (resisted) return Event{resisted->rest_time(), resisted->rest_position()};
    if (friction) return Event{friction->rest_time(), friction->rest_position()};
    return std::nullopt;
  }

  Event event(double t) const { return {t, at_time(t).position}; }

 private:
  static constexpr bool always_resisted = requires(const Motion& of) { of.law(); };
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
  return {course.event(course.rolls),
          course.event(course.spin_end()),
          course.rest(),
          course.slip_length(),
          course.turns(),
          course.path_length(course.rolls)};
}

}  // namespace contensou::si
