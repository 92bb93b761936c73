#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "contensou/reduction/flow.hpp"
#include "contensou/si/motion.hpp"

namespace contensou::si {

/// m/s: a ball that no longer turns about a horizontal axis and slides no faster rests. While it spins the last of its
/// sliding lasts as long, and takes it less than a tenth of a millimetre.
inline constexpr double resting_slip = 1e-4;

/// The solutions that motions of one body share which slide the same way, down the same slope, with the same rolling
/// friction and law: made by the first that needs them. Threads may share it.
class ResistedFlows {
 public:
  /// @param turning  of a ball that turns, else of one that is held
  /// @param made     the solution, where it is not known yet
  reduction::Flow of(bool turning, const std::function<reduction::Flow()>& made);

 private:
  std::mutex guard_;
  std::optional<reduction::Flow> turning_, held_;
};

/// A stretch of a motion that is an orbit of a reduced system with a drive.
struct ReducedPiece {
  double tau;  ///< paper's time at which it begins, in m/s
  bool turns;  ///< or rolling resistance holds it: it slides like a puck
  reduction::ReducedSystem system;
  reduction::State start;
  reduction::Orbit orbit;  ///< from there; the piece may end before it does
};

/// The state of a motion of such pieces at a time tau after its start, past the stop rest, and so much before its stop. beta
/// goes on from one piece to the next.
/// @throws std::domain_error  as Orbit::at_time and at_time_left
reduction::OrbitPoint state_at(const std::vector<ReducedPiece>& pieces, double tau);
reduction::OrbitPoint state_at_time_left(const std::vector<ReducedPiece>& pieces, double left);

/// When the last of the pieces ends, in m/s.
inline double stop_time(const std::vector<ReducedPiece>& pieces) {
  return pieces.back().tau + pieces.back().orbit.stop_time();
}

/// The whole motion of a ball with rolling resistance, on a slope, or both; of a body that lies flat on a slope.
///
/// Rolling resistance is a torque chi J u_r g/R, (7/5) u_r m g R of a homogeneous ball, against its turning about a
/// horizontal axis, under which it rolls without slip at u_r g slower each second. It acts while the ball slides, too; a
/// ball that does not turn it holds, up to that torque. On a slope g cos(alpha) presses, and g sin(alpha) pulls.
///
/// What slides the way it rolls, straight down if there is a slope, is found without time steps, as reduced motions with a
/// drive (reduction/README.md, (R53) to (R55)): while it turns, while resistance holds it and it slides like a puck; when
/// slip and spin have ended, it rolls on or rests. Any other is integrated: the five equations (2.5) with that torque and
/// that pull, by Cash-Karp 5(4). Pure rolling is in closed form (R56).
///
/// A value that never changes. Copies share the solution.
class ResistedMotion {
 public:
  /// @param u_r       rolling friction > 0, or 0 on a slope; in place of the experiment's own
  /// @param in_steps  to integrate it in any case
  /// @param flows     what motions share that differ in their speeds alone
  /// @throws std::domain_error   as require_experiment and require_stop, and where there is neither resistance nor slope
  /// @throws std::runtime_error  if the integration does not reach the stop
  ResistedMotion(const Experiment& experiment, const reduction::Law& law, double u_r, bool in_steps = false,
                 std::shared_ptr<ResistedFlows> flows = {});

  /// Whether it was found without time steps.
  bool is_reduced() const;

  /// The orbits it is made of until slip and spin end; none of one that is integrated.
  std::vector<ReducedPiece> pieces() const;

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

  /// s until its centre rests, infinity if it rolls down for ever; and where that is, in m.
  double rest_time() const;
  Eigen::Vector2d rest_position() const;

  /// m that the contact point slides, rad about the vertical.
  double slip_length() const;
  double spin_angle() const;

  /// s until it neither slides, spins nor moves; until it neither slides nor spins, where it rolls down for ever.
  double last_time() const;

  /// J that rolling resistance takes, and that the slope gives, until then.
  double rolling_loss() const;
  double gained_on_slope() const;

  /// m along the path of the centre until that time in s.
  double path_length(double t) const;

  class Course;

 private:
  std::shared_ptr<const Course> course_;
};

}  // namespace contensou::si
