// Notation, with the equations of V. F. Zhuravlev, 1998 (Zh98): V and omega are the velocities of the centre and of the
// ball. c = (Vx - R omega_y, Vy + R omega_x) is the velocity of the contact point (2.1). v = |c|, e = c/v, and alpha is
// the angle from e at the start to e. Friction is the force -f N Phi e at the contact point, and the moment -f N eps
// Psi sign(omega_z) about the vertical:
//   m V' = F,   J omega_x' = R F_y,  J omega_y' = -R F_x,  J_z omega_z' = M                  (2.5)
// with R^2/J = (chi - 1)/m and J_z = m R^2/gamma. For a ball J = J_z = (2/5) m R^2; for a body that lies flat 1/J is 0.
// Units of the integration: R omega is divided by a speed scale, t by a time scale T, the position by their product.
// The slip length is divided by the slip length without spin.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_cash_karp54.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>

#include "contensou/reduction/detail/root.hpp"
#include "solution.hpp"

namespace contensou::si {

namespace {

namespace odeint = boost::numeric::odeint;
using Eigen::Vector2d;
using Eigen::Vector3d;

// ln(v/scale), alpha, ln(R|omega_z|/scale), R omega_x/scale, R omega_y/scale, x, y, slip length, R spin angle
using Values = std::array<double, 9>;
// Fehlberg 7(8) is unsuitable. Its error estimate compares the two ends of a step and vanishes for a quadrature; the
// position and the horizontal spin are quadratures.
using CashKarp = odeint::runge_kutta_cash_karp54<Values>;

constexpr double tolerance = 1e-14;
constexpr long step_limit = 1'000'000;

/// The equations of motion, with the values of one experiment.
struct Ballistics {
  const reduction::Law& law;
  double R;
  // These values are per unit of mass, because the mass cancels and may be unknown.
  double tilting;  ///< m R^2/J
  double J_z;
  double normal_friction;  ///< f N/m
  double eps;
  double turn;     ///< 1 or -1: sign of omega_z
  Vector2d along;  ///< e at the start, from which alpha is measured
  double speed_scale;
  double time_scale;
  double slip_scale;

  /// Returns the mass times the acceleration of the contact point, divided by the force.
  double mobility() const { return 1 + tilting; }
  double slip(const Values& x) const { return speed_scale * std::exp(x[0]); }
  double spin(const Values& x) const { return speed_scale * std::exp(x[2]) / R; }  // |omega_z|
  Vector2d direction(const Values& x) const {
    return std::cos(x[1]) * along + std::sin(x[1]) * Vector2d(-along.y(), along.x());
  }
  Vector3d angular_velocity(const Values& x) const {
    return {speed_scale / R * x[3], speed_scale / R * x[4], turn * spin(x)};
  }

  /// Returns the velocity of the centre from the velocity of the contact point, by (2.1).
  Vector2d velocity(const Values& x) const {
    const Vector2d rolling = speed_scale * Vector2d(x[4], -x[3]);
    return slip(x) * direction(x) + rolling;
  }

  void operator()(const Values& x, Values& rate, double /*t*/) const {
    const double v = slip(x);
    const double omega = spin(x);
    if (std::isnan(v) || std::isnan(omega) || !(v > 0 || omega > 0)) {
      rate.fill(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    const auto [phi, psi] = law(reduction::Slip{v, eps * omega});
    const Vector2d e = direction(x);
    const Vector2d acceleration = -normal_friction * phi * e;
    const Vector2d turning = tilting / R * Vector2d(acceleration.y(), -acceleration.x());
    const Vector2d contact = acceleration + R * Vector2d(-turning.y(), turning.x());
    const Vector2d centre = velocity(x);
    rate[0] = contact.dot(e) / v;
    rate[1] = (e.x() * contact.y() - e.y() * contact.x()) / v;
    rate[2] = -normal_friction * eps * psi / (J_z * omega);
    rate[3] = R / speed_scale * turning.x();
    rate[4] = R / speed_scale * turning.y();
    const double length = speed_scale * time_scale;
    rate[5] = centre.x() / length;
    rate[6] = centre.y() / length;
    rate[7] = v / slip_scale;
    rate[8] = R * omega / length;
    for (double& value : rate) value *= time_scale;
  }

  double slip_time_left(double v) const { return v / (normal_friction * mobility()); }
  /// Returns ln k, k = v/(eps |omega_z|).
  double log_ratio(const Values& x) const { return x[0] - x[2] + std::log(R / eps); }

  double spin_time_left(double omega) const { return omega * J_z / (normal_friction * eps * law.pivoting_moment()); }
};

/// The end of a motion in which force or moment alone acts. The slip or the spin then falls linearly in time.
class Tail {
 public:
  /// @param start  time of `from`, s
  Tail(const Ballistics& ball, const Values& from, double start) : ball_(ball), from_(from), start_(start) {
    const double sliding = ball.slip_time_left(ball.slip(from));
    const double pivoting = ball.spin_time_left(ball.spin(from));
    slides_ = sliding > pivoting;
    left_ = std::max(sliding, pivoting);
    // The logarithm of the other speed is a linear function of the logarithm of the first speed.
    if (slides_) {
      constexpr double fast = 0x1p100;
      const double moment = fast * ball.law(reduction::Slip{fast, 1}).moment;  // k Psi at infinity
      other_slope_ = ball.eps * ball.eps * moment / (ball.J_z * ball.mobility());
    } else {
      other_slope_ =
          ball.mobility() * ball.law.force_slope() * ball.J_z / (ball.eps * ball.eps * ball.law.pivoting_moment());
    }
  }

  double stop() const { return start_ + left_; }

  /// Returns the state at a time in [start, infinity), in s.
  Values at_time(double t) const {
    const double share = t < stop() && left_ > 0 ? std::min((stop() - t) / left_, 1.0) : 0.0;
    const double passed = std::min(t, stop()) - start_;
    const double mean = (1 + share) / 2 * passed;  // time in which the speed of the start covers the same distance
    const double v = slides_ ? ball_.slip(from_) : 0;
    const double omega = slides_ ? 0 : ball_.spin(from_);
    const double part = ball_.tilting / ball_.mobility();  // part of the lost slip that becomes rotation
    const Vector2d e = ball_.direction(from_);
    const double length = ball_.speed_scale * ball_.time_scale;
    Values x = from_;
    x[slides_ ? 0 : 2] += std::log(share);
    x[slides_ ? 2 : 0] += share > 0 ? other_slope_ * std::log(share) : -std::numeric_limits<double>::infinity();
    x[3] -= part * v * (1 - share) * e.y() / ball_.speed_scale;
    x[4] += part * v * (1 - share) * e.x() / ball_.speed_scale;
    const Vector2d way = ball_.velocity(from_) * passed - (1 - part) * v * (passed - mean) * e +
                         ball_.velocity(x) * std::max(t - stop(), 0.0);
    x[5] += way.x() / length;
    x[6] += way.y() / length;
    x[7] += v * mean / ball_.slip_scale;
    x[8] += ball_.R * omega * mean / length;
    return x;
  }

 private:
  const Ballistics& ball_;
  Values from_;
  double start_;
  double left_;
  double other_slope_;
  bool slides_;
};

/// Returns true if a Tail describes the remaining motion up to rounding: slip, spin or remaining time is negligible.
bool in_tail(const Ballistics& ball, const Values& x, double t) {
  const double v = ball.slip(x);
  const double omega = ball.spin(x);
  const double sliding = ball.slip_time_left(v);
  const double pivoting = ball.spin_time_left(omega);
  return v <= 1e-17 * ball.eps * omega || pivoting <= 1e-18 * sliding || sliding + pivoting <= 1e-14 * t;
}

/// Returns the length of the step from `before` to k = 1, and the state there.
double step_to_kink(const Ballistics& ball, const Values& before, double t, double longest, Values& end) {
  CashKarp base;
  const auto passes = [&](double length) {
    base.do_step(std::cref(ball), before, t, end, length);
    return ball.log_ratio(end) <= 0;
  };
  const double length = reduction::last_where(passes, longest, 0);
  passes(length);
  return length;
}

MotionPoint point_of(const Ballistics& ball, const Ball& body, const Values& x, double t) {
  const double length = ball.speed_scale * ball.time_scale;
  MotionPoint point{t, {x[5] * length, x[6] * length}, ball.velocity(x), ball.angular_velocity(x), ball.slip(x), 0};
  point.angular_velocity.z() += 0.0;  // avoids -0
  point.energy = kinetic_energy(body, {point.velocity, point.angular_velocity});
  return point;
}

std::vector<Eigen::Index> increasing(const Eigen::ArrayXd& times) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(times.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return times[i]; });
  return order;
}

/// The result of an integration: states, times and lengths until the stop.
struct Integration {
  MotionColumns points;
  double stop_time = 0;    ///< s
  double slip_length = 0;  ///< m
  double spin_angle = 0;   ///< angle about the vertical, rad
  long steps = 0;
};

/// Integrates in SI units the equations of motion (2.5) of a ball, or of a body that lies flat, under any friction law,
/// together with its position. The integration is independent of the reduction and of the first integrals.
///
/// The variables are omega_x, omega_y and the position. The velocity of the contact point is replaced by ln v and the
/// direction of v, and omega_z by ln |omega_z|, like the variables of Zh98 before (2.6). Logarithms cannot step through
/// the stop. Once force or moment is negligible, the exact limit replaces the remaining steps. Beyond the stop the ball
/// rolls.
///
/// @param times  times, s, >= 0, in any order
Integration integrate(const Experiment& experiment, const reduction::Law& law, const Eigen::ArrayXd& times) {
  for (double t : times) {
    if (t >= 0 && std::isfinite(t)) continue;
    throw std::domain_error(fmt::format("Motion::in_steps: times must be finite and >= 0, in s; got {}", t));
  }
  Integration motion{MotionColumns(times.size())};
  const Velocities start = velocities_of(experiment.start);
  const Vector2d contact = slip_velocity_at_start(experiment);
  const double v0 = slip_at_start(experiment);
  const double spin = spin_at_start(experiment);
  if (v0 == 0 && spin == 0) {
    for (Eigen::Index i = 0; i < times.size(); ++i) {
      motion.points.set(i, {times[i], start.velocity * times[i], start.velocity, start.angular_velocity, 0,
                            kinetic_energy(experiment.ball, start)});
    }
    return motion;
  }

  const double R = experiment.ball.radius;
  const auto [chi, gamma] = experiment.ball.body.inertia;
  Ballistics ball{.law = law,
                  .R = R,
                  .tilting = chi - 1,
                  .J_z = R * R / gamma,
                  .normal_friction = experiment.contact.friction * pressing(experiment.environment),
                  .eps = patch_radius_of(experiment, law),
                  .turn = std::copysign(1.0, spin),
                  .along = v0 > 0 ? Vector2d(contact / v0) : Vector2d(1, 0),
                  .speed_scale = std::max({start.velocity.norm(), R * start.angular_velocity.norm()}),
                  .time_scale = 1,
                  .slip_scale = 1};
  ball.time_scale = ball.slip_time_left(v0) + ball.spin_time_left(std::abs(spin));
  if (v0 > 0) ball.slip_scale = v0 * ball.slip_time_left(v0);
  const double speed = ball.speed_scale;
  Values x{std::log(v0 / speed),
           0,
           std::log(R * std::abs(spin) / speed),
           R * start.angular_velocity.x() / speed,
           R * start.angular_velocity.y() / speed,
           0,
           0,
           0,
           0};

  auto stepper = odeint::make_controlled(tolerance, 0.0, CashKarp());
  const std::vector<Eigen::Index> order = increasing(times);
  auto next = order.begin();
  double t = 0;  // time in units of time_scale
  double step = 1e-3 * std::min(1.0, ball.slip_time_left(std::max(v0, R * std::abs(spin))) / ball.time_scale);
  const double T = ball.time_scale;
  while (!in_tail(ball, x, t * T)) {
    if (motion.steps == step_limit) {
      throw std::runtime_error(fmt::format("Motion::in_steps: {} steps were not enough to reach the stop", step_limit));
    }
    while (next != order.end() && times[*next] / T <= t) {
      motion.points.set(*next, point_of(ball, experiment.ball, x, times[*next]));
      ++next;
    }
    const double wanted = next == order.end() ? std::numeric_limits<double>::infinity() : times[*next] / T;
    double trial = std::min(step, wanted - t);
    const bool cut = trial < step;
    const Values before = x;
    const double t_before = t;
    double taken = trial;
    while (stepper.try_step(std::cref(ball), x, t, trial) == odeint::fail) {
      if (!(trial > std::numeric_limits<double>::min())) {
        throw std::runtime_error("Motion::in_steps: the step size fell to nothing: the friction law is not a number");
      }
      taken = trial;
    }
    for (double value : x) {
      if (std::isnan(value)) throw std::runtime_error("Motion::in_steps: the friction law gave no number");
    }
    step = cut && t >= wanted ? std::max(step, trial) : trial;
    if (ball.log_ratio(before) > 0 && ball.log_ratio(x) < 0) {
      // Laws have a kink at k = 1, so a step ends there.
      taken = step_to_kink(ball, before, t_before, taken, x);
      t = t_before + taken;
    }
    ++motion.steps;
  }
  const Tail tail(ball, x, t * T);
  for (; next != order.end(); ++next) {
    // Rounding may place a requested time just before the end of the last step.
    const double at = std::max(times[*next], t * T);
    motion.points.set(*next, point_of(ball, experiment.ball, tail.at_time(at), times[*next]));
  }
  motion.stop_time = tail.stop();
  const Values end = tail.at_time(tail.stop());
  motion.slip_length = end[7] * ball.slip_scale;
  motion.spin_angle = ball.turn * end[8] * speed * T / R;
  return motion;
}

class InSteps final : public Motion::Solution {
 public:
  InSteps(const Experiment& of, const reduction::Law& law) : Solution(of), law_(law), whole_(integrate(of, law, {})) {}

  MotionPoint at(double t) const override { return at_times(Eigen::ArrayXd::Constant(1, t)).row(0); }
  MotionColumns at_times(const Eigen::ArrayXd& times) const override {
    return integrate(experiment, law_, times).points;
  }
  double stop_time() const override { return whole_.stop_time; }
  double slip_length() const override { return whole_.slip_length; }
  double spin_angle() const override { return whole_.spin_angle; }
  long steps() const override { return whole_.steps; }

 private:
  reduction::Law law_;
  Integration whole_;
};

}  // namespace

SolvedMotion undriven_motion_in_steps(const Experiment& experiment, const reduction::Law& law) {
  require_experiment(experiment);
  return std::make_shared<InSteps>(experiment, law);
}

}  // namespace contensou::si
