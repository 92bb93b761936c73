#include "contensou/si/motion_point.hpp"

namespace contensou::si {

MotionColumns::MotionColumns(Eigen::Index rows)
    : t(rows), x(rows), y(rows), vx(rows), vy(rows), wx(rows), wy(rows), wz(rows), slip(rows), energy(rows) {}

void MotionColumns::set(Eigen::Index row, const MotionPoint& point) {
  t[row] = point.t;
  x[row] = point.position.x();
  y[row] = point.position.y();
  vx[row] = point.velocity.x();
  vy[row] = point.velocity.y();
  wx[row] = point.angular_velocity.x();
  wy[row] = point.angular_velocity.y();
  wz[row] = point.angular_velocity.z();
  slip[row] = point.slip;
  energy[row] = point.energy;
}

MotionPoint MotionColumns::row(Eigen::Index i) const {
  return {t[i], {x[i], y[i]}, {vx[i], vy[i]}, {wx[i], wy[i], wz[i]}, slip[i], energy[i]};
}

double kinetic_energy(const Ball& ball, const Velocities& velocities) {
  const Eigen::Vector3d rim = ball.radius * velocities.angular_velocity;
  const auto [chi, gamma] = ball.body.inertia;
  const double turning = ball.body.lies_flat() ? 0 : rim.head<2>().squaredNorm() / (2 * (chi - 1));
  return ball.mass * (velocities.velocity.squaredNorm() / 2 + turning + rim.z() * rim.z() / (2 * gamma));
}

EnergyLoss energy_loss(const Experiment& experiment) {
  const double v = slip_at_start(experiment);
  const double u = experiment.ball.radius * spin_at_start(experiment);
  const auto [chi, gamma] = experiment.ball.body.inertia;
  return {experiment.ball.mass * v * v / (2 * chi), experiment.ball.mass * u * u / (2 * gamma)};
}

Velocities final_motion(const Experiment& experiment) {
  const double R = experiment.ball.radius;
  const double chi = experiment.ball.body.inertia.chi;
  if (experiment.ball.body.lies_flat()) return {Eigen::Vector2d::Zero(), Eigen::Vector3d::Zero()};
  if (const auto* start = std::get_if<SlipAndSpin>(&experiment.start)) {
    const double speed = start->slip * ((chi - 1) / chi);
    return {{speed, 0}, {0, speed / R, 0}};
  }
  const Eigen::Vector2d rolling =
      velocities_of(experiment.start).velocity - slip_velocity_at_start(experiment) * (1 / chi);
  return {rolling, {(0 - rolling.y()) / R, rolling.x() / R, 0}};  // 0 - y avoids -0
}

MotionPoint motion_by_slip(const Experiment& experiment, double t, double slip, double slip_length, double spin) {
  const Velocities start = velocities_of(experiment.start);
  const Eigen::Vector2d contact = slip_velocity_at_start(experiment);
  const double v0 = slip_at_start(experiment);
  const Eigen::Vector2d along = v0 > 0 ? Eigen::Vector2d(contact / v0) : Eigen::Vector2d::Zero();
  const double lost = v0 - slip;
  const double chi = experiment.ball.body.inertia.chi;
  const double rolling = (chi - 1) * lost / (chi * experiment.ball.radius);

  MotionPoint point;
  point.t = t;
  const Velocities final = final_motion(experiment);
  const auto way = [t](double speed) { return speed == 0 ? 0 : speed * t; };  // a speed of 0 stays 0 at infinite times
  point.position = final.velocity.unaryExpr(way) + slip_length * (1 / chi) * along;
  point.velocity = slip == 0 ? final.velocity : start.velocity - lost * (1 / chi) * along;
  point.angular_velocity = {start.angular_velocity.x() - rolling * along.y(),
                            start.angular_velocity.y() + rolling * along.x(), spin};
  point.slip = slip;
  point.energy = kinetic_energy(experiment.ball, {point.velocity, point.angular_velocity});
  return point;
}

}  // namespace contensou::si
