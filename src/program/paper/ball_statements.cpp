// Velocities: V of the centre, omega of rotation, c of the contact point. v = |c|; e = c/v; n is normal to e.
#include <Eigen/Geometry>
#include <boost/math/quadrature/gauss.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/motion.hpp"
#include "paper/statements.hpp"
#include "paper/zh98.hpp"

namespace contensou::program {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using zh98::pi;

double cross(Vector2d a, Vector2d b) { return a.x() * b.y() - a.y() * b.x(); }

/// Returns the moment of inertia of a homogeneous ball divided by m R^2: the mean of 2/3 r^2 with the weight 3 r^2 dr.
double moment_of_inertia() {
  return boost::math::quadrature::gauss<double, 7>::integrate([](double r) { return 2 * r * r * r * r; }, 0, 1);
}

}  // namespace

std::vector<Statement> ball_statements() {
  si::Experiment experiment = si::find_ball("pool")->experiment;
  experiment.start = si::Velocities{.velocity = {1, 0.3}, .angular_velocity = {20, -15, -60}};
  const reduction::PadeLaw law;
  const double R = experiment.ball.radius, m = experiment.ball.mass, eps = si::patch_radius_of(experiment, law);
  const double fN = experiment.contact.friction * m * experiment.environment.gravity;
  const auto [V, omega] = si::velocities_of(experiment.start);

  // Compute velocities, forces and rates from mechanics in vector form.
  const Vector3d arm(0, 0, -R);  // the point of contact is below the centre
  const Vector2d c = V + omega.cross(arm).head<2>();
  const double v = c.norm(), alpha = std::atan2(c.y(), c.x());
  const Vector2d e = c / v, n(-e.y(), e.x());
  const auto [phi, psi] = law({v, eps * std::abs(omega.z())});
  const Vector2d force = -fN * phi * e;
  Vector3d moment = arm.cross(Vector3d(force.x(), force.y(), 0));
  moment.z() -= std::copysign(fN * eps * psi, omega.z());
  const Vector3d omega_rate = moment / (0.4 * m * R * R);
  const Vector2d c_rate = force / m + omega_rate.cross(arm).head<2>();
  Eigen::Matrix<double, 5, 1> rates;  // derivatives of omega_x, omega_y, u = R omega_z, v and alpha with respect to tau
  rates << omega_rate.x(), omega_rate.y(), R * omega_rate.z(), c_rate.dot(e), cross(e, c_rate) / v;
  rates *= 2 * m / (3 * pi * fN);  // dt/dtau

  // Integrate the equations of motion. Take the states at 0.02, 1, 1.5 and 2 stop times.
  const si::Motion motion = si::Motion::in_steps(experiment, law);
  const double stop = motion.stop_time();
  const Eigen::ArrayXd times = stop * (Eigen::ArrayXd(4) << 0.02, 1, 1.5, 2).finished();
  const si::MotionColumns at = motion.at(times);
  const auto V_at = [&](int i) { return Vector2d(at.vx[i], at.vy[i]); };
  const auto omega_at = [&](int i) { return Vector2d(at.wx[i], at.wy[i]); };
  const auto position_at = [&](int i) { return Vector2d(at.x[i], at.y[i]); };
  const auto c_at = [&](int i) { return Vector2d(V_at(i) + R * Vector2d(-omega_at(i).y(), omega_at(i).x())); };
  const double omega_along = omega.head<2>().dot(e);
  const double first_integral = 7 * R * omega.head<2>().dot(n) + 5 * v;  // omega along n is omega_y of the paper

  // Evaluate the formulas as printed in the paper.
  const Vector2d printed_c = zh98::contact_velocity(R, V, omega);
  const Vector2d printed_force = zh98::force(fN, eps, omega.z(), c);
  const Vector3d printed_moment = zh98::moment(fN, eps, R, omega.z(), v, force);
  const auto printed_rates = zh98::rates(eps / R, R, R * omega.z(), v, alpha);

  return {
      {"J", "moment of inertia over m R^2", 0.4, moment_of_inertia(), arithmetic},
      {"(2.1)", "v_x, m/s: V + omega x (0, 0, -R)", printed_c.x(), c.x(), arithmetic},
      {"(2.1)", "v_y, m/s", printed_c.y(), c.y(), arithmetic},
      {"(2.2)", "v and alpha are its polar coordinates: v_x again", v * std::cos(alpha), c.x(), arithmetic},
      {"(2.3)", "F, N: (1.4) with k = v/(eps |omega_z|)", printed_force.norm(), force.norm(), arithmetic},
      {"(2.3)", "F opposes the slip: its power, W", printed_force.dot(c), -force.norm() * v, arithmetic},
      {"(2.4)", "M_x, N m: that of F about the centre", printed_moment.x(), moment.x(), arithmetic},
      {"(2.4)", "M_y, N m", printed_moment.y(), moment.y(), arithmetic},
      {"(2.4)", "M_z acts on the body: its power, W, which friction takes", printed_moment.z() * omega.z(),
       moment.z() * omega.z(), 1e-15, 0, "", Verdict::erratum,
       "the minus that M_x and M_y carry; (2.5) repairs it with J omega_z' = -M_z", -printed_moment.z() * omega.z()},
      {"(2.5)", "J omega_z' = -M_z: the angular acceleration, 1/s^2", -printed_moment.z() / (0.4 * m * R * R),
       omega_rate.z(), arithmetic},
      {"(2.6)", "domega_x/dtau, from (2.1) to (2.5)", printed_rates[0], rates[0], arithmetic},
      {"(2.6)", "domega_y/dtau", printed_rates[1], rates[1], arithmetic},
      {"(2.6)", "du/dtau, u = R omega_z", printed_rates[2], rates[2], arithmetic},
      {"(2.6)", "dv/dtau", printed_rates[3], rates[3], arithmetic},
      {"(2.6)", "dalpha/dtau", printed_rates[4], rates[4], arithmetic},
      {"", "alpha is constant: slip across its first direction, over slip", 0., c_at(0).dot(n) / c_at(0).norm(),
       stepping},
      {"", "with alpha = 0, omega_x is constant: at the stop, 1/s", omega_along, omega_at(1).dot(e), stepping},
      {"", "and 7 R omega_y + 5 v: at 2 % of the stop time, m/s", first_integral,
       7 * R * omega_at(0).dot(n) + 5 * at.slip[0], stepping},
      {"", "omega_y = (const - 5 v)/(7 R): at the stop, 1/s", first_integral / (7 * R), omega_at(1).dot(n), stepping},
      {"", "x is 1/7 of the integral of 2 v + const: at the stop, m",
       (2 * motion.slip_length() + first_integral * stop) / 7, position_at(1).dot(e), stepping},
      {"", "y = y0 - R omega_x t: at the stop, m", -R * omega_along * stop, position_at(1).dot(n), stepping},
      {"", "after the stop it rolls without slip, m/s", 0., c_at(2).norm(), stepping},
      {"", "and without spin, 1/s", 0., at.wz[2], stepping},
      {"", "at constant velocity: speed at 2 tau* and at 1.5 tau*, m/s", V_at(2).norm(), V_at(3).norm(), stepping},
      {"", "on a straight line along it: way across velocity, m", 0.,
       cross(position_at(3) - position_at(2), V_at(2).normalized()), stepping},
      {"", "omega lies in the plane, across the velocity: omega V, m/s^2", 0., omega_at(2).dot(V_at(2)), stepping},
  };
}

}  // namespace contensou::program
