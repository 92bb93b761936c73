// Notation: V, omega velocities of ball and centre, c that of the contact point, e = c/v its direction, n across it.
#include "contensou/si/ball_claims.hpp"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <boost/math/quadrature/gauss.hpp>

#include "contensou/reduction/pade_law.hpp"
#include "contensou/si/bridge.hpp"

namespace contensou::si {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using reduction::Evidence;
using reduction::PaperClaim;
using reduction::Verdict;
using std::numbers::pi;

constexpr double arithmetic = 1e-13;
constexpr double stepping = 1e-9;

class BallExamination {
 public:
  BallExamination(const Shot& shot, const PrintedBall& printed, const Integration& integration)
      : shot_(shot),
        integration_(integration),
        printed_(printed),
        R_(shot.ball.radius),
        m_(shot.ball.mass),
        eps_(patch_radius_of(shot)),
        normal_friction_(shot.contact.friction * m_ * shot.environment.gravity),
        start_(velocities_of(shot.start)) {
    // The contact point is below the centre.
    const Vector3d arm(0, 0, -R_);
    contact_ = start_.velocity + start_.angular_velocity.cross(arm).head<2>();
    slip_ = contact_.norm();
    spin_ = start_.angular_velocity.z();
    const auto [phi, psi] = reduction::PadeLaw{}({slip_, eps_ * std::abs(spin_)});
    force_ = -normal_friction_ * phi * contact_ / slip_;
    moment_ = arm.cross(Vector3d(force_.x(), force_.y(), 0));
    moment_.z() -= std::copysign(normal_friction_ * eps_ * psi, spin_);
  }

  std::vector<PaperClaim> run() {
    equations();
    reduced();
    whole_motion();
    return std::move(claims_);
  }

 private:
  void add(std::string equation, std::string statement, Evidence evidence) {
    claims_.push_back({std::move(equation), std::move(statement), "", Verdict::holds, std::move(evidence)});
  }

  void equations() {
    // Homogeneous: the integral of 2/3 r^2 over the mass, 3 r^2 dr of unit mass and radius.
    const double inertia =
        boost::math::quadrature::gauss<double, 7>::integrate([](double r) { return 2 * r * r * r * r; }, 0, 1);
    add("J", "moment of inertia over m R^2", {printed_.inertia, inertia, arithmetic});
    const Vector2d contact = printed_.contact_velocity(R_, start_.velocity, start_.angular_velocity);
    add("(2.1)", "v_x, m/s: V + omega x (0, 0, -R)", {contact.x(), contact_.x(), arithmetic});
    add("(2.1)", "v_y, m/s", {contact.y(), contact_.y(), arithmetic});
    const double alpha = std::atan2(contact_.y(), contact_.x());
    add("(2.2)", "v and alpha are its polar coordinates: v_x again",
        {slip_ * std::cos(alpha), contact_.x(), arithmetic});
    const Vector2d force = printed_.force(normal_friction_, eps_, spin_, contact_);
    add("(2.3)", "F, N: (1.4) with k = v/(eps |omega_z|)", {force.norm(), force_.norm(), arithmetic});
    add("(2.3)", "F opposes the slip: its power, W", {force.dot(contact_), -force_.norm() * slip_, arithmetic});
    const Vector3d moment = printed_.moment(normal_friction_, eps_, R_, spin_, slip_, force_);
    add("(2.4)", "M_x, N m: that of F about the centre", {moment.x(), moment_.x(), arithmetic});
    add("(2.4)", "M_y, N m", {moment.y(), moment_.y(), arithmetic});
    claims_.push_back(
        {"(2.4)",
         "M_z acts on the body: its power, W, which friction takes",
         "the minus that M_x and M_y carry; (2.5) repairs it with J omega_z' = -M_z",
         Verdict::slip,
         {moment.z() * spin_, moment_.z() * spin_, 1e-13 * std::abs(moment_.z() * spin_), "", -moment.z() * spin_}});
    add("(2.5)", "J omega_z' = -M_z: the angular acceleration, 1/s^2",
        {-moment.z() / (printed_.inertia * m_ * R_ * R_), angular_acceleration().z(), arithmetic});
  }

  Vector3d angular_acceleration() const { return moment_ / (0.4 * m_ * R_ * R_); }

  /// (2.5) in vectors, turned into the variables and the time of (2.6).
  void reduced() {
    const double per_tau = 2 * m_ / (3 * pi * normal_friction_);  // dt/dtau
    const Vector3d turning = angular_acceleration() * per_tau;
    const Vector2d acceleration = force_ / m_ * per_tau;
    const Vector2d contact = acceleration + turning.cross(Vector3d(0, 0, -R_)).head<2>();
    const double alpha = std::atan2(contact_.y(), contact_.x());
    const auto rates = printed_.rates(eps_ / R_, R_, R_ * spin_, slip_, alpha);
    add("(2.6)", "domega_x/dtau, from (2.1) to (2.5)", {rates[0], turning.x(), arithmetic});
    add("(2.6)", "domega_y/dtau", {rates[1], turning.y(), arithmetic});
    add("(2.6)", "du/dtau, u = R omega_z", {rates[2], R_ * turning.z(), arithmetic});
    add("(2.6)", "dv/dtau", {rates[3], contact.dot(contact_) / slip_, arithmetic});
    add("(2.6)", "dalpha/dtau",
        {rates[4], (contact_.x() * contact.y() - contact_.y() * contact.x()) / (slip_ * slip_), arithmetic});
  }

  void whole_motion() {
    const double stop = integration_(shot_, reduction::PadeLaw{}, Eigen::ArrayXd::Zero(1)).stop_time;
    Eigen::ArrayXd times(5);
    times << 0.02 * stop, 0.1 * stop, stop, 1.5 * stop, 2 * stop;
    const IntegratedMotion motion = integration_(shot_, reduction::PadeLaw{}, times);
    const MotionColumns& at = motion.points;
    const Vector2d e = contact_ / slip_;
    const Vector2d n(-e.y(), e.x());
    const auto spin = [&](Eigen::Index i) { return Vector2d(at.wx[i], at.wy[i]); };
    const auto velocity = [&](Eigen::Index i) { return Vector2d(at.vx[i], at.vy[i]); };
    const auto position = [&](Eigen::Index i) { return Vector2d(at.x[i], at.y[i]); };
    const auto contact = [&](Eigen::Index i) { return Vector2d(at.vx[i] - R_ * at.wy[i], at.vy[i] + R_ * at.wx[i]); };
    const Vector2d early = contact(0);
    const Vector2d spin_at_start = start_.angular_velocity.head<2>();

    add("", "alpha is constant: slip across its first direction, over slip",
        {0, early.dot(n) / early.norm(), stepping});
    add("", "with alpha = 0, omega_x is constant: at the stop, 1/s", {spin_at_start.dot(e), spin(2).dot(e), stepping});
    const double constant = 7 * R_ * spin_at_start.dot(n) + 5 * slip_;
    add("", "and 7 R omega_y + 5 v: at 2 % of the stop time, m/s",
        {constant, 7 * R_ * spin(0).dot(n) + 5 * at.slip[0], stepping});
    add("", "omega_y = (const - 5 v)/(7 R): at the stop, 1/s", {constant / (7 * R_), spin(2).dot(n), stepping});
    add("", "x is 1/7 of the integral of 2 v + const: at the stop, m",
        {(2 * motion.slip_length + constant * stop) / 7, position(2).dot(e), stepping});
    add("", "y = y0 - R omega_x t: at the stop, m", {-R_ * spin_at_start.dot(e) * stop, position(2).dot(n), stepping});
    const State end{contact(3).norm(), at.wz[3]};
    add("", "after the stop it rolls without slip, m/s", {0, end.slip, stepping});
    add("", "and without spin, 1/s", {0, end.spin, stepping});
    add("", "at constant velocity: speed at 2 tau* and at 1.5 tau*, m/s",
        {velocity(3).norm(), velocity(4).norm(), stepping});
    const Vector2d first = velocity(3);
    const Vector2d way = position(4) - position(3);
    add("", "on a straight line along it: way across velocity, m",
        {0, (way.x() * first.y() - way.y() * first.x()) / first.norm(), stepping});
    add("", "omega lies in the plane, across the velocity: omega V, m/s^2", {0, spin(3).dot(velocity(3)), stepping});
  }

  struct State {
    double slip, spin;
  };

  Shot shot_;
  Integration integration_;
  PrintedBall printed_;
  double R_, m_, eps_, normal_friction_;
  Velocities start_;
  Vector2d contact_, force_;
  Vector3d moment_;
  double slip_ = 0;
  double spin_ = 0;
  std::vector<PaperClaim> claims_;
};

}  // namespace

PrintedBall printed_ball() {
  PrintedBall printed;
  printed.inertia = 2.0 / 5;
  printed.contact_velocity = [](double R, const Vector2d& velocity, const Vector3d& omega) {
    return Vector2d(velocity.x() - R * omega.y(), velocity.y() + R * omega.x());
  };
  printed.force = [](double normal_friction, double eps, double spin, const Vector2d& contact) {
    const double v = contact.norm();
    const double F = 3 * pi * normal_friction * v / (8 * eps * std::abs(spin) + 3 * pi * v);
    return Vector2d(-F * contact.x() / v, -F * contact.y() / v);
  };
  printed.moment = [](double normal_friction, double eps, double R, double spin, double v, const Vector2d& F) {
    return Vector3d(R * F.y(), -R * F.x(),
                    3 * pi * normal_friction * eps * eps * spin / (16 * eps * std::abs(spin) + 15 * pi * v));
  };
  printed.rates = [](double mu, double R, double u, double v, double alpha) {
    const double sliding = 8 * mu * std::abs(u) + 3 * pi * v;
    Eigen::Matrix<double, 5, 1> rates;
    rates << -5 * v * std::sin(alpha) / (R * sliding), 5 * v * std::cos(alpha) / (R * sliding),
        -5 * mu * mu * u / (16 * mu * std::abs(u) + 15 * pi * v), -7 * v / sliding, 0;
    return rates;
  };
  return printed;
}

std::vector<PaperClaim> ball_claims(const Shot& shot, const PrintedBall& printed, const Integration& integration) {
  require_shot(shot);
  return BallExamination(shot, printed, integration).run();
}

}  // namespace contensou::si
