// Notation: c slip, W rolling velocity R (omega_y, -omega_x), V = c + W that of the centre, w = eps |omega_z|,
// k = |c|/w, e = c/|c|, a = u_r g, d the pull of a slope; on one g stands for g cos(alpha). Friction, rolling resistance and
// the pull give (reduction/README.md, (R53), (R54))
//   V' = -f g Phi e + d,   W' = (chi - 1) f g Phi e - chi a W/|W|,   c' = V' - W'
#include "contensou/si/resisted_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation/generation_runge_kutta_cash_karp54.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/root.hpp"
#include "contensou/si/scaling.hpp"
#include "pure_rolling.hpp"

namespace contensou::si {

namespace {

namespace odeint = boost::numeric::odeint;
using Eigen::Vector2d;
using reduction::Flow;
using reduction::Law;
using reduction::Orbit;
using reduction::ReducedSystem;

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

/// So many seconds after what no longer slides nor spins was as it is in `from`.
State rolled_on(const State& from, double seconds, const PureRolling& rolling) {
  const PureRolling::Here here = rolling.after(seconds);
  State now = from;
  now.slip.setZero();
  now.spin = 0;
  now.rolling = here.velocity;
  now.position += here.way;
  now.path += here.path;
  now.rolled += here.path;
  return now;
}

/// What does not change.
struct Given {
  Given(const Experiment& given, const Law& of_law, std::shared_ptr<ResistedFlows> known)
      : experiment(given),
        law(of_law),
        radius(given.ball.radius),
        patch(patch_radius_of(given, of_law)),
        inertia(given.ball.body.inertia),
        drive(given.contact.rolling_friction / given.contact.friction),
        sliding(given.contact.friction * pressing(given.environment)),
        resisting(given.contact.rolling_friction * pressing(given.environment)),
        down(pull(given.environment)),
        flows(known ? std::move(known) : std::make_shared<ResistedFlows>()) {}

  /// Phi up to which rolling resistance keeps a ball that does not turn from turning: of a body that lies flat any.
  double holding() const {
    return experiment.ball.body.lies_flat() ? std::numeric_limits<double>::infinity()
                                            : inertia.chi * drive / (inertia.chi - 1);
  }

  /// Whether friction turns a ball that does not turn.
  bool turns(double slip, double spin) const {
    if (holding() == 0) return true;
    const double k_force = slip > 0 ? law({slip, patch * std::abs(spin)}).force : 0;
    return k_force > holding();
  }

  /// What follows when it neither slides nor spins.
  PureRolling rolling_on(const State& from) const {
    const Vector2d rolls = (1 - 1 / inertia.chi) * down;
    return {from.rolling, rolls, experiment.ball.body.lies_flat() ? 0 : resisting};
  }

  /// s for which friction keeps it from sliding then.
  double rolls_for(const PureRolling& rolling) const {
    return rolling.slides_after(sliding, down.norm() / inertia.chi);
  }

  /// The direction of a slip v that is slow beside rolling. From c' = chi (N - f g e), N = d/chi + a W/|W|, it follows that
  /// of N = |N| n, late by v n'/(chi |N|).
  Vector2d following(double v, const Vector2d& rolling) const {
    const Vector2d heading = rolling.normalized(), needed = down / inertia.chi + resisting * heading;
    const Vector2d n = needed.normalized();
    const Vector2d change = (inertia.chi - 1) * sliding * n - inertia.chi * resisting * heading;
    const auto across = [](const Vector2d& of, const Vector2d& unit) { return Vector2d(of - of.dot(unit) * unit); };
    const Vector2d turns = resisting * across(across(change, heading) / rolling.norm(), n) / needed.norm();
    return (n - v / (inertia.chi * needed.norm()) * turns).normalized();
  }

  double tau_per_second() const { return 1 / seconds(experiment, 1); }

  Experiment experiment;
  Law law;
  double radius, patch;
  reduction::Inertia inertia;
  double drive;      ///< u_r/f
  double sliding;    ///< f g
  double resisting;  ///< u_r g
  Vector2d down;     ///< m/s^2, the pull
  std::shared_ptr<ResistedFlows> flows;
};

}  // namespace

Flow ResistedFlows::of(bool turning, const std::function<Flow()>& made) {
  const std::lock_guard lock(guard_);
  auto& flow = turning ? turning_ : held_;
  if (!flow) flow = made();
  return *flow;
}

reduction::OrbitPoint state_at(const std::vector<ReducedPiece>& pieces, double tau) {
  double beta = 0;
  for (std::size_t i = 0;; ++i) {
    const ReducedPiece& piece = pieces[i];
    const bool last = i + 1 == pieces.size();
    if (!last && tau >= pieces[i + 1].tau) {
      beta += piece.orbit.at_time(pieces[i + 1].tau - piece.tau).beta;
      continue;
    }
    reduction::OrbitPoint point = piece.orbit.at_time(std::max(0.0, tau - piece.tau));
    point.tau = tau;
    point.beta += beta;
    return point;
  }
}

reduction::OrbitPoint state_at_time_left(const std::vector<ReducedPiece>& pieces, double left) {
  const ReducedPiece& last = pieces.back();
  const double stop = stop_time(pieces), tau = stop - left;
  if (!(left >= 0 && tau >= 0))
    throw std::domain_error(fmt::format("state_at_time_left: 0 to {} is allowed, got {}", stop, left));
  if (!(left <= last.orbit.stop_time())) return state_at(pieces, tau);
  reduction::OrbitPoint point = last.orbit.at_time_left(left);
  point.tau = tau;
  if (pieces.size() > 1) point.beta += state_at(pieces, last.tau).beta;
  return point;
}

/// How a motion is known.
class ResistedMotion::Course {
 public:
  explicit Course(Given given) : body_(std::move(given)) {}
  Course(const Course&) = delete;
  Course& operator=(const Course&) = delete;
  virtual ~Course() = default;

  virtual bool is_reduced() const = 0;
  virtual std::optional<double> creep_ratio() const = 0;
  virtual State at(double t) const = 0;
  virtual std::vector<ReducedPiece> pieces() const { return {}; }

  const Given& body() const { return body_; }
  double stop() const { return stop_; }
  double rest() const { return rest_; }

  double slip_time(double speed) const {
    const auto excess = [&](double t) { return at(t).slip.norm() - speed; };
    for (auto knot = knots_.rbegin(); knot != knots_.rend(); ++knot) {
      if (excess(*knot) <= 0) continue;
      return knot == knots_.rbegin() ? *knot : reduction::root_between(excess, *knot, *std::prev(knot));
    }
    return 0;
  }

 protected:
  Given body_;
  std::vector<double> knots_;  ///< s, increasing, to the stop; between two of them slip has one maximum at most
  double stop_ = 0, rest_ = 0;
};

namespace {

/// A drive of 1 or more, under which sliding alone does not end.
struct DrivenOut {};

/// A ball that slides the way it rolls, straight down if there is a slope, in pieces: while it turns, while resistance
/// holds it, and when it slides no more.
class Straight final : public ResistedMotion::Course {
 public:
  Straight(Given given, const State& start, const Vector2d& along)
      : Course(std::move(given)), along_(along), drives_(drives_along(body_.experiment, along, body_.inertia.chi)) {
    State here = start;
    double t = 0;
    bool turning = here.rolling.norm() > 0 || body_.turns(here.slip.norm(), here.spin);
    while (here.slip.norm() > 0 || here.spin != 0) {
      const Flow driven = flow(turning);
      const auto end = driven.terminal().end_of(1);
      const bool creeps = here.spin != 0 && driven.system().drive() > 0 && end.regime == reduction::TerminalRegime::ray;
      if (creeps && (pieces_.empty() || !pieces_.front().turns)) creep_ratio_ = end.k;
      const reduction::State speeds{body_.radius * here.spin, here.slip.norm()};
      pieces_.push_back({t, turning, here, driven.system(), speeds, driven.orbit(speeds)});
      const Piece& piece = pieces_.back();
      const double stop = t + seconds(body_.experiment, piece.orbit.stop_time());
      // What begins to turn goes on to (R55).
      const bool goes_on = turning && pieces_.size() > 1;
      const std::optional<double> changes = goes_on   ? std::nullopt
                                            : turning ? ceases_to_turn(piece, stop)
                                                      : begins_to_turn(piece);
      const double until = changes.value_or(stop);
      sample(t, until);
      here = at(until);
      t = until;
      if (!changes) break;
      if (turning) here.rolling.setZero();
      turning = !turning;
    }
    stop_ = t;
    here.slip.setZero();
    here.spin = 0;
    const bool held = !pieces_.empty() && !pieces_.back().turns;
    if (held) here.rolling.setZero();
    last_ = here;
    rolls_.emplace(body_.rolling_on(here));
    if (std::isfinite(body_.rolls_for(*rolls_))) throw DrivenOut();
    rest_ = stop_ + rolls_->rest_time();
    if (held && rest_ == stop_ && start.spin != 0)
      rest_ = pieces_.back().t + seconds(body_.experiment, pieces_.back().orbit.time_of_v(resting_slip));
  }

  bool is_reduced() const override { return true; }
  std::optional<double> creep_ratio() const override { return creep_ratio_; }

  std::vector<ReducedPiece> pieces() const override {
    std::vector<ReducedPiece> result;
    for (const Piece& piece : pieces_)
      result.push_back({piece.t * body_.tau_per_second(), piece.turns, piece.system, piece.speeds, piece.orbit});
    return result;
  }

  State at(double t) const override {
    if (rolls_ && t >= stop_) return rolled_on(last_, t - stop_, *rolls_);
    const auto after = std::ranges::upper_bound(pieces_, t, {}, &Piece::t);
    const Piece& piece = after == pieces_.begin() ? *after : *std::prev(after);
    const double passed = std::max(0.0, t - piece.t);
    State now = piece.start;
    const double v0 = now.slip.norm(), W0 = now.rolling.norm();
    const double tau = std::min(passed * body_.tau_per_second(), piece.orbit.stop_time());
    const Orbit::Instant instant = piece.orbit.instant(tau);
    const double slid = seconds(body_.experiment, instant.slip_length);
    now.slip = instant.v * along_;
    now.spin = instant.u / body_.radius;
    now.slip_length += slid;
    now.turned += seconds(body_.experiment, instant.turned) / body_.radius;
    double way = slid;
    if (piece.turns) {
      const double chi = body_.inertia.chi;
      const double slowing = body_.resisting - (1 - 1 / chi) * body_.down.dot(along_);
      const double centre = v0 + W0 - (v0 - instant.v) / chi - slowing * passed;
      way = (v0 + W0) * passed - (v0 * passed - slid) / chi - slowing * passed * passed / 2;
      now.rolling = (centre - instant.v) * along_;
    }
    now.advance(way, way - slid, along_);
    return now;
  }

 private:
  struct Piece {
    double t;
    bool turns;
    State start;
    ReducedSystem system;
    reduction::State speeds;
    Orbit orbit;
  };

  /// @throws DrivenOut
  Flow flow(bool turning) const {
    const reduction::Inertia puck{.chi = 1, .gamma = body_.inertia.gamma};
    const double drive = turning ? drives_.turning() : drives_along(body_.experiment, along_, puck.chi).slope;
    if (drive >= 1) throw DrivenOut();
    return body_.flows->of(turning, [&] {
      const double counts = drive < ReducedSystem::least_drive ? 0 : drive;
      return Flow(ReducedSystem(body_.law, body_.patch / body_.radius, turning ? body_.inertia : puck, counts));
    });
  }

  /// s at which a piece passes the k at which friction is what resistance holds.
  std::optional<double> passes_holding(const Piece& piece) const {
    const double force = body_.holding();
    if (!(force > 0 && force < 1) || piece.orbit.on_axis()) return std::nullopt;
    constexpr double far = 100;
    const auto excess = [&](double ln_k) { return body_.law(reduction::slip_of_ratio(std::exp(ln_k))).force - force; };
    if (excess(-far) >= 0 || excess(far) <= 0) return std::nullopt;
    const double ln_k = reduction::root_between(excess, -far, far);
    const auto [low, high] = std::minmax({piece.orbit.start_log_ratio(), piece.orbit.chart().log_terminal_ratio()});
    if (!(low < ln_k && ln_k < high)) return std::nullopt;
    return piece.t + seconds(body_.experiment, piece.orbit.at_log_ratio(ln_k).tau);
  }

  /// s at which rolling ends before slip and spin do.
  std::optional<double> ceases_to_turn(const Piece& piece, double stop) const {
    if (body_.resisting == 0) return std::nullopt;
    const auto turning = [&](double t) { return at(t).rolling.dot(along_); };
    // Between these it does nothing but grow, or fall.
    constexpr double first = 1e-9;
    double from = piece.start.rolling.norm() > 0 ? piece.t : piece.t + first * (stop - piece.t);
    for (const double to : {passes_holding(piece).value_or(from), stop}) {
      if (turning(to) < 0) return turning(from) > 0 ? reduction::root_between(turning, from, to) : from;
      from = to;
    }
    return std::nullopt;
  }

  /// s at which friction begins to turn what resistance held.
  std::optional<double> begins_to_turn(const Piece& piece) const {
    const auto t = passes_holding(piece);
    return t && piece.orbit.start_log_ratio() < piece.orbit.chart().log_terminal_ratio() ? t : std::nullopt;
  }

  void sample(double from, double to) {
    constexpr int count = 64;
    for (int i = 0; i <= count; ++i) knots_.push_back(from + (to - from) * i / count);
  }

  Vector2d along_;
  Drives drives_;
  std::vector<Piece> pieces_;
  State last_;
  std::optional<PureRolling> rolls_;
  std::optional<double> creep_ratio_;
};

/// c, W, w, x, slip length, turned, path, rolled; speeds over that of the start, lengths over it times a second.
using Progress = std::array<double, 11>;

/// Any ball.
class Integrated final : public ResistedMotion::Course {
 public:
  Integrated(Given given, const State& start) : Course(std::move(given)), turn_(std::copysign(1.0, start.spin)) {
    run(start);
  }

  bool is_reduced() const override { return false; }
  std::optional<double> creep_ratio() const override { return std::nullopt; }

  State at(double t) const override {
    const auto after = std::ranges::upper_bound(steps_, t, {}, &Step::t);
    const Step& step = *std::prev(after);
    if (step.rolls) return rolled_on(state_of(step), t - step.t, body_.rolling_on(state_of(step)));
    Step there = step;
    odeint::runge_kutta_cash_karp54<Progress>().do_step(
        [&](const Progress& x, Progress& rate, double) { equations(x, rate, step); }, there.x, step.t, t - step.t);
    return state_of(there);
  }

 private:
  struct Step {
    double t;
    Progress x;
    bool held = false, rolls = false;
    bool follows = false;  ///< c is (v, 0), its direction Given::following
  };

  Vector2d slip_of(const Progress& x, const Step& step) const {
    return step.follows ? Vector2d(x[0] * body_.following(x[0], {x[2], x[3]})) : Vector2d(x[0], x[1]);
  }

  void equations(const Progress& x, Progress& rate, const Step& step) const {
    const Vector2d slip = slip_of(x, step), rolling(x[2], x[3]);
    const double v = slip.norm(), rim = std::max(x[4], 0.0), turning = rolling.norm();
    const auto [phi, psi] = v > 0 || rim > 0 ? body_.law({v, rim}) : reduction::Resistance{1, 0};
    const Vector2d e = v > 0 ? Vector2d(slip / v) : step.follows ? body_.following(0, rolling) : Vector2d(0, 0);
    const Vector2d heading = turning > 0 ? Vector2d(rolling / turning) : e;
    const double chi = body_.inertia.chi;
    const Vector2d friction = -body_.sliding * phi * e;
    const Vector2d roll = step.held ? Vector2d(0, 0) : Vector2d((1 - chi) * friction - chi * body_.resisting * heading);
    const Vector2d contact = friction + body_.down - roll;
    const double mu = body_.patch / body_.radius;
    const Vector2d velocity = slip + rolling;
    rate = {
        contact.x(),  contact.y(),  roll.x(), roll.y(),          -body_.inertia.gamma * mu * mu * body_.sliding * psi,
        velocity.x(), velocity.y(), v,        rim / body_.patch, velocity.norm(),
        turning};
    if (step.follows) rate[0] = contact.dot(e), rate[1] = 0;
  }

  State state_of(const Step& step) const {
    const Progress& x = step.x;
    return {slip_of(x, step),
            {x[2], x[3]},
            turn_ * std::max(x[4], 0.0) / body_.patch,
            {x[5], x[6]},
            x[7],
            turn_ * x[8],
            x[9],
            x[10]};
  }

  void add(const Step& step) {
    steps_.push_back(step);
    knots_.push_back(step.t);
  }

  /// s after which v + w is 0 at the rate at which they fall now; infinity where they grow.
  double time_to_stop(const Step& step) const {
    Progress rate;
    equations(step.x, rate, step);
    const Vector2d slip(step.x[0], step.x[1]), change(rate[0], rate[1]);
    const double v = slip.norm(), rim = std::max(step.x[4], 0.0);
    const double falls = -rate[4] - (v > 0 ? slip.dot(change) / v : change.norm());
    return falls > 0 && v + rim > 0 ? (v + rim) / falls : std::numeric_limits<double>::infinity();
  }

  Progress progress_of(const State& state) const {
    return {state.slip.x(),
            state.slip.y(),
            state.rolling.x(),
            state.rolling.y(),
            body_.patch * std::abs(state.spin),
            state.position.x(),
            state.position.y(),
            state.slip_length,
            turn_ * state.turned,
            state.path,
            state.rolled};
  }

  void run(const State& start) {
    constexpr double tolerance = 1e-12;
    constexpr double nothing = 1e-9;  // of the speeds at the start
    constexpr double slow = 3e-4;     // of the speed of rolling
    constexpr long step_limit = 2'000'000;
    Step now{0, progress_of(start)};
    Progress& x = now.x;
    const double size = start.slip.norm() + start.rolling.norm() + x[4];
    double step = 1e-4 * size / body_.sliding;
    auto stepper = odeint::make_controlled(tolerance * size, tolerance, odeint::runge_kutta_cash_karp54<Progress>());
    for (long steps = 0;; ++steps) {
      const double v = std::hypot(x[0], x[1]), turning = std::hypot(x[2], x[3]);
      if (now.follows && v > std::max(slow * turning, nothing * size)) {
        x = progress_of(state_of(now));
        now.follows = false;
      }
      // The torque of friction turns a ball that stands, or resistance holds it.
      const bool moved = body_.turns(v, x[4] / body_.patch);
      if (turning <= nothing * size && !moved) now.held = true;
      if (now.held && moved) now.held = false;
      if (now.held) x[2] = x[3] = 0;
      if (v + std::max(x[4], 0.0) <= nothing * size) {
        State here = state_of(now);
        here.slip.setZero();
        here.spin = 0;
        const PureRolling rolling = body_.rolling_on(here);
        const double rolls = body_.rolls_for(rolling);
        if (rolls > 0) add({.t = now.t, .x = progress_of(here), .held = now.held, .rolls = true});
        if (std::isinf(rolls)) {
          stop_ = now.t;
          rest_ = stop_ + rolling.rest_time();
          break;
        }
        // Then it slides, first so slowly that the slip's own equation is stiff.
        if (rolls > 0 || !now.follows)
          now = {.t = now.t + rolls, .x = progress_of(rolled_on(here, rolls, rolling)), .follows = true};
      }
      add(now);
      if (steps == step_limit)
        throw std::runtime_error(fmt::format("ResistedMotion: {} steps were not enough to reach the stop", steps));
      const Step before = now;
      double trial = std::min(step, time_to_stop(now));
      while (stepper.try_step([&](const Progress& at_x, Progress& rate, double) { equations(at_x, rate, before); }, x,
                              now.t, trial) == odeint::fail) {
        if (!(trial > std::numeric_limits<double>::min()) || std::isnan(trial))
          throw std::runtime_error("ResistedMotion: the step size fell to nothing: the friction law is not a number");
      }
      step = std::max(trial, now.t - before.t);
      // Where friction begins to turn it a step ends.
      constexpr double short_enough = 1e-7;
      const bool turns_now = now.held && body_.turns(std::hypot(x[0], x[1]), x[4] / body_.patch);
      if (turns_now && now.t - before.t > short_enough * size / body_.sliding) {
        step = (now.t - before.t) / 4;
        now = before;
      }
    }
    if (rest_ == stop_ && start.spin != 0) {
      auto held_from = steps_.rbegin();
      while (held_from->held && std::next(held_from) != steps_.rend() && std::next(held_from)->held) ++held_from;
      rest_ = std::max(held_from->t, slip_time(resting_slip));
    }
  }

  double turn_;
  std::vector<Step> steps_;
};

std::shared_ptr<const ResistedMotion::Course> course_of(Experiment experiment, const Law& law, double rolling_friction,
                                                        bool in_steps, std::shared_ptr<ResistedFlows> flows) {
  experiment.contact.rolling_friction = rolling_friction;
  require_experiment(experiment);
  if (rolling_friction == 0 && experiment.environment.slope == 0)
    throw std::domain_error("ResistedMotion: rolling friction > 0 or a slope is required, got 0 and 0");
  require_stop(experiment);
  const auto [velocity, angular_velocity] = velocities_of(experiment.start);
  const Vector2d slip = slip_at_start(experiment) > 0 ? slip_velocity_at_start(experiment) : Vector2d(0, 0);
  const bool flat = experiment.ball.body.lies_flat();
  const State start{
      .slip = slip, .rolling = flat ? Vector2d(0, 0) : Vector2d(velocity - slip), .spin = angular_velocity.z()};
  const Vector2d along = direction_at_start(experiment);
  const bool straight = points_along(start.rolling, along) && points_along(pull(experiment.environment), along);
  Given given(experiment, law, std::move(flows));
  if (!in_steps && straight) {
    try {
      return std::make_shared<Straight>(given, start, along);
    } catch (const DrivenOut&) {
      // It speeds up for a while.
    }
  }
  return std::make_shared<Integrated>(std::move(given), start);
}

}  // namespace

ResistedMotion::ResistedMotion(const Experiment& experiment, const Law& law, double u_r, bool in_steps,
                               std::shared_ptr<ResistedFlows> flows)
    : course_(course_of(experiment, law, u_r, in_steps, std::move(flows))) {}

std::vector<ReducedPiece> ResistedMotion::pieces() const { return course_->pieces(); }

bool ResistedMotion::is_reduced() const { return course_->is_reduced(); }

std::optional<double> ResistedMotion::creep_ratio() const { return course_->creep_ratio(); }

MotionPoint ResistedMotion::at_time(double t) const {
  if (!(t >= 0)) throw std::domain_error(fmt::format("ResistedMotion::at_time: t must be >= 0, in s; got {}", t));
  const State now = course_->at(std::min(t, std::max(rest_time(), stop_time())));
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

Vector2d ResistedMotion::rest_position() const {
  if (std::isinf(course_->rest())) throw std::domain_error("ResistedMotion::rest_position: it rolls on for ever");
  return course_->at(course_->rest()).position;
}

double ResistedMotion::slip_length() const { return course_->at(course_->stop()).slip_length; }

double ResistedMotion::spin_angle() const { return course_->at(course_->stop()).turned; }

double ResistedMotion::rolling_loss() const {
  const Given& body = course_->body();
  if (body.resisting == 0) return 0;
  const double chi = body.inertia.chi;
  return chi / (chi - 1) * body.experiment.ball.mass * body.resisting * course_->at(last_time()).rolled;
}

double ResistedMotion::last_time() const {
  return std::isfinite(course_->rest()) ? std::max(course_->stop(), course_->rest()) : course_->stop();
}

double ResistedMotion::gained_on_slope() const {
  const Given& body = course_->body();
  return body.experiment.ball.mass * body.down.dot(course_->at(last_time()).position) + 0.0;
}

double ResistedMotion::path_length(double t) const { return course_->at(t).path; }

}  // namespace contensou::si
