// Notation: V, omega velocities of ball and centre, c that of the point of contact, e = c/v its direction, n across it.
#include <Eigen/Geometry>
#include <boost/math/quadrature/gauss.hpp>

#include "contensou/reduction/pade_law.hpp"
#include "contensou/si/bridge.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/integrated_motion.hpp"
#include "paper/statements.hpp"
#include "paper/zh98.hpp"

namespace contensou::program {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using zh98::pi;

constexpr double arithmetic = 1e-13;
constexpr double stepping = 1e-9;

double cross(Vector2d a, Vector2d b) { return a.x() * b.y() - a.y() * b.x(); }

/// One motion of a ball, by mechanics in vectors and by integration.
struct Motion {
  Motion() {
    const reduction::PadeLaw law;
    const Vector3d arm(0, 0, -R);  // the point of contact is below the centre
    c = V + omega.cross(arm).head<2>();
    v = c.norm();
    e = c / v;
    n = {-e.y(), e.x()};
    const auto [phi, psi] = law({v, eps * std::abs(omega.z())});
    force = -fN * phi * e;
    moment = arm.cross(Vector3d(force.x(), force.y(), 0));
    moment.z() -= std::copysign(fN * eps * psi, omega.z());
    omega_rate = moment / (0.4 * m * R * R);
    const double per_tau = 2 * m / (3 * pi * fN);  // dt/dtau
    const Vector2d c_rate = force / m + omega_rate.cross(arm).head<2>();
    rates << omega_rate.x(), omega_rate.y(), R * omega_rate.z(), c_rate.dot(e), cross(e, c_rate) / v;
    rates *= per_tau;

    stop = si::integrate_motion(shot, law, Eigen::ArrayXd(0)).stop_time;
    const Eigen::ArrayXd times = stop * (Eigen::ArrayXd(4) << 0.02, 1, 1.5, 2).finished();
    integrated = si::integrate_motion(shot, law, times);
  }

  /// At 0.02, 1, 1.5 and 2 stop times.
  Vector2d V_at(int i) const { return {integrated.points.vx[i], integrated.points.vy[i]}; }
  Vector2d omega_at(int i) const { return {integrated.points.wx[i], integrated.points.wy[i]}; }
  Vector2d position_at(int i) const { return {integrated.points.x[i], integrated.points.y[i]}; }
  Vector2d c_at(int i) const { return V_at(i) + R * Vector2d(-omega_at(i).y(), omega_at(i).x()); }

  si::Shot shot = [] {
    si::Shot oblique = si::find_ball("pool")->shot;
    oblique.start = si::Velocities{.velocity = {1, 0.3}, .angular_velocity = {20, -15, -60}};
    return oblique;
  }();
  double R = shot.ball.radius, m = shot.ball.mass, eps = si::patch_radius_of(shot);
  double fN = shot.contact.friction * m * shot.environment.gravity;
  Vector2d V = si::velocities_of(shot.start).velocity;
  Vector3d omega = si::velocities_of(shot.start).angular_velocity;
  Vector2d c, e, n, force;
  double v = 0;
  Vector3d moment, omega_rate;
  Eigen::Matrix<double, 5, 1> rates;  ///< of omega_x, omega_y, u = R omega_z, v and alpha by tau
  double stop = 0;
  si::IntegratedMotion integrated;
};

const Motion& ball() {
  static const Motion motion;
  return motion;
}

Vector2d printed_contact() { return zh98::contact_velocity(ball().R, ball().V, ball().omega); }
Vector2d printed_force() { return zh98::force(ball().fN, ball().eps, ball().omega.z(), ball().c); }
Vector3d printed_moment() {
  return zh98::moment(ball().fN, ball().eps, ball().R, ball().omega.z(), ball().v, ball().force);
}
double alpha() { return std::atan2(ball().c.y(), ball().c.x()); }

template <int row>
double printed_rate(double) {
  return zh98::rates(ball().eps / ball().R, ball().R, ball().R * ball().omega.z(), ball().v, alpha())[row];
}
template <int row>
double true_rate(double) {
  return ball().rates[row];
}

double omega_along() { return ball().omega.head<2>().dot(ball().e); }
/// 7 R omega_y + 5 v, y across the slip.
double first_integral(double) { return 7 * ball().R * ball().omega.head<2>().dot(ball().n) + 5 * ball().v; }

}  // namespace

std::vector<Statement> ball_statements() {
  return {
      {"J", "moment of inertia over m R^2", constant<2, 5>,
       // 2/3 r^2 over the mass of a homogeneous ball, 3 r^2 dr of unit mass and radius.
       [](double) {
         return boost::math::quadrature::gauss<double, 7>::integrate([](double r) { return 2 * r * r * r * r; }, 0, 1);
       },
       arithmetic},
      {"(2.1)", "v_x, m/s: V + omega x (0, 0, -R)", [](double) { return printed_contact().x(); },
       [](double) { return ball().c.x(); }, arithmetic},
      {"(2.1)", "v_y, m/s", [](double) { return printed_contact().y(); }, [](double) { return ball().c.y(); },
       arithmetic},
      {"(2.2)", "v and alpha are its polar coordinates: v_x again", [](double) { return ball().v * std::cos(alpha()); },
       [](double) { return ball().c.x(); }, arithmetic},
      {"(2.3)", "F, N: (1.4) with k = v/(eps |omega_z|)", [](double) { return printed_force().norm(); },
       [](double) { return ball().force.norm(); }, arithmetic},
      {"(2.3)", "F opposes the slip: its power, W", [](double) { return printed_force().dot(ball().c); },
       [](double) { return -ball().force.norm() * ball().v; }, arithmetic},
      {"(2.4)", "M_x, N m: that of F about the centre", [](double) { return printed_moment().x(); },
       [](double) { return ball().moment.x(); }, arithmetic},
      {"(2.4)", "M_y, N m", [](double) { return printed_moment().y(); }, [](double) { return ball().moment.y(); },
       arithmetic},
      {"(2.4)", "M_z acts on the body: its power, W, which friction takes",
       [](double) { return printed_moment().z() * ball().omega.z(); },
       [](double) { return ball().moment.z() * ball().omega.z(); }, 1e-15, 0, "", Verdict::erratum,
       "the minus that M_x and M_y carry; (2.5) repairs it with J omega_z' = -M_z",
       [](double) { return -printed_moment().z() * ball().omega.z(); }},
      {"(2.5)", "J omega_z' = -M_z: the angular acceleration, 1/s^2",
       [](double) { return -printed_moment().z() / (0.4 * ball().m * ball().R * ball().R); },
       [](double) { return ball().omega_rate.z(); }, arithmetic},
      {"(2.6)", "domega_x/dtau, from (2.1) to (2.5)", printed_rate<0>, true_rate<0>, arithmetic},
      {"(2.6)", "domega_y/dtau", printed_rate<1>, true_rate<1>, arithmetic},
      {"(2.6)", "du/dtau, u = R omega_z", printed_rate<2>, true_rate<2>, arithmetic},
      {"(2.6)", "dv/dtau", printed_rate<3>, true_rate<3>, arithmetic},
      {"(2.6)", "dalpha/dtau", printed_rate<4>, true_rate<4>, arithmetic},
      {"", "alpha is constant: slip across its first direction, over slip", constant<0>,
       [](double) { return ball().c_at(0).dot(ball().n) / ball().c_at(0).norm(); }, stepping},
      {"", "with alpha = 0, omega_x is constant: at the stop, 1/s", [](double) { return omega_along(); },
       [](double) { return ball().omega_at(1).dot(ball().e); }, stepping},
      {"", "and 7 R omega_y + 5 v: at 2 % of the stop time, m/s", first_integral,
       [](double) { return 7 * ball().R * ball().omega_at(0).dot(ball().n) + 5 * ball().integrated.points.slip[0]; },
       stepping},
      {"", "omega_y = (const - 5 v)/(7 R): at the stop, 1/s", [](double) { return first_integral(0) / (7 * ball().R); },
       [](double) { return ball().omega_at(1).dot(ball().n); }, stepping},
      {"", "x is 1/7 of the integral of 2 v + const: at the stop, m",
       [](double) { return (2 * ball().integrated.slip_length + first_integral(0) * ball().stop) / 7; },
       [](double) { return ball().position_at(1).dot(ball().e); }, stepping},
      {"", "y = y0 - R omega_x t: at the stop, m", [](double) { return -ball().R * omega_along() * ball().stop; },
       [](double) { return ball().position_at(1).dot(ball().n); }, stepping},
      {"", "after the stop it rolls without slip, m/s", constant<0>, [](double) { return ball().c_at(2).norm(); },
       stepping},
      {"", "and without spin, 1/s", constant<0>, [](double) { return ball().integrated.points.wz[2]; }, stepping},
      {"", "at constant velocity: speed at 2 tau* and at 1.5 tau*, m/s", [](double) { return ball().V_at(2).norm(); },
       [](double) { return ball().V_at(3).norm(); }, stepping},
      {"", "on a straight line along it: way across velocity, m", constant<0>,
       [](double) { return cross(ball().position_at(3) - ball().position_at(2), ball().V_at(2).normalized()); },
       stepping},
      {"", "omega lies in the plane, across the velocity: omega V, m/s^2", constant<0>,
       [](double) { return ball().omega_at(2).dot(ball().V_at(2)); }, stepping},
  };
}

}  // namespace contensou::program
