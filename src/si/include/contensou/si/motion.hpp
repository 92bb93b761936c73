#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/flow.hpp"
#include "contensou/si/load_history.hpp"
#include "contensou/si/motion_point.hpp"

namespace contensou::si {

/// An instant of a motion, and the place of the centre.
struct Event {
  double t;               ///< s
  Eigen::Vector2d place;  ///< m
};

/// The events of a motion.
struct Events {
  Event rolls, spin_ends;     ///< Motion::rolls, Motion::spin_end
  std::optional<Event> rest;  ///< Motion::rest
  double slip_length;         ///< m
  double turns;               ///< about the vertical
  double path;                ///< m, of the centre until it rolls or, lying flat, rests
};

/// The kinetic energy of a motion, and where it goes, in J.
struct EnergyBalance {
  double start;
  double sliding, pivoting;  ///< lost to friction
  double rolling;            ///< lost to rolling resistance
  double gained;             ///< on a slope
  double kept;               ///< at Motion::last_time
};

/// A stretch of a motion that is an orbit of a reduced system.
struct ReducedPiece {
  double tau;  ///< paper's time at which it begins, in m/s
  bool turns;  ///< or rolling resistance holds it: it slides like a puck
  reduction::Flow flow;
  reduction::State start;
  reduction::Orbit orbit;  ///< from there; the piece may end before it does
};

/// Return the state of a motion of such pieces at a time tau after its start, past the stop rest, and so much before its
/// stop. beta goes on from one piece to the next.
/// @throws std::domain_error  as Orbit::at_time and at_time_left
reduction::OrbitPoint state_at(const std::vector<ReducedPiece>& pieces, double tau);
reduction::OrbitPoint state_at_time_left(const std::vector<ReducedPiece>& pieces, double left);

/// Returns the time at which the last of the pieces ends, in m/s.
inline double stop_time(const std::vector<ReducedPiece>& pieces) {
  return pieces.back().tau + pieces.back().orbit.stop_time();
}

/// m/s: a ball that no longer turns about a horizontal axis and slides no faster rests. While it spins the last of its
/// sliding lasts as long, and takes it less than a tenth of a millimetre.
inline constexpr double resting_slip = 1e-4;

/// The whole motion of a ball, or of a body that lies flat, Zh98 (2.1) to (2.5), from its start on for ever.
///
/// Friction decides slip and spin, and the rest follows from the first integrals (motion_by_slip). Rolling resistance is a
/// torque chi J u_r g/R, (7/5) u_r m g R of a homogeneous ball, against turning about a horizontal axis, under which a ball
/// rolls without slip at u_r g slower each second. It acts while the ball slides, too; a ball that does not turn it holds, up
/// to that torque. On a slope g cos(alpha) presses, and g sin(alpha) pulls. When slip and spin have ended, the ball rolls on
/// or rests, in closed form (R56).
///
/// A value that never changes. Copies share the solution, and so may threads.
class Motion {
 public:
  /// Finds the motion without time steps where that is possible: slip and spin are one orbit of the reduced system. With
  /// rolling friction or on a slope they are several orbits with a drive (reduction/README.md, (R53) to (R55)) if the body
  /// slides the way it rolls, straight down if there is a slope; any other such motion is integrated by Cash-Karp 5(4).
  /// @param history  of a load that changes, whose nominal load is the experiment's; the patch does not change with it
  /// @throws std::domain_error   as require_experiment and require_stop; if the load ends at 0 before the motion does; for
  ///                             a load that changes with rolling friction or on a slope
  /// @throws std::runtime_error  if an integration does not reach the stop
  ///
  /// Accuracy  1e-12 of the scales of the motion against in_steps, for mu from 1e-3 to 1; under a load that changes 1e-10.
  static Motion reduced(const Experiment& experiment, const reduction::Law& law,
                        const std::optional<LoadHistory>& history = {});

  /// Finds the same motion from a system that is solved already.
  /// @param flow  of undriven_system(experiment, law)
  static Motion reduced(const Experiment& experiment, const reduction::Flow& flow,
                        const std::optional<LoadHistory>& history = {});

  /// Integrates the equations of motion in any case, a route of its own, by Cash-Karp 5(4). Without rolling friction and
  /// slope it uses neither the reduction nor the first integrals: each instant is integrated from the start. Parameters
  /// and errors are those of reduced.
  ///
  /// Accuracy  1e-12 of the scales of the motion for mu from 1e-3 to 1; with rolling friction or on a slope 1e-6.
  static Motion in_steps(const Experiment& experiment, const reduction::Law& law,
                         const std::optional<LoadHistory>& history = {});

  /// Returns the motion of the uncoupled model: the slip falls at chi f g, the spin at its rate without sliding. Its rolling friction begins when
  /// it rolls: it slows down at u_r g and rests. On a slope it moves as a ball without spin, and spins by itself.
  /// @param law            gives Psi(0), the moment of pure pivoting
  /// @param rolling_below  m/s, >= 0: the slip at which its rolling friction begins
  static Motion uncoupled(const Experiment& experiment, const reduction::Law& law, double rolling_below = rolling_slip,
                          const std::optional<LoadHistory>& history = {});

  /// Rejects a motion whose lengths, angles or energies may exceed the largest double.
  /// @throws std::domain_error   as require_finite_motion
  /// @throws std::runtime_error  if its stop time exceeds the largest double
  const Motion& finite() const;

  const Experiment& experiment() const;

  /// Returns the instant at t.
  /// @param t  s, >= 0
  /// @throws std::domain_error  if t is negative or not a number
  MotionPoint at(double t) const;

  /// Returns the instants at all times, in the order given.
  MotionColumns at(const Eigen::ArrayXd& times) const;

  /// Returns the s from the start until the body neither slides nor spins.
  double stop_time() const;

  /// Returns the s until it spins no more; 0 without spin at the start.
  double spin_end() const;

  /// Returns the s from which on the slip is no faster than that many m/s, >= 0; 0 for one that is never faster.
  /// @throws std::domain_error  if the speed is negative or not a number
  double slip_time(double speed) const;

  /// Returns the s until the spin, of either sign, has fallen to that many rad/s, >= 0; 0 for a body that spins no faster.
  /// @throws std::domain_error  if the speed is negative or not a number
  double spin_time(double speed) const;

  /// Returns the s until it rolls; of a body that lies flat until its centre rests.
  /// @param rolling_below  m/s, >= 0: a ball that slips no faster rolls; not of a body that lies flat
  double rolls(double rolling_below = rolling_slip) const;

  /// Returns when and where the centre rests, with rolling friction or on a slope; none where it rolls on for ever, and of a
  /// body that lies flat on a level plane.
  std::optional<Event> rest() const;

  /// Returns the s until it neither slides, spins nor moves; until slip and spin have ended, where it rolls on for ever.
  double last_time() const;

  Event event(double t) const { return {t, at(t).position}; }

  /// Returns all its events.
  /// @param rolling_below  as of rolls
  Events events(double rolling_below = rolling_slip) const;

  /// Returns the m that the contact point slides on the body until the stop: the integral of slip over time.
  double slip_length() const;

  /// Return the rad that the body turns about the vertical until the stop, of the sign of its spin; and the turns.
  double spin_angle() const;
  double turns() const;

  /// Returns the m along the path of the centre until that time in s >= 0, to 1e-9.
  double path_length(double t) const;

  EnergyBalance energy_balance() const;

  /// Returns how it moves when slip and spin have ended.
  Velocities final_motion() const;

  /// Returns whether it was found without time steps, from the reduced system.
  bool is_reduced() const;

  /// The orbits it is made of until slip and spin end: one of a body that nothing drives. None of a motion that is not
  /// reduced, and of one that neither slides nor spins beside rolling friction or on a slope.
  std::vector<ReducedPiece> pieces() const;

  /// Returns the v/(eps |omega_z|) at which it creeps while it spins, if there is such a ratio and it spins.
  std::optional<double> creep_ratio() const;

  /// Returns the number of steps of an integration; 0 without one.
  long steps() const;

  class Solution;

 private:
  friend class Shots;
  explicit Motion(std::shared_ptr<const Solution> solution) : solution_(std::move(solution)) {}

  std::shared_ptr<const Solution> solution_;
};

class SharedFlows;

/// Motions of one ball that differ in their starts alone: what they share is solved once. Threads may share it.
class Shots {
 public:
  /// @param ball  its start does not count
  /// @param flow  of undriven_system(ball, law)
  /// @throws std::domain_error  as undriven_system and require_stop
  Shots(const Experiment& ball, const reduction::Law& law);
  Shots(const Experiment& ball, const reduction::Flow& flow);

  /// Returns Motion::reduced from that start.
  /// @throws std::domain_error  as Motion::reduced
  Motion from(const Start& start) const;

 private:
  Experiment ball_;
  reduction::Law law_;
  std::shared_ptr<SharedFlows> flows_;
};

}  // namespace contensou::si
