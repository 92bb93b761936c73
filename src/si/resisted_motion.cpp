// Notation: c slip, W rolling velocity R (omega_y, -omega_x), V = c + W that of the centre, w = eps |omega_z|,
// k = |c|/w, e = c/|c|, a = u_r g. Friction and rolling resistance give (reduction/README.md, (R53))
//   V' = -f g Phi e,   W' = (chi - 1) f g Phi e - chi a W/|W|,   c' = V' - W'
#include "contensou/si/resisted_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <boost/math/tools/roots.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_cash_karp54.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/si/scaling.hpp"

namespace contensou::si {

namespace {

namespace odeint = boost::numeric::odeint;
using Eigen::Vector2d;
using reduction::Flow;
using reduction::Law;
using reduction::Orbit;
using reduction::ReducedSystem;

/// A root of a function of time that has different signs at both ends.
template <class Function>
double crossing(Function function, double low, double high) {
  const double at_low = function(low), at_high = function(high);
  if (at_low == 0) return low;
  if (at_high == 0) return high;
  std::uintmax_t most = 200;
  const auto [left, right] = boost::math::tools::toms748_solve(function, low, high, at_low, at_high,
                                                               boost::math::tools::eps_tolerance<double>(50), most);
  return left + (right - left) / 2;
}

/// One instant, with what has passed since the start.
struct State {
  Vector2d slip, rolling;
  double spin;  ///< rad/s
  Vector2d position = {0, 0};
  double slip_length = 0, turned = 0, path = 0;
  double rolled = 0;  ///< the integral of |W|

  Vector2d velocity() const { return slip + rolling; }

  /// It has gone so far, in m, and rolled so far.
  void advance(double way, double rolled_way, const Vector2d& along) {
    position += way * along;
    path += way;
    rolled += rolled_way;
  }
};

/// So many seconds after a ball that no longer slides rolled as it does in `from`.
/// @param resisting  u_r g
State braked(const State& from, double seconds, double resisting, const Vector2d& along) {
  State now = from;
  now.slip.setZero();
  const double speed = from.rolling.norm();
  const double whole = speed / resisting, rolling = std::min(seconds, whole);
  const double way = (speed - resisting * rolling / 2) * rolling;
  now.rolling = rolling < whole ? Vector2d((speed - resisting * rolling) * along) : Vector2d(0, 0);
  now.advance(way, way, along);
  return now;
}

/// What does not change.
struct Given {
  Given(const Experiment& given, const Law& of_law, double rolling_friction)
      : experiment(given),
        law(of_law),
        radius(given.ball.radius),
        patch(patch_radius_of(given, of_law)),
        inertia(given.ball.body.inertia),
        drive(rolling_friction / given.contact.friction),
        sliding(given.contact.friction * given.environment.gravity),
        resisting(rolling_friction * given.environment.gravity) {}

  /// Whether friction turns a ball that does not turn.
  bool turns(double slip, double spin) const {
    const double k_force = slip > 0 ? law({slip, patch * std::abs(spin)}).force : 0;
    return (inertia.chi - 1) * k_force > inertia.chi * drive;
  }

  double tau_per_second() const { return 1 / seconds(experiment, 1); }

  Experiment experiment;
  Law law;
  double radius, patch;
  reduction::Inertia inertia;
  double drive;      ///< u_r/f
  double sliding;    ///< f g
  double resisting;  ///< u_r g
};

}  // namespace

/// How a motion is known.
class ResistedMotion::Course {
 public:
  Course(const Experiment& experiment, const Law& law, double rolling_friction)
      : body_(experiment, law, rolling_friction) {}
  Course(const Course&) = delete;
  Course& operator=(const Course&) = delete;
  virtual ~Course() = default;

  virtual bool is_reduced() const = 0;
  virtual std::optional<double> creep_ratio() const = 0;
  virtual State at(double t) const = 0;

  const Given& body() const { return body_; }
  double stop() const { return stop_; }
  double rest() const { return rest_; }

  double slip_time(double speed) const {
    const auto excess = [&](double t) { return at(t).slip.norm() - speed; };
    for (auto knot = knots_.rbegin(); knot != knots_.rend(); ++knot) {
      if (excess(*knot) <= 0) continue;
      return knot == knots_.rbegin() ? *knot : crossing(excess, *knot, *std::prev(knot));
    }
    return 0;
  }

 protected:
  Given body_;
  std::vector<double> knots_;  ///< s, increasing, to the stop; between two of them slip has one maximum at most
  double stop_ = 0, rest_ = 0;
};

namespace {

/// A ball that rolls the way it slides.
class Straight final : public ResistedMotion::Course {
 public:
  Straight(const Experiment& experiment, const Law& law, double rolling_friction, const State& start,
           const Vector2d& along)
      : Course(experiment, law, rolling_friction), along_(along) {
    State here = start;
    double t = 0;
    const double slip = here.slip.norm();
    if (here.rolling.norm() > 0 || body_.turns(slip, here.spin)) {
      if (slip > 0 || here.spin != 0) {
        const Flow driven = flow(body_.inertia, body_.drive);
        const auto& end = driven.terminal().end_of(1);
        if (here.spin != 0 && end.regime == reduction::TerminalRegime::ray) creep_ratio_ = end.k;
        add(t, Kind::turns, here, driven.orbit({body_.radius * here.spin, slip}));
        const double stop = seconds(body_.experiment, pieces_.back().orbit->stop_time());
        const auto turning = [&](double at_t) { return at(at_t).rolling.dot(along_); };
        constexpr double first = 1e-9;
        t = turning(stop) < 0 ? crossing(turning, start.rolling.norm() > 0 ? 0 : first * stop, stop) : stop;
        here = at(t);
        if (t < stop) {
          here.rolling.setZero();
        } else {
          here.slip.setZero();
          here.spin = 0;
        }
        sample(0, t);
      }
      if (here.rolling.norm() > 0) {
        stop_ = t;
        rest_ = t + here.rolling.norm() / body_.resisting;
        add(t, Kind::rolls, here, {});
        return;
      }
    }
    const reduction::Inertia puck{.chi = 1, .gamma = body_.inertia.gamma};
    const double faster = here.slip.norm();
    add(t, Kind::held, here, flow(puck, 0).orbit({body_.radius * here.spin, faster}));
    const Orbit& held = *pieces_.back().orbit;
    stop_ = t + seconds(body_.experiment, held.stop_time());
    rest_ = here.spin == 0 ? stop_ : t + seconds(body_.experiment, held.time_of_v(resting_slip));
    sample(t, stop_);
  }

  bool is_reduced() const override { return true; }
  std::optional<double> creep_ratio() const override { return creep_ratio_; }

  State at(double t) const override {
    const auto after = std::ranges::upper_bound(pieces_, t, {}, &Piece::t);
    const Piece& piece = after == pieces_.begin() ? *after : *std::prev(after);
    const double passed = t - piece.t;
    if (piece.kind == Kind::rolls) return braked(piece.start, passed, body_.resisting, along_);
    State now = piece.start;
    const double v0 = now.slip.norm(), W0 = now.rolling.norm();
    const double tau = std::min(passed * body_.tau_per_second(), piece.orbit->stop_time());
    const Orbit::Instant instant = piece.orbit->instant(tau);
    const double slid = seconds(body_.experiment, instant.slip_length);
    now.slip = instant.v * along_;
    now.spin = instant.u / body_.radius;
    now.slip_length += slid;
    now.turned += seconds(body_.experiment, instant.turned) / body_.radius;
    double way = slid;
    if (piece.kind == Kind::turns) {
      const double chi = body_.inertia.chi;
      const double centre = v0 + W0 - (v0 - instant.v) / chi - body_.resisting * passed;
      way = (v0 + W0) * passed - (v0 * passed - slid) / chi - body_.resisting * passed * passed / 2;
      now.rolling = (centre - instant.v) * along_;
    }
    now.advance(way, way - slid, along_);
    return now;
  }

 private:
  enum class Kind { turns, held, rolls };
  struct Piece {
    double t;
    Kind kind;
    State start;
    std::optional<Orbit> orbit;
  };

  Flow flow(reduction::Inertia inertia, double drive) const {
    const double counts = drive < ReducedSystem::least_drive ? 0 : drive;
    return ReducedSystem(body_.law, body_.patch / body_.radius, inertia, counts);
  }

  void add(double t, Kind kind, const State& start, std::optional<Orbit> orbit) {
    pieces_.push_back({t, kind, start, std::move(orbit)});
  }

  void sample(double from, double to) {
    constexpr int count = 64;
    for (int i = 0; i <= count; ++i) knots_.push_back(from + (to - from) * i / count);
  }

  Vector2d along_;
  std::vector<Piece> pieces_;
  std::optional<double> creep_ratio_;
};

/// c, W, w, x, slip length, turned, path, rolled; speeds over that of the start, lengths over it times a second.
using Progress = std::array<double, 11>;

/// Any ball.
class Integrated final : public ResistedMotion::Course {
 public:
  Integrated(const Experiment& experiment, const Law& law, double rolling_friction, const State& start)
      : Course(experiment, law, rolling_friction), turn_(std::copysign(1.0, start.spin)) {
    run(start);
  }

  bool is_reduced() const override { return false; }
  std::optional<double> creep_ratio() const override { return std::nullopt; }

  State at(double t) const override {
    if (t >= stop_) return after_stop(t);
    const auto after = std::ranges::upper_bound(steps_, t, {}, &Step::t);
    const Step& step = *std::prev(after);
    Progress x = step.x;
    const bool held = step.held;
    odeint::runge_kutta_cash_karp54<Progress>().do_step(
        [&](const Progress& at_x, Progress& rate, double) { equations(at_x, rate, held); }, x, step.t, t - step.t);
    return state_of(x);
  }

 private:
  struct Step {
    double t;
    Progress x;
    bool held;
  };

  void equations(const Progress& x, Progress& rate, bool held) const {
    const Vector2d slip(x[0], x[1]), rolling(x[2], x[3]);
    const double v = slip.norm(), rim = std::max(x[4], 0.0), turning = rolling.norm();
    const auto [phi, psi] = v > 0 || rim > 0 ? body_.law({v, rim}) : reduction::Resistance{0, 0};
    const Vector2d e = v > 0 ? Vector2d(slip / v) : Vector2d(0, 0);
    const Vector2d heading = turning > 0 ? Vector2d(rolling / turning) : e;
    const double chi = body_.inertia.chi;
    const Vector2d centre = -body_.sliding * phi * e;
    const Vector2d roll = held ? Vector2d(0, 0) : Vector2d((1 - chi) * centre - chi * body_.resisting * heading);
    const Vector2d contact = centre - roll;
    const double mu = body_.patch / body_.radius;
    const Vector2d velocity = slip + rolling;
    rate = {
        contact.x(),  contact.y(),  roll.x(), roll.y(),          -body_.inertia.gamma * mu * mu * body_.sliding * psi,
        velocity.x(), velocity.y(), v,        rim / body_.patch, velocity.norm(),
        turning};
  }

  State state_of(const Progress& x) const {
    return {{x[0], x[1]}, {x[2], x[3]}, turn_ * std::max(x[4], 0.0) / body_.patch, {x[5], x[6]}, x[7], turn_ * x[8],
            x[9],         x[10]};
  }

  State after_stop(double t) const {
    State now = state_of(steps_.back().x);
    now.slip.setZero();
    now.spin = 0;
    const double speed = now.rolling.norm();
    if (speed == 0) return now;
    return braked(now, t - stop_, body_.resisting, now.rolling / speed);
  }

  void run(const State& start) {
    constexpr double tolerance = 1e-12;
    constexpr double nothing = 1e-9;  // of the speeds at the start
    constexpr long step_limit = 2'000'000;
    const double rim0 = body_.patch * std::abs(start.spin);
    const double size = start.slip.norm() + start.rolling.norm() + rim0;
    Progress x{start.slip.x(), start.slip.y(), start.rolling.x(), start.rolling.y(), rim0, 0, 0, 0, 0, 0, 0};
    bool held = false;
    double t = 0;
    double step = 1e-4 * size / body_.sliding;
    auto stepper = odeint::make_controlled(tolerance * size, tolerance, odeint::runge_kutta_cash_karp54<Progress>());
    for (long steps = 0;; ++steps) {
      const double v = std::hypot(x[0], x[1]), turning = std::hypot(x[2], x[3]);
      // The torque of friction turns a ball that stands, or resistance holds it.
      const bool moved = body_.turns(v, x[4] / body_.patch);
      if (turning <= nothing * size && !moved) held = true;
      if (held && moved) held = false;
      if (held) x[2] = x[3] = 0;
      steps_.push_back({t, x, held});
      knots_.push_back(t);
      if (v + std::max(x[4], 0.0) <= nothing * size) break;
      if (steps == step_limit)
        throw std::runtime_error(fmt::format("ResistedMotion: {} steps were not enough to reach the stop", steps));
      const double before = t;
      double trial = std::min(step, (v + x[4]) / body_.sliding);
      while (stepper.try_step([&](const Progress& at_x, Progress& rate, double) { equations(at_x, rate, held); }, x, t,
                              trial) == odeint::fail) {
        if (!(trial > std::numeric_limits<double>::min()) || std::isnan(trial))
          throw std::runtime_error("ResistedMotion: the step size fell to nothing: the friction law is not a number");
      }
      step = std::max(trial, t - before);
    }
    stop_ = t;
    const double turning = std::hypot(x[2], x[3]);
    rest_ = turning > 0 ? stop_ + turning / body_.resisting : start.spin == 0 ? stop_ : slip_time(resting_slip);
  }

  double turn_;
  std::vector<Step> steps_;
};

std::shared_ptr<const ResistedMotion::Course> course_of(const Experiment& experiment, const Law& law,
                                                        double rolling_friction, bool in_steps) {
  require_experiment(experiment);
  if (experiment.ball.body.lies_flat())
    throw std::domain_error("a body that lies flat never rolls: it has no rolling friction");
  if (!(rolling_friction > 0 && std::isfinite(rolling_friction)))
    throw std::domain_error(fmt::format("ResistedMotion: rolling friction > 0 is required, got {}", rolling_friction));
  const auto [velocity, angular_velocity] = velocities_of(experiment.start);
  const Vector2d slip = slip_at_start(experiment) > 0 ? slip_velocity_at_start(experiment) : Vector2d(0, 0);
  const State start{.slip = slip, .rolling = velocity - slip, .spin = angular_velocity.z()};
  const double v = slip.norm(), turning = start.rolling.norm();
  constexpr double parallel = 1e-12;
  const Vector2d along = v > 0 ? Vector2d(slip / v) : turning > 0 ? Vector2d(start.rolling / turning) : Vector2d(1, 0);
  const bool straight = start.rolling.dot(along) >= (1 - parallel) * turning;
  // A puck's k falls to the end.
  const Given body(experiment, law, rolling_friction);
  const double mu = body.patch / body.radius;
  const bool held_to_the_end = body.inertia.gamma * mu * mu <= law.force_slope() / law.pivoting_moment();
  if (!in_steps && straight && held_to_the_end && body.drive < 1)
    return std::make_shared<Straight>(experiment, law, rolling_friction, start, along);
  return std::make_shared<Integrated>(experiment, law, rolling_friction, start);
}

}  // namespace

ResistedMotion::ResistedMotion(const Experiment& experiment, const Law& law, double rolling_friction, bool in_steps)
    : course_(course_of(experiment, law, rolling_friction, in_steps)) {}

bool ResistedMotion::is_reduced() const { return course_->is_reduced(); }

std::optional<double> ResistedMotion::creep_ratio() const { return course_->creep_ratio(); }

MotionPoint ResistedMotion::at_time(double t) const {
  if (!(t >= 0)) throw std::domain_error(fmt::format("ResistedMotion::at_time: t must be >= 0, in s; got {}", t));
  const State now = course_->at(t);
  const double radius = course_->body().radius;
  const Vector2d velocity = now.velocity();
  MotionPoint point{
      .t = t,
      .position = now.position,
      .velocity = velocity,
      .angular_velocity = {(0 - now.rolling.y()) / radius, now.rolling.x() / radius + 0.0, now.spin + 0.0},
      .slip = now.slip.norm(),
      .energy = 0};
  point.energy = kinetic_energy(course_->body().experiment.ball, {point.velocity, point.angular_velocity});
  return point;
}

double ResistedMotion::stop_time() const { return course_->stop(); }

double ResistedMotion::spin_end() const { return spin_at_start(course_->body().experiment) == 0 ? 0 : course_->stop(); }

double ResistedMotion::slip_time(double speed) const {
  if (!(speed >= 0))
    throw std::domain_error(fmt::format("ResistedMotion::slip_time: speed >= 0 is required, got {}", speed));
  return speed == 0 ? course_->stop() : course_->slip_time(speed);
}

double ResistedMotion::rest_time() const { return course_->rest(); }

Vector2d ResistedMotion::rest_position() const { return course_->at(course_->rest()).position; }

double ResistedMotion::slip_length() const { return course_->at(course_->stop()).slip_length; }

double ResistedMotion::spin_angle() const { return course_->at(course_->stop()).turned; }

double ResistedMotion::rolling_loss() const {
  const Given& body = course_->body();
  const double end = std::max(course_->stop(), course_->rest());
  const double chi = body.inertia.chi;
  return chi / (chi - 1) * body.experiment.ball.mass * body.resisting * course_->at(end).rolled;
}

double ResistedMotion::path_length(double t) const { return course_->at(t).path; }

}  // namespace contensou::si
