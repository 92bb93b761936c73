#include "contensou/si/motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/root.hpp"
#include "contensou/si/scaling.hpp"
#include "solution.hpp"

namespace contensou::si {

namespace {

double require_time(const char* function, double t) {
  if (t >= 0) return t;
  throw std::domain_error(fmt::format("Motion::{}: t must be >= 0, in s; got {}", function, t));
}

double require_speed(const char* function, double speed) {
  if (speed >= 0) return speed;
  throw std::domain_error(fmt::format("Motion::{}: speed >= 0 is required, got {}", function, speed));
}

/// Returns the time at which a value that falls until the time `last` reaches `to` > 0.
double time_of_fall(const std::function<double(double)>& value, double to, double last) {
  return value(0) <= to ? 0 : reduction::root_between([&](double t) { return value(t) - to; }, 0, last);
}

SolvedMotion reduced_motion(const Experiment& experiment, const reduction::Law& law, SharedFlows& flows) {
  return is_driven(experiment) ? resisted_motion(experiment, law, flows) : undriven_motion(experiment, law, flows);
}

SolvedMotion under(const std::optional<LoadHistory>& history, SolvedMotion motion) {
  return history ? loaded_motion(std::move(motion), *history) : motion;
}

constexpr EventNumber numbers_of_events[]{
    {"rolls_after", "t", "s", "t_rolls", [](const Events& of) { return of.rolls.t; }},
    {"rolls_after", "x", "m", "x_rolls", [](const Events& of) { return of.rolls.place.x(); }},
    {"rolls_after", "y", "m", "y_rolls", [](const Events& of) { return of.rolls.place.y(); }},
    {"spin_ends", "t", "s", "t_spin_ends", [](const Events& of) { return of.spin_ends.t; }},
    {"spin_ends", "x", "m", "x_spin_ends", [](const Events& of) { return of.spin_ends.place.x(); }},
    {"spin_ends", "y", "m", "y_spin_ends", [](const Events& of) { return of.spin_ends.place.y(); }},
    {"rest", "t", "s", "t_rest", [](const Events& of) { return of.rest ? of.rest->t : infinity; }},
    {"rest", "x", "m", "x_rest", [](const Events& of) { return of.rest ? of.rest->place.x() : infinity; }},
    {"rest", "y", "m", "y_rest", [](const Events& of) { return of.rest ? of.rest->place.y() : infinity; }},
    {"slip_length", "", "m", "slip_length", [](const Events& of) { return of.slip_length; }},
    {"turns", "", "", "turns", [](const Events& of) { return of.turns; }},
    {"path", "", "m", "path", [](const Events& of) { return of.path; }},
};

}  // namespace

std::span<const EventNumber> event_numbers() { return numbers_of_events; }

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

MotionColumns Motion::Solution::at_times(const Eigen::ArrayXd& times) const {
  MotionColumns columns(times.size());
  for (Eigen::Index i = 0; i < times.size(); ++i) columns.set(i, at(require_time("at", times[i])));
  return columns;
}

double Motion::Solution::slip_time(double speed) const {
  const auto slip = [this](double t) { return at(t).slip; };
  return speed == 0 ? stop_time() : time_of_fall(slip, speed, stop_time());
}

double Motion::Solution::spin_time(double speed) const {
  const auto spin = [this](double t) { return std::abs(at(t).angular_velocity.z()); };
  return speed == 0 ? spin_end() : time_of_fall(spin, speed, spin_end());
}

double Motion::Solution::path_length(double t) const {
  return integral_over_time([this](double now) { return at(now).velocity.norm(); }, 0, t, 1e-10);
}

double integral_over_time(const std::function<double(double)>& value, double from, double to, double tolerance) {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 15>;
  constexpr unsigned depth = 12;
  return to > from ? Rule::integrate(value, from, to, depth, tolerance) : 0;
}

reduction::Flow SharedFlows::get(Of of, const std::function<reduction::Flow()>& made) {
  const std::lock_guard lock(guard_);
  auto& flow = known_[static_cast<std::size_t>(of)];
  if (!flow) flow = made();
  return *flow;
}

Motion Motion::reduced(const Experiment& experiment, const reduction::Law& law,
                       const std::optional<LoadHistory>& history) {
  SharedFlows flows;
  return Motion(under(history, reduced_motion(experiment, law, flows)));
}

Motion Motion::reduced(const Experiment& experiment, const reduction::Flow& flow,
                       const std::optional<LoadHistory>& history) {
  SharedFlows flows(flow);
  return Motion(under(history, reduced_motion(experiment, flow.system().law(), flows)));
}

Motion Motion::in_steps(const Experiment& experiment, const reduction::Law& law,
                        const std::optional<LoadHistory>& history) {
  SharedFlows none;
  return Motion(under(history, is_driven(experiment) ? resisted_motion(experiment, law, none, true)
                                                     : undriven_motion_in_steps(experiment, law)));
}

Motion Motion::uncoupled(const Experiment& experiment, const reduction::Law& law, double rolling_below,
                         const std::optional<LoadHistory>& history) {
  return Motion(under(history, uncoupled_motion(experiment, law, require_speed("uncoupled", rolling_below))));
}

const Motion& Motion::finite() const {
  const double stop = stop_time();
  require_finite_motion(experiment(), stop);
  if (!std::isfinite(stop)) throw std::runtime_error("the stop time exceeds the largest double");
  require_finite_motion(experiment(), last_time());
  return *this;
}

const Experiment& Motion::experiment() const { return solution_->experiment; }
MotionPoint Motion::at(double t) const { return solution_->at(require_time("at", t)); }
MotionColumns Motion::at(const Eigen::ArrayXd& times) const { return solution_->at_times(times); }
double Motion::stop_time() const { return solution_->stop_time(); }
double Motion::spin_end() const { return solution_->spin_end(); }
double Motion::slip_time(double speed) const { return solution_->slip_time(require_speed("slip_time", speed)); }
double Motion::spin_time(double speed) const { return solution_->spin_time(require_speed("spin_time", speed)); }
double Motion::rolls(double rolling_below) const {
  return slip_time(experiment().ball.body.lies_flat() ? 0 : rolling_below);
}
std::optional<Event> Motion::rest() const { return solution_->rest(); }
double Motion::slip_length() const { return solution_->slip_length(); }
double Motion::spin_angle() const { return solution_->spin_angle(); }
double Motion::turns() const { return spin_angle() / (2 * std::numbers::pi); }
double Motion::path_length(double t) const { return solution_->path_length(require_time("path_length", t)); }
Velocities Motion::final_motion() const { return solution_->final_motion(); }
bool Motion::is_reduced() const { return solution_->is_reduced(); }
std::vector<ReducedPiece> Motion::pieces() const { return solution_->pieces(); }
std::optional<double> Motion::creep_ratio() const { return solution_->creep_ratio(); }
long Motion::steps() const { return solution_->steps(); }

double Motion::last_time() const {
  const auto rests = rest();
  return rests ? std::max(stop_time(), rests->t) : stop_time();
}

Events Motion::events(double rolling_below) const {
  const double rolling = rolls(rolling_below);
  return {event(rolling), event(spin_end()), rest(), slip_length(), turns(), path_length(rolling)};
}

EnergyBalance Motion::energy_balance() const {
  const auto& [ball, contact, start, environment, spreads] = experiment();
  const double first = kinetic_energy(ball, velocities_of(start));
  const auto [sliding, pivoting] = energy_loss(experiment());
  if (!is_driven(experiment())) return {first, sliding, pivoting, 0, 0, kinetic_energy(ball, final_motion())};
  const MotionPoint last = at(last_time());
  const double chi = ball.body.inertia.chi, resisting = contact.rolling_friction * pressing(environment);
  const double rolling = resisting == 0 ? 0 : chi / (chi - 1) * ball.mass * resisting * solution_->rolled();
  const double gained = ball.mass * pull(environment).dot(last.position) + 0.0;
  // The remaining loss of energy is the loss by sliding.
  return {first, first + gained - pivoting - rolling - last.energy, pivoting, rolling, gained, last.energy};
}

Shots::Shots(const Experiment& ball, const reduction::Law& law)
    : Shots(ball, reduction::Flow(undriven_system(ball, law))) {}

Shots::Shots(const Experiment& ball, const reduction::Flow& flow)
    : ball_(ball), law_(flow.system().law()), flows_(std::make_shared<SharedFlows>(flow)) {
  require_stop(ball_);
}

Motion Shots::from(const Start& start) const {
  Experiment experiment = ball_;
  experiment.start = start;
  require_experiment(experiment);
  return Motion(reduced_motion(experiment, law_, *flows_));
}

}  // namespace contensou::si
