#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/resisted_motion.hpp"
#include "contensou/si/rolling_friction.hpp"

namespace contensou::si {

/// When something happens, and where the centre is then.
struct Event {
  double t;               ///< s
  Eigen::Vector2d place;  ///< m
};

/// When and where the centre rests; none where it rolls on for ever.
inline std::optional<Event> rest_of(const ResistedMotion& motion) {
  if (std::isinf(motion.rest_time())) return std::nullopt;
  return Event{motion.rest_time(), motion.rest_position()};
}

/// A motion with the instant when it rolls, with rolling friction if there is any and down or up a slope: of a BallMotion
/// both act all the time (ResistedMotion). The textbook's rolling friction begins when it rolls (RollingFriction); on a slope the textbook's
/// ball moves as one without spin, and spins by itself. A body that lies flat does not roll: it comes to rest then.
/// @tparam Motion  BallMotion or UncoupledMotion
template <class Motion>
struct Course {
  Motion motion;  ///< without rolling friction, on a level plane
  double rolls;   ///< s until it does; of a body that lies flat until its centre rests
  std::optional<RollingFriction> friction;
  std::optional<ResistedMotion> resisted;

  /// @param rolling_below  m/s, >= 0: a ball that slips no faster rolls; not of a body that lies flat
  /// @param u_r            rolling friction; 0: none
  /// @param flows          as ResistedMotion's
  /// @throws std::domain_error  as slip_time, RollingFriction, ResistedMotion and require_finite_motion, and for rolling
  ///                            friction of a body that lies flat
  Course(const Experiment& experiment, Motion of_shot, double rolling_below, double u_r,
         std::shared_ptr<ResistedFlows> flows = {})
      : motion(std::move(of_shot)),
        rolls(motion.slip_time(experiment.ball.body.lies_flat() ? 0 : rolling_below)),
        ball_(experiment.ball) {
    const bool slopes = experiment.environment.slope != 0, flat = experiment.ball.body.lies_flat();
    if (u_r != 0 && flat) throw std::domain_error("a body that lies flat never rolls: it has no rolling friction");
    require_finite_motion(experiment, std::max(rolls, motion.spin_end()));
    if (u_r == 0 && !slopes) return;
    if constexpr (always_resisted) {
      resisted.emplace(experiment, motion.law(), u_r, false, std::move(flows));
    } else if (slopes) {
      resisted.emplace(without_spin(experiment), reduction::Law(reduction::HertzLaw{}), u_r);
    } else {
      const double g = experiment.environment.gravity;
      free_until_ = rolls;
      friction.emplace(experiment.ball, motion.at_time(rolls), u_r * g, experiment.contact.friction * g);
      rolls = friction->slip_time(rolling_below);
    }
    if (resisted) rolls = resisted->slip_time(flat ? 0 : rolling_below);
    const auto rests = rest();
    require_finite_motion(experiment, std::max({rolls, spin_end(), rests ? rests->t : 0}));
  }

  MotionPoint at_time(double t) const {
    if (resisted) return spinning(resisted->at_time(t));
    return friction ? (*friction)(motion.at_time(t)) : motion.at_time(t);
  }
  MotionColumns at_times(const Eigen::ArrayXd& times) const {
    if (!resisted && !friction) return motion.at_times(times);
    MotionColumns columns(times.size());
    for (Eigen::Index i = 0; i < times.size(); ++i) columns.set(i, at_time(times[i]));
    return columns;
  }

  double spin_end() const { return coupled() ? resisted->spin_end() : motion.spin_end(); }
  double slip_length() const {
    if (resisted) return resisted->slip_length();
    return motion.slip_length() + (friction ? friction->slip_length() : 0);
  }
  double turns() const { return (coupled() ? resisted->spin_angle() : motion.spin_angle()) / (2 * std::numbers::pi); }
  double path_length(double t) const {
    if (resisted) return resisted->path_length(t);
    if (!friction || t <= free_until_) return motion.path_length(t);
    return motion.path_length(free_until_) + (at_time(t).position - at_time(free_until_).position).norm();
  }

  /// With rolling friction or on a slope; none where it rolls on for ever.
  std::optional<Event> rest() const {
    if (resisted) return rest_of(*resisted);
    if (friction) return Event{friction->rest_time(), friction->rest_position()};
    return std::nullopt;
  }

  Event event(double t) const { return {t, at_time(t).position}; }

 private:
  static constexpr bool always_resisted = requires(const Motion& of) { of.law(); };

  Ball ball_;
  double free_until_ = 0;  ///< s, when the uncoupled model's rolling friction begins

  bool coupled() const { return always_resisted && resisted; }

  /// Of the textbook's ball, with its own spin.
  MotionPoint spinning(MotionPoint point) const {
    if constexpr (always_resisted) return point;
    point.angular_velocity.z() = motion.at_time(point.t).angular_velocity.z();
    point.energy = kinetic_energy(ball_, {point.velocity, point.angular_velocity});
    return point;
  }
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
