#pragma once

#include <Eigen/Core>

#include "contensou/si/experiment.hpp"

namespace contensou::si {

/// One instant of the motion of a ball on the plane.
struct MotionPoint {
  double t;                          ///< s, since the start
  Eigen::Vector2d position;          ///< m, of the centre; the start is (0, 0)
  Eigen::Vector2d velocity;          ///< m/s, of the centre
  Eigen::Vector3d angular_velocity;  ///< rad/s, z up
  double slip;                       ///< m/s, speed of the contact point
  double energy;                     ///< J, kinetic
};

/// Many instants, one entry of each column for each; w is the angular velocity.
struct MotionColumns {
  Eigen::ArrayXd t, x, y, vx, vy, wx, wy, wz, slip, energy;

  explicit MotionColumns(Eigen::Index rows = 0);
  Eigen::Index rows() const { return t.size(); }
  MotionPoint row(Eigen::Index i) const;
  void set(Eigen::Index row, const MotionPoint& point);
};

/// m/s: a ball that slips no faster counts as rolling, unless another threshold is asked for. A millimetre in a second
/// is less than an eye or a camera tells from rolling. Zero would not do: friction over a pivoting patch is viscous,
/// and the slip ends with the spin only.
inline constexpr double rolling_slip = 1e-3;

/// Kinetic energy in J: of a homogeneous ball m V^2/2 + (m R^2/5) omega^2.
double kinetic_energy(const Ball& ball, const Velocities& velocities);

/// What friction takes from an experiment until it rolls, in J, under any friction law.
struct EnergyLoss {
  double sliding;   ///< m v0^2/(2 chi), of a ball m v0^2/7
  double pivoting;  ///< m (R omega_z0)^2/(2 gamma), of a ball m (R omega_z0)^2/5
};

EnergyLoss energy_loss(const Experiment& experiment);

/// The rolling that an experiment ends in, or the rest of a body that lies flat, under any friction law, in the axes of the start (x along the initial slip
/// for SlipAndSpin).
///
/// With the axis x along the slip v, R omega_y + (1 - 1/chi) v is a first integral, of a homogeneous ball
/// 7 R omega_y + 5 v (Zh98 after (2.5)): the velocity of the centre along the slip falls by v0/chi, 2 v0/7.
Velocities final_motion(const Experiment& experiment);

/// The motion when the contact point slides at `slip`, having slid for `slip_length` since the start, and the ball
/// spins at `spin` about the vertical: friction leaves nothing else free.
///
/// The slip keeps its direction e, and with it omega along e; along e the velocity of the centre falls by 1/chi of what
/// the slip has lost, 2/7 of a homogeneous ball, and R omega across e takes the rest (Zh98 after (2.5)). So
/// V = V0 - (v0 - v) e/chi and X = V0 t - (v0 t - slip_length) e/chi.
///
/// @param t            s
/// @param slip         m/s
/// @param slip_length  m
/// @param spin         rad/s
MotionPoint motion_by_slip(const Experiment& experiment, double t, double slip, double slip_length, double spin);

}  // namespace contensou::si
