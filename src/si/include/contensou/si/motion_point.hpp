#pragma once

#include <Eigen/Core>

#include "contensou/si/experiment.hpp"

namespace contensou::si {

/// One instant of the motion of a ball on the plane.
struct MotionPoint {
  double t;                          ///< time since the start, s
  Eigen::Vector2d position;          ///< position of the centre, m; the start is (0, 0)
  Eigen::Vector2d velocity;          ///< velocity of the centre, m/s
  Eigen::Vector3d angular_velocity;  ///< angular velocity, rad/s, z up
  double slip;                       ///< speed of the contact point, m/s
  double energy;                     ///< kinetic energy, J
};

/// The states at several times: one column for each number, one row for each time; w is the angular velocity.
struct MotionColumns {
  Eigen::ArrayXd t, x, y, vx, vy, wx, wy, wz, slip, energy;

  explicit MotionColumns(Eigen::Index rows = 0);
  Eigen::Index rows() const { return t.size(); }
  MotionPoint row(Eigen::Index i) const;
  void set(Eigen::Index row, const MotionPoint& point);
};

/// Default slip, m/s, below which a ball counts as rolling. No eye or camera distinguishes a slip of 1 mm/s from
/// rolling. A threshold of 0 is useless: the friction of a pivoting patch is viscous, so the slip ends with the spin.
inline constexpr double rolling_slip = 1e-3;

/// Returns the kinetic energy in J; for a homogeneous ball m V^2/2 + (m R^2/5) omega^2.
double kinetic_energy(const Ball& ball, const Velocities& velocities);

/// The energies in J that friction dissipates until the body of an experiment rolls, under any friction law.
struct EnergyLoss {
  double sliding;   ///< m v0^2/(2 chi), for a ball m v0^2/7
  double pivoting;  ///< m (R omega_z0)^2/(2 gamma), for a ball m (R omega_z0)^2/5
};

EnergyLoss energy_loss(const Experiment& experiment);

/// Returns the velocities of the final rolling of an experiment, under any friction law; 0 for a body that lies flat.
/// The axes are the axes of the start (for SlipAndSpin x points along the initial slip).
///
/// Let x point along the slip v. R omega_y + (1 - 1/chi) v is a first integral; for a homogeneous ball it is 7 R
/// omega_y + 5 v. The velocity of the centre along the slip therefore falls by v0/chi, for this ball by 2 v0/7.
Velocities final_motion(const Experiment& experiment);

/// Returns the state of a motion at a time, computed from slip, slip length and spin about the vertical.
///
/// The slip keeps its direction e, and omega keeps its component along e. The velocity of the centre along e falls by
/// 1/chi of the lost slip (homogeneous ball: 2/7). The remainder of it changes R omega across e (V. F. Zhuravlev,
/// 1998, after (2.5)). The result: velocity V = V0 - (v0 - v) e/chi, place X = V0 t - (v0 t - slip_length) e/chi.
///
/// @param t            time, s
/// @param slip         slip v, m/s
/// @param slip_length  length slid since the start, m
/// @param spin         spin about the vertical, rad/s
MotionPoint motion_by_slip(const Experiment& experiment, double t, double slip, double slip_length, double spin);

}  // namespace contensou::si
