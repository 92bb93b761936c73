// Notation: c is the slip, W = R (omega_y, -omega_x) the rolling velocity, V = c + W the velocity of the centre, w =
// eps |omega_z|, k = |c|/w, e = c/|c|, a = u_r g, and d the pull of a slope. On a slope g stands for g cos(alpha).
// Friction, rolling resistance and pull give (reduction/theory.md, (R21), (R22))
//   V' = -f g Phi e + d,   W' = (chi - 1) f g Phi e - chi a W/|W|,   c' = V' - W'
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

#include "contensou/reduction/detail/root.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/si/scaling.hpp"
#include "pure_rolling.hpp"
#include "solution.hpp"

namespace contensou::si {

namespace {

namespace odeint = boost::numeric::odeint;
using Eigen::Vector2d;
using reduction::Flow;
using reduction::Law;
using reduction::Orbit;
using reduction::ReducedSystem;

/// A state, with the lengths and angles since the start.
struct State {
  Vector2d slip, rolling;
  double spin;  ///< rad/s
  Vector2d position = {0, 0};
  double slip_length = 0, turned = 0, path = 0;
  double rolled = 0;  ///< the integral of |W|

  Vector2d velocity() const { return slip + rolling; }

  /// Adds a displacement along a direction: to the position, the path and the rolled length, in m.
  void advance(double way, double rolled_way, const Vector2d& along) {
    position += way * along;
    path += way;
    rolled += rolled_way;
  }
};

/// Returns the state `seconds` after `from`, for a ball that neither slides nor spins.
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

/// The constants of a motion.
struct Given {
  Given(const Experiment& given, const Law& of_law)
      : lies_flat(given.ball.body.lies_flat()),
        law(of_law),
        radius(given.ball.radius),
        patch(patch_radius_of(given, of_law)),
        inertia(given.ball.body.inertia),
        drive(given.contact.rolling_friction / given.contact.friction),
        sliding(given.contact.friction * pressing(given.environment)),
        resisting(given.contact.rolling_friction * pressing(given.environment)),
        down(pull(given.environment)),
        tau_per_second(1 / seconds(given, 1)) {}

  /// Returns the largest force Phi at which resistance holds a ball that does not turn; infinity if it lies flat.
  double holding() const {
    return lies_flat ? std::numeric_limits<double>::infinity() : inertia.chi * drive / (inertia.chi - 1);
  }

  /// Returns true if friction is large enough to turn a ball that does not turn.
  bool turns(double slip, double spin) const {
    if (holding() == 0) return true;
    const double k_force = slip > 0 ? law({slip, patch * std::abs(spin)}).force : 0;
    return k_force > holding();
  }

  /// Returns the rolling after slip and spin have ended.
  PureRolling rolling_on(const State& from) const {
    const Vector2d rolls = (1 - 1 / inertia.chi) * down;
    return {from.rolling, rolls, lies_flat ? 0 : resisting};
  }

  /// Returns the time, s, during which friction is large enough for this rolling, so that the ball does not slide.
  double rolls_for(const PureRolling& rolling) const {
    return rolling.slides_after(sliding, down.norm() / inertia.chi);
  }

  /// Returns the direction of a slip v that is slow compared with rolling. Because c' = chi (N - f g e) with N = d/chi
  /// + a W/|W|, the slip has the direction n of N with the delay v n'/(chi |N|).
  Vector2d following(double v, const Vector2d& rolling) const {
    const Vector2d heading = rolling.normalized(), needed = down / inertia.chi + resisting * heading;
    const Vector2d n = needed.normalized();
    const Vector2d change = (inertia.chi - 1) * sliding * n - inertia.chi * resisting * heading;
    const auto across = [](const Vector2d& of, const Vector2d& unit) { return Vector2d(of - of.dot(unit) * unit); };
    const Vector2d turns = resisting * across(across(change, heading) / rolling.norm(), n) / needed.norm();
    return (n - v / (inertia.chi * needed.norm()) * turns).normalized();
  }

  bool lies_flat;
  Law law;
  double radius, patch;
  reduction::Inertia inertia;
  double drive;      ///< u_r/f
  double sliding;    ///< f g
  double resisting;  ///< u_r g
  Vector2d down;     ///< pull of the slope, m/s^2
  double tau_per_second;
};

/// A motion that is given by its state at any time.
class Resisted : public Motion::Solution {
 public:
  Resisted(const Experiment& of, Given given) : Solution(of), body_(std::move(given)) {}

  virtual State state(double t) const = 0;

  MotionPoint at(double t) const override {
    const State now = state(std::min(t, std::max(rest_, stop_)));
    const Vector2d velocity = now.velocity();
    const double radius = body_.radius;
    MotionPoint point{
        .t = t,
        .position = now.position,
        .velocity = velocity,
        .angular_velocity = {(0 - now.rolling.y()) / radius, now.rolling.x() / radius + 0.0, now.spin + 0.0},
        .slip = now.slip.norm(),
        .energy = 0};
    point.energy = kinetic_energy(experiment.ball, {point.velocity, point.angular_velocity});
    return point;
  }
  double stop_time() const override { return stop_; }
  double slip_time(double speed) const override {
    if (speed == 0) return stop_;
    const auto excess = [&](double t) { return state(t).slip.norm() - speed; };
    for (auto knot = knots_.rbegin(); knot != knots_.rend(); ++knot) {
      if (excess(*knot) <= 0) continue;
      return knot == knots_.rbegin() ? *knot : reduction::root_between(excess, *knot, *std::prev(knot));
    }
    return 0;
  }
  double slip_length() const override { return state(stop_).slip_length; }
  double spin_angle() const override { return state(stop_).turned; }
  double path_length(double t) const override { return state(t).path; }
  std::optional<Event> rest() const override {
    return std::isinf(rest_) ? std::nullopt : std::optional(Event{rest_, state(rest_).position});
  }
  Velocities final_motion() const override {
    const MotionPoint end = at(stop_);
    return {end.velocity, end.angular_velocity};
  }
  double rolled() const override { return state(std::isinf(rest_) ? stop_ : std::max(stop_, rest_)).rolled; }

 protected:
  Given body_;
  /// Times up to the stop, s, increasing; between two successive times the slip has at most one maximum.
  std::vector<double> knots_;
  double stop_ = 0, rest_ = 0;
};

/// Thrown for a drive of 1 or more, under which sliding does not end.
struct DrivenOut {};

/// The motion of a ball that slides in the direction of rolling, and straight down a slope. It consists of pieces of
/// three kinds: the ball turns, resistance holds the ball, or the ball slides no more.
class Straight final : public Resisted {
 public:
  Straight(const Experiment& of, Given given, const State& start, const Vector2d& along, SharedFlows& flows)
      : Resisted(of, std::move(given)), along_(along) {
    State here = start;
    double t = 0;
    bool turning = here.rolling.norm() > 0 || body_.turns(here.slip.norm(), here.spin);
    while (here.slip.norm() > 0 || here.spin != 0) {
      const Flow driven = flow(turning, flows);
      const auto end = driven.terminal().end_of(1);
      const bool creeps = here.spin != 0 && driven.system().drive() > 0 && end.regime == reduction::TerminalRegime::ray;
      if (creeps && (pieces_.empty() || !pieces_.front().of.turns)) creep_ratio_ = end.k;
      const reduction::State speeds{body_.radius * here.spin, here.slip.norm()};
      pieces_.push_back({t, here, {t * body_.tau_per_second, turning, driven, speeds, driven.orbit(speeds)}});
      const Piece& piece = pieces_.back();
      const double stop = t + seconds(experiment, piece.of.orbit.stop_time());
      // After a ball has begun to turn, it turns until slip and spin end (R23).
      const bool goes_on = turning && pieces_.size() > 1;
      const std::optional<double> changes = goes_on   ? std::nullopt
                                            : turning ? ceases_to_turn(piece, stop)
                                                      : begins_to_turn(piece);
      const double until = changes.value_or(stop);
      sample(t, until);
      here = state(until);
      t = until;
      if (!changes) break;
      if (turning) here.rolling.setZero();
      turning = !turning;
    }
    stop_ = t;
    here.slip.setZero();
    here.spin = 0;
    const bool held = !pieces_.empty() && !pieces_.back().of.turns;
    if (held) here.rolling.setZero();
    last_ = here;
    rolls_.emplace(body_.rolling_on(here));
    if (std::isfinite(body_.rolls_for(*rolls_))) throw DrivenOut();
    rest_ = stop_ + rolls_->rest_time();
    if (held && rest_ == stop_ && start.spin != 0)
      rest_ = pieces_.back().t + seconds(experiment, pieces_.back().of.orbit.time_of_v(resting_slip));
  }

  bool is_reduced() const override { return true; }
  std::optional<double> creep_ratio() const override { return creep_ratio_; }

  std::vector<ReducedPiece> pieces() const override {
    std::vector<ReducedPiece> result;
    for (const Piece& piece : pieces_) result.push_back(piece.of);
    return result;
  }

  State state(double t) const override {
    if (rolls_ && t >= stop_) return rolled_on(last_, t - stop_, *rolls_);
    const auto after = std::ranges::upper_bound(pieces_, t, {}, &Piece::t);
    const Piece& piece = after == pieces_.begin() ? *after : *std::prev(after);
    const double passed = std::max(0.0, t - piece.t);
    State now = piece.start;
    const double v0 = now.slip.norm(), W0 = now.rolling.norm();
    const double tau = std::min(passed * body_.tau_per_second, piece.of.orbit.stop_time());
    const Orbit::Instant instant = piece.of.orbit.instant(tau);
    const double slid = seconds(experiment, instant.slip_length);
    now.slip = instant.v * along_;
    now.spin = instant.u / body_.radius;
    now.slip_length += slid;
    now.turned += seconds(experiment, instant.turned) / body_.radius;
    double way = slid;
    if (piece.of.turns) {
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
    State start;
    ReducedPiece of;
  };

  /// Returns the flow of a piece.
  /// @throws DrivenOut  for a drive of 1 or more
  Flow flow(bool turning, SharedFlows& flows) const {
    const reduction::Inertia inertia{.chi = turning ? body_.inertia.chi : 1, .gamma = body_.inertia.gamma};
    const Drives drives = drives_along(experiment, along_, inertia.chi);
    const double drive = turning ? drives.turning() : drives.slope;
    if (drive >= 1) throw DrivenOut();
    return flows.get(turning ? SharedFlows::Of::turning : SharedFlows::Of::held, [&] {
      const double counts = drive < ReducedSystem::least_drive ? 0 : drive;
      return Flow(ReducedSystem(body_.law, body_.patch / body_.radius, inertia, counts));
    });
  }

  /// Returns the time, s, at which friction equals the largest friction that resistance can hold.
  std::optional<double> passes_holding(const Piece& piece) const {
    const double force = body_.holding();
    if (!(force > 0 && force < 1) || piece.of.orbit.on_axis()) return std::nullopt;
    constexpr double far = 100;
    const auto excess = [&](double ln_k) { return body_.law(reduction::slip_of_ratio(std::exp(ln_k))).force - force; };
    if (excess(-far) >= 0 || excess(far) <= 0) return std::nullopt;
    const double ln_k = reduction::root_between(excess, -far, far);
    const auto [low, high] =
        std::minmax({piece.of.orbit.start_log_ratio(), piece.of.orbit.chart().log_terminal_ratio()});
    if (!(low < ln_k && ln_k < high)) return std::nullopt;
    return piece.t + seconds(experiment, piece.of.orbit.at_log_ratio(ln_k).tau);
  }

  /// Returns the time, s, at which the ball ceases to turn before slip and spin end.
  std::optional<double> ceases_to_turn(const Piece& piece, double stop) const {
    if (body_.resisting == 0) return std::nullopt;
    const auto turning = [&](double t) { return state(t).rolling.dot(along_); };
    // Before passes_holding(), and from then to the stop, the rate of turning only grows or only falls.
    constexpr double first = 1e-9;
    double from = piece.start.rolling.norm() > 0 ? piece.t : piece.t + first * (stop - piece.t);
    for (const double to : {passes_holding(piece).value_or(from), stop}) {
      if (turning(to) < 0) return turning(from) > 0 ? reduction::root_between(turning, from, to) : from;
      from = to;
    }
    return std::nullopt;
  }

  /// Returns the time, s, at which friction begins to turn a ball that resistance has held.
  std::optional<double> begins_to_turn(const Piece& piece) const {
    const auto t = passes_holding(piece);
    return t && piece.of.orbit.start_log_ratio() < piece.of.orbit.chart().log_terminal_ratio() ? t : std::nullopt;
  }

  void sample(double from, double to) {
    constexpr int count = 64;
    for (int i = 0; i <= count; ++i) knots_.push_back(from + (to - from) * i / count);
  }

  Vector2d along_;
  std::vector<Piece> pieces_;
  State last_;
  std::optional<PureRolling> rolls_;
  std::optional<double> creep_ratio_;
};

/// The integrated c, W, w, m/s; position and slip length, m; angle turned, rad; path and rolled length, m.
using Progress = std::array<double, 11>;

/// The motion of any ball, integrated in steps.
class Integrated final : public Resisted {
 public:
  Integrated(const Experiment& of, Given given, const State& start)
      : Resisted(of, std::move(given)), turn_(std::copysign(1.0, start.spin)) {
    run(start);
  }

  long steps() const override { return static_cast<long>(steps_.size()); }

  State state(double t) const override {
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
    bool follows = false;  ///< true: the slip is (v, 0) in the direction Given::following
  };

  Vector2d slip_of(const Progress& x, const Step& step) const {
    if (!step.follows) return {x[0], x[1]};
    const double v = std::max(x[0], 0.0);
    return v * body_.following(v, {x[2], x[3]});
  }

  void equations(const Progress& x, Progress& rate, const Step& step) const {
    const Vector2d slip = slip_of(x, step), rolling(x[2], x[3]);
    const double v = slip.norm(), rim = std::max(x[4], 0.0), turning = rolling.norm();
    const auto [phi, psi] = v > 0 || rim > 0 ? body_.law({v, rim}) : reduction::Resistance{1, 0};
    // Friction keeps the direction of a slip that begins at 0. Rounding may make v negative.
    const Vector2d e = step.follows ? body_.following(v, rolling) : v > 0 ? Vector2d(slip / v) : Vector2d(0, 0);
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

  /// Returns the time, s, after which v + w would be 0 at the present rate of change; infinity if v + w grows.
  double time_to_stop(const Step& step) const {
    Progress rate;
    equations(step.x, rate, step);
    const Vector2d slip = slip_of(step.x, step), change(rate[0], rate[1]);
    const double v = slip.norm(), rim = std::max(step.x[4], 0.0);
    const double grows = step.follows ? rate[0] : v > 0 ? slip.dot(change) / v : change.norm();
    const double falls = -rate[4] - grows;
    return falls > 0 && v + rim > 0 ? (v + rim) / falls : std::numeric_limits<double>::infinity();
  }

  /// Returns the state a short time later; during this time friction is constant. If resistance holds the ball
  /// afterwards, the last rolling velocity becomes slip.
  Step passed(Step now, double seconds, bool held) const {
    Progress& x = now.x;
    x = progress_of(state_of(now));
    now.follows = false;
    now.held = held;
    Progress rate;
    equations(x, rate, now);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += seconds * rate[i];
    now.t += seconds;
    if (held) x[0] += std::exchange(x[2], 0), x[1] += std::exchange(x[3], 0);
    return now;
  }

  /// Returns the time, s, until resistance stops a rolling so slow that friction is constant: (R24) for A = friction.
  double time_to_hold(Step step) const {
    const Vector2d rolling(step.x[2], step.x[3]);
    if (rolling.norm() == 0) return 0;
    step.held = false;
    Progress rate;
    equations(step.x, rate, step);
    const double most = body_.inertia.chi * body_.resisting;
    return PureRolling(rolling, Vector2d(rate[2], rate[3]) + most * rolling.normalized(), most).rest_time();
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
    // A held ball creeps so slowly that its time of rest depends on the last digits of its slip.
    constexpr double tolerance = 1e-13, slip_tolerance = 1e-15;
    constexpr double nothing = 1e-9;  // share of the speeds at the start
    constexpr double soon = 1e-6;     // share of size/(f g), the time in which friction would end the speeds
    constexpr double slow = 3e-4;     // share of the rolling speed below which a slip is slow
    constexpr long step_limit = 2'000'000;
    Step now{0, progress_of(start)};
    Progress& x = now.x;
    const double size = start.slip.norm() + start.rolling.norm() + x[4];
    double step = 1e-4 * size / body_.sliding;
    auto stepper =
        odeint::make_controlled(slip_tolerance * size, tolerance, odeint::runge_kutta_cash_karp54<Progress>());
    for (long steps = 0;; ++steps) {
      const double v = std::hypot(x[0], x[1]), turning = std::hypot(x[2], x[3]);
      if (now.follows && v > std::max(slow * turning, nothing * size)) {
        x = progress_of(state_of(now));
        now.follows = false;
      }
      // If a ball does not turn, the torque of friction begins to turn it, or resistance holds it.
      const bool moved = body_.turns(v, x[4] / body_.patch);
      if (now.held && moved) now.held = false;
      if (!now.held && !moved && turning <= nothing * size) {
        const double left = time_to_hold(now);
        if (left <= soon * size / body_.sliding) now = passed(now, left, true);
      }
      if (now.held) x[2] = x[3] = 0;
      if (v + std::max(x[4], 0.0) <= nothing * size) {
        if (const double left = time_to_stop(now); left <= soon * size / body_.sliding)
          now = passed(now, left, now.held);
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
        // After the time `rolls` the ball slides. At first it slides so slowly that the equation of the slip is stiff.
        if (rolls > 0 || !now.follows)
          now = {.t = now.t + rolls, .x = progress_of(rolled_on(here, rolls, rolling)), .follows = true};
      }
      add(now);
      if (steps == step_limit)
        throw std::runtime_error(fmt::format("Motion: {} steps were not enough to reach the stop", steps));
      const Step before = now;
      double trial = std::min(step, time_to_stop(now));
      while (stepper.try_step([&](const Progress& at_x, Progress& rate, double) { equations(at_x, rate, before); }, x,
                              now.t, trial) == odeint::fail) {
        if (!(trial > std::numeric_limits<double>::min()) || std::isnan(trial))
          throw std::runtime_error("Motion: the step size fell to nothing: the friction law is not a number");
      }
      step = std::max(trial, now.t - before.t);
      // A step ends at the time at which friction begins to turn the ball.
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

}  // namespace

SolvedMotion resisted_motion(const Experiment& experiment, const Law& law, SharedFlows& flows, bool in_steps) {
  require_experiment(experiment);
  require_stop(experiment);
  require_finite_motion(experiment, 0);  // squares of lengths and speeds
  const auto [velocity, angular_velocity] = velocities_of(experiment.start);
  const Vector2d slip = slip_at_start(experiment) > 0 ? slip_velocity_at_start(experiment) : Vector2d(0, 0);
  const bool flat = experiment.ball.body.lies_flat();
  const State start{
      .slip = slip, .rolling = flat ? Vector2d(0, 0) : Vector2d(velocity - slip), .spin = angular_velocity.z()};
  const Vector2d along = direction_at_start(experiment);
  const bool straight = points_along(start.rolling, along) && points_along(pull(experiment.environment), along);
  const Given given(experiment, law);
  if (!in_steps && straight) {
    try {
      return std::make_shared<Straight>(experiment, given, start, along, flows);
    } catch (const DrivenOut&) {
      // The ball becomes faster for a while, so its motion has no pieces and is integrated in steps.
    }
  }
  return std::make_shared<Integrated>(experiment, given, start);
}

}  // namespace contensou::si
