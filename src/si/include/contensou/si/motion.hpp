#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/flow.hpp"
#include "contensou/si/load_history.hpp"
#include "contensou/si/motion_point.hpp"

namespace contensou::si {

/// A time of a motion and the place of the centre at this time.
struct Event {
  double t;               ///< s
  Eigen::Vector2d place;  ///< m
};

/// The events of a motion.
struct Events {
  Event rolls, spin_ends;     ///< Motion::rolls, Motion::spin_end
  std::optional<Event> rest;  ///< Motion::rest; empty if the body does not come to rest
  double slip_length;         ///< m
  double turns;               ///< turns about the vertical
  double path;                ///< path of the centre, m, until the ball rolls or, lying flat, rests
};

/// A number of Events, such as {"rolls_after", "t", "s"}: the time, in s, of the event "rolls_after". A length or a
/// number of turns, such as "path", has no event; its name stands in `event`, and `of` is empty.
struct EventNumber {
  std::string_view event, of, unit;
  std::string_view column = {};              ///< heading in a table, such as "t_rolls"
  double (*value)(const Events&) = nullptr;  ///< returns infinity for `rest` if the body does not come to rest
};

/// Returns all numbers of Events: t, x and y of rolls, spin_ends and rest, then slip_length, turns and path.
std::span<const EventNumber> event_numbers();

/// The kinetic energy of a motion and its losses, in J.
struct EnergyBalance {
  double start;
  double sliding, pivoting;  ///< energies lost to friction
  double rolling;            ///< energy lost to rolling resistance
  double gained;             ///< energy gained on a slope
  double kept;               ///< energy at Motion::last_time
};

/// A part of a motion that is one orbit of a reduced system.
struct ReducedPiece {
  double tau;  ///< the time tau (scaling.hpp) at its beginning, m/s
  bool turns;  ///< false: rolling resistance holds the body, which slides like a puck
  reduction::Flow flow;
  reduction::State start;
  reduction::Orbit orbit;  ///< orbit that starts at tau; the piece may end before the orbit does
};

/// Return the state of a motion that consists of pieces: at the time tau after its start (at rest from the stop on), or
/// at a time before its stop. The regularised time beta is continuous from piece to piece.
/// @throws std::domain_error  as Orbit::at_time and at_time_left
reduction::OrbitPoint state_at(const std::vector<ReducedPiece>& pieces, double tau);
reduction::OrbitPoint state_at_time_left(const std::vector<ReducedPiece>& pieces, double left);

/// Returns the time tau at which the last piece ends, in m/s.
inline double stop_time(const std::vector<ReducedPiece>& pieces) {
  return pieces.back().tau + pieces.back().orbit.stop_time();
}

/// Slip in m/s below which a ball that no longer turns about a horizontal axis counts as resting. A ball that still
/// spins also slides; this sliding moves it by less than 0.1 mm.
inline constexpr double resting_slip = 1e-4;

/// The whole motion of a ball, or of a body that lies flat, from its start on: equations (2.1) to (2.5) of V. F.
/// Zhuravlev, 1998 (Zh98), with any friction law.
///
/// Friction determines slip and spin. Everything else follows from first integrals (motion_by_slip). Rolling resistance
/// is a torque chi J u_r g/R (J: moment of inertia) against turning about a horizontal axis; for a homogeneous ball
/// (7/5) u_r m g R. Under it a ball that rolls without slip slows down at u_r g. The torque also acts on a sliding
/// ball, and up to its size it prevents the start of turning. On a slope of the angle alpha, g cos(alpha) presses and g
/// sin(alpha) pulls. After slip and spin the ball rolls on or rests, in closed form (reduction/theory.md, (R24)).
///
/// A motion never changes. Copies, also in several threads, share its solution.
///
/// @throws std::domain_error  functions of a time or a speed, if the number is negative or not a number
class Motion {
 public:
  /// Computes the motion, if possible without steps in time. Slip and spin are then one orbit of the reduced system.
  ///
  /// Under rolling friction or on a slope they are several orbits with a drive (reduction/theory.md, (R21) to (R23)).
  /// This requires that the body slides in the direction in which it rolls, and straight down a slope. Any other such
  /// motion is integrated by the method of Cash and Karp 5(4).
  ///
  /// @param history  a changing load, whose nominal load is that of the experiment; the patch stays constant
  /// @throws std::domain_error   as require_experiment and require_stop; if the load becomes 0 before the motion ends;
  ///                             for a changing load with rolling friction or on a slope
  /// @throws std::runtime_error  if an integration does not reach the stop
  ///
  /// Accuracy  1e-12 of the scales of the motion, compared with in_steps, for mu from 1e-3 to 1; under a changing load
  ///           1e-10.
  static Motion reduced(const Experiment& experiment, const reduction::Law& law,
                        const std::optional<LoadHistory>& history = {});

  /// Computes the same motion from a system that is already solved.
  /// @param flow  flow of undriven_system(experiment, law)
  static Motion reduced(const Experiment& experiment, const reduction::Flow& flow,
                        const std::optional<LoadHistory>& history = {});

  /// Computes the motion by integration in time in every case, by the method of Cash and Karp 5(4), as an independent
  /// check. Without rolling friction and slope it uses neither the reduction nor the first integrals, and each state is
  /// integrated from the start. Parameters and errors as for reduced.
  ///
  /// Accuracy  1e-12 of the scales of the motion for mu from 1e-3 to 1; with rolling friction or on a slope 1e-6.
  static Motion in_steps(const Experiment& experiment, const reduction::Law& law,
                         const std::optional<LoadHistory>& history = {});

  /// Computes the motion of the uncoupled model: the slip falls at chi f g, and the spin falls as without sliding. When
  /// the ball rolls, it slows down at u_r g and comes to rest. On a slope the ball moves as a ball without spin, and
  /// spins independently.
  /// @param law            law for Psi(0), the moment of pure pivoting
  /// @param rolling_below  slip, m/s, >= 0, at which rolling friction begins to act in this model
  static Motion uncoupled(const Experiment& experiment, const reduction::Law& law, double rolling_below = rolling_slip,
                          const std::optional<LoadHistory>& history = {});

  /// Returns this motion if its lengths, angles and energies are certain not to exceed the largest double.
  /// @throws std::domain_error   as require_finite_motion
  /// @throws std::runtime_error  if its stop time exceeds the largest double
  const Motion& finite() const;

  const Experiment& experiment() const;

  /// Returns the state at a time.
  /// @param t  time, s, >= 0
  MotionPoint at(double t) const;

  /// Returns the states at all times, in the order given.
  MotionColumns at(const Eigen::ArrayXd& times) const;

  /// Returns the time from the start until slip and spin end, s.
  double stop_time() const;

  /// Returns the time until the spin ends, s; 0 without spin at the start.
  double spin_end() const;

  /// Returns the time after which the slip never exceeds a speed, s; 0 if the slip never exceeds this speed.
  /// @param speed  slip, m/s, >= 0
  double slip_time(double speed) const;

  /// Returns the time at which |spin| has fallen to a speed, s; 0 if |spin| never exceeds this speed.
  /// @param speed  spin, rad/s, >= 0
  double spin_time(double speed) const;

  /// Returns the time until the ball rolls, s; for a body that lies flat, until its centre comes to rest.
  /// @param rolling_below  slip below which a ball rolls, m/s, >= 0; not used for a body that lies flat
  double rolls(double rolling_below = rolling_slip) const;

  /// Returns the time and place at which the centre comes to rest, with rolling friction or on a slope. Empty if the
  /// body rolls on for ever, and for a body that lies flat on a level plane.
  std::optional<Event> rest() const;

  /// Returns the time until nothing moves, s; if the body rolls on for ever, the time until slip and spin end.
  double last_time() const;

  Event event(double t) const { return {t, at(t).position}; }

  /// Returns all events of the motion.
  /// @param rolling_below  as in rolls
  Events events(double rolling_below = rolling_slip) const;

  /// Returns the length that the contact point slides until the stop, m: the integral of slip over time.
  double slip_length() const;

  /// Return the angle about the vertical until the stop, in rad and in turns, with the sign of the spin.
  double spin_angle() const;
  double turns() const;

  /// Returns the length in m of the path of the centre until the time t >= 0 in s, to 1e-9.
  double path_length(double t) const;

  EnergyBalance energy_balance() const;

  /// Returns the velocities after slip and spin have ended.
  Velocities final_motion() const;

  /// Returns true if the motion was computed from the reduced system, without time steps.
  bool is_reduced() const;

  /// Returns the orbits of which the motion consists until slip and spin end; without a drive there is one orbit. Empty
  /// for a motion that is not reduced, and under a drive also for a start without slip and spin.
  std::vector<ReducedPiece> pieces() const;

  /// Returns the ratio v/(eps |omega_z|) at which a spinning body creeps; empty if it does not spin or does not creep.
  std::optional<double> creep_ratio() const;

  /// Returns the number of integration steps; 0 without an integration.
  long steps() const;

  class Solution;

 private:
  friend class Shots;
  explicit Motion(std::shared_ptr<const Solution> solution) : solution_(std::move(solution)) {}

  std::shared_ptr<const Solution> solution_;
};

class SharedFlows;

/// Motions of one ball that differ only in their starts. They share the solution of the system, also between threads.
class Shots {
 public:
  /// @param ball  its start is not used
  /// @throws std::domain_error  as undriven_system and require_stop
  Shots(const Experiment& ball, const reduction::Law& law);

  /// @param ball  its start is not used
  /// @param flow  flow of undriven_system(ball, law)
  /// @throws std::domain_error  as undriven_system and require_stop
  Shots(const Experiment& ball, const reduction::Flow& flow);

  /// Returns Motion::reduced from a start.
  /// @throws std::domain_error  as Motion::reduced
  Motion from(const Start& start) const;

 private:
  Experiment ball_;
  reduction::Law law_;
  std::shared_ptr<SharedFlows> flows_;
};

}  // namespace contensou::si
