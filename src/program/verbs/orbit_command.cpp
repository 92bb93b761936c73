#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "answers/input/tables.hpp"
#include "answers/verbs/ball_answers.hpp"
#include "answers/verbs/plane_answers.hpp"
#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/small_mu.hpp"
#include "contensou/si/scaling.hpp"
#include "options/instants_option.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/route_option.hpp"
#include "options/start_options.hpp"
#include "options/system_option.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

using reduction::Flow;
using reduction::OrbitColumns;
using reduction::Route;

/// The motion from one start, computed by a route.
class RoutedMotion {
 public:
  RoutedMotion(const reduction::ReducedSystem& system, reduction::State start, Route route)
      : system_(system), start_(start), route_(route), flow_(flow_of(system, route)) {}

  /// Returns the states at times tau >= 0 in any order; the rows have the same order.
  /// @throws std::runtime_error  if a stepper did not reach the stop
  OrbitColumns at(const Eigen::ArrayXd& times) const {
    if (flow_) return flow_->orbit(start_).at_times(times);
    if (times.size() == 0) return OrbitColumns();
    std::vector<Eigen::Index> order(static_cast<std::size_t>(times.size()));  // a stepper only goes forwards
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return times[i]; });
    const reduction::Motion motion = step(times(order));
    OrbitColumns columns(times.size());
    for (Eigen::Index row = 0; Eigen::Index i : order) columns.set(i, motion.points.row(row++));
    return columns;
  }

  /// Returns the states at times before the stop, accurate to the last digits.
  /// @throws BadInput  for a time before the start, and for a stepper, which cannot compute these states
  OrbitColumns at_time_left(const Eigen::ArrayXd& lefts) const {
    if (!flow_)
      throw BadInput(
          "--time-left needs --route closed or quadrature: the other routes do not compute the stop in advance");
    const reduction::Orbit orbit = flow_->orbit(start_);
    OrbitColumns columns(lefts.size());
    for (Eigen::Index i = 0; i < lefts.size(); ++i) {
      if (!(lefts[i] <= orbit.stop_time())) {
        throw BadInput("--time-left: {} is before the start, which is {} before the stop", lefts[i], orbit.stop_time());
      }
      columns.set(i, orbit.at_time_left(lefts[i]));
    }
    return columns;
  }

  /// Returns the states at regularised times >= 0.
  /// @throws BadInput  for a stepper, which accepts only tau
  OrbitColumns at_beta(const Eigen::ArrayXd& betas) const {
    if (!flow_) throw BadInput("--beta needs --route closed or quadrature: give --at with the other routes");
    return reduction::at_betas(*flow_, start_, betas);
  }

  /// Returns the states at instants from the start to the stop, both included.
  /// @param count        number of instants, >= 2
  /// @param equidistant  false: half of the instants lie before one of the speeds has fallen to 1e-3 of its start
  /// @throws std::runtime_error  as `at`, and if the stop time exceeds the largest double
  OrbitColumns samples(Eigen::Index count, bool equidistant) const {
    const reduction::Orbit orbit = (flow_ ? *flow_ : Flow(system_)).orbit(start_);
    const std::optional<reduction::Motion> whole = flow_ ? std::nullopt : std::optional(step({}));
    const double stop = whole ? whole->stop_time : orbit.stop_time();
    if (!std::isfinite(stop))
      throw std::runtime_error("the stop time exceeds the largest double: use a larger unit of speed");
    const double busy = equidistant ? 0 : busy_time(orbit);
    if (flow_ && !(2 * busy < stop && busy > 0)) return orbit.sample(count);
    const Eigen::ArrayXd times = instants(count, busy, stop);
    OrbitColumns columns = flow_ ? orbit.at_times(times) : at(times);
    if (!flow_) {
      columns.set(count - 1, whole->points.row(whole->points.rows() - 1));
      return columns;
    }
    for (Eigen::Index i = count / 2; i < count; ++i) columns.set(i, orbit.at_time_left(stop - times[i]));
    return columns;
  }

 private:
  /// @param times  times that do not decrease
  reduction::Motion step(const Eigen::ArrayXd& times) const {
    reduction::Motion motion = route_ == Route::regularised ? reduction::integrate_regularised(system_, start_, times)
                                                            : reduction::integrate_directly(system_, start_, times);
    if (!motion.outcome.ok()) throw std::runtime_error(motion.outcome.sentence);
    return motion;
  }

  /// Returns the first tau at which a speed has fallen to 1e-3 of its start. Most of the motion happens before this
  /// tau.
  double busy_time(const reduction::Orbit& orbit) const {
    const auto [u0, v0] = start_;
    const double v = v0 > 0 ? orbit.time_of_v(1e-3 * v0) : 0;
    const double u = u0 != 0 ? orbit.time_of_u(1e-3 * std::abs(u0)) : 0;
    return v0 == 0 ? u : u0 == 0 ? v : std::min(u, v);
  }

  const reduction::ReducedSystem& system_;
  reduction::State start_;
  Route route_;
  std::optional<Flow> flow_;  ///< empty for the steppers
};

/// An orbit at the requested instants. Columns that were not requested are empty.
struct OrbitReport {
  const GivenStart& start;
  Route route;
  OrbitColumns motion;
  std::optional<si::LoadHistory> load;
  Eigen::ArrayXd u_estimate = {}, v_estimate = {}, ln_v_estimate = {};
  Eigen::ArrayXd tau_left = {};
  Eigen::ArrayXd t = {};  ///< time since the start, s
  Eigen::ArrayXd q = {}, p = {}, integral = {};
};

constexpr Field<OrbitReport> orbit_fields[]{
    {"law", "", "", [](const OrbitReport& r) -> Json { return r.start.system.law().name(); }},
    {"route", "", "names of the law of friction and of the method",
     [](const OrbitReport& r) -> Json { return name(r.route); }},
    {"mu", "", "", [](const OrbitReport& r) -> Json { return r.start.system.mu(); }},
    {"u0", "speed", "", [](const OrbitReport& r) -> Json { return r.start.state.u; }},
    {"v0", "1, speed, speed", "ratio mu, and u and v at the start",
     [](const OrbitReport& r) -> Json { return r.start.state.v; }},
    {"ball", "", "values of --ball and of its contact patch",
     [](const OrbitReport& r) {
       return r.start.experiment ? members_of_ball(*r.start.experiment, r.start.system.law()) : Json();
     }},
    {"load", "s, N", "table in the file that --load names",
     [](const OrbitReport& r) { return r.load ? members_of(*r.load) : Json(); }, nullptr, 0,
     " {`t` [...], `load` [...]}"},
};

/// Returns the values of a column; null if the column was not requested.
const Eigen::ArrayXd* unless_empty(const Eigen::ArrayXd& values) { return values.size() > 0 ? &values : nullptr; }

constexpr ColumnField<OrbitReport> orbit_columns[]{
    {"tau", "speed", "time tau since the start", [](const OrbitReport& r) { return &r.motion.tau; }},
    {"u", "speed", "", [](const OrbitReport& r) { return &r.motion.u; }},
    {"v", "speed", "u and v at this time", [](const OrbitReport& r) { return &r.motion.v; }},
    {"ln_v", "", "natural logarithm of v; a normal number even where v is so small that it is printed as 0",
     [](const OrbitReport& r) { return &r.motion.ln_v; }},
    {"k", "", "ratio k = v/(mu |u|)", [](const OrbitReport& r) { return &r.motion.k; }},
    {"beta", "1/speed", "time beta since the start", [](const OrbitReport& r) { return &r.motion.beta; }},
    {"u_estimate", "speed", "", [](const OrbitReport& r) { return unless_empty(r.u_estimate); }},
    {"v_estimate", "speed", "", [](const OrbitReport& r) { return unless_empty(r.v_estimate); }},
    {"ln_v_estimate", "speed",
     "approximate solution for small mu at this tau, with --estimate. It has a stop time of its own, after which u and "
     "v are 0",
     [](const OrbitReport& r) { return unless_empty(r.ln_v_estimate); }},
    {"tau_left", "speed", "tau from this time until the stop, with --time-left",
     [](const OrbitReport& r) { return unless_empty(r.tau_left); }},
    {"t", "s", "time since the start in seconds, with --ball", [](const OrbitReport& r) { return unless_empty(r.t); }},
    {"q", "", "ratio v/u, with --reduction", [](const OrbitReport& r) { return unless_empty(r.q); }},
    {"p", "", "logarithm ln v, with --reduction", [](const OrbitReport& r) { return unless_empty(r.p); }},
    {"integral", "",
     "constant of the motion, with --reduction: ln |u| - ln w(k), with a function w that the law determines; inf where "
     "it has no value",
     [](const OrbitReport& r) { return unless_empty(r.integral); }},
};

std::vector<FieldText> orbit_texts() { return joined({texts_of(orbit_fields), texts_of(orbit_columns)}); }

class OrbitCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    system_.add(app);
    start_.take_load_history();
    start_.add(app);
    start_.add_drive(app);
    law_.add(app);
    route_.add(app);
    instants_.add(app, "tau", "", " from the start to the stop", true);
    until_.add(app, "--until", "T",
               "last instant of --samples, instead of the stop. With --system, --at and --until may lie before the "
               "start, and for y' = F(x, y) they are values of x",
               [](const std::string& typed) {
                 auto last = InstantsOption::read_times(typed, "tau", "", true);
                 if (last.values.size() != 1) throw NotAllowed("one time is needed");
                 return last;
               });
    until_.excludes({&instants_.at_argument()});
    time_left_.add(
        app, "--time-left", "T1,T2,...|FILE",
        "times that are left until the stop, instead of --at; with --ball also in seconds, such as '1,2 s'. FILE "
        "has a column tau_left. The output adds the column tau_left",
        [](const std::string& typed) { return InstantsOption::read_times(typed, "tau_left"); });
    beta_.add(app, "--beta", "B1,B2,...|FILE", "times beta >= 0, instead of --at. FILE has a column beta",
              [](const std::string& typed) {
                auto betas = InstantsOption::read_times(typed, "beta");
                if (betas.in_seconds) throw NotAllowed("beta has no unit: plain numbers are needed");
                return betas.values;
              });
    time_left_.excludes(united({{&beta_}, instants_.all()}));
    beta_.excludes(instants_.all());
    estimate_.add(app, "--estimate",
                  "add an approximate solution for small mu: columns u_estimate (relative error of order mu^4), "
                  "v_estimate and ln_v_estimate (order mu^2)");
    reduction_.add(
        app, "--reduction",
        "add the coordinates q = v/u and p = ln v in which the equations are solved, and integral, a constant "
        "of the motion");
    output_.add(app);
    time_left_.excludes({&until_});
    beta_.excludes({&until_});
    system_.argument().excludes({&law_.argument(), &route_.argument(), &time_left_, &beta_, &estimate_, &reduction_},
                                "only (2.6) has these. The table of a typed system contains its first integral");
    system_.argument().excludes(start_.of_body(), "its numbers are in the formulas, or --param");
  }

  ExitStatus run() override {
    const Output output = output_.read();
    if (system_.given()) return run_system(output);
    for (const auto* times : {instants_.at(), until_.given() ? &*until_ : nullptr}) {
      if (times != nullptr) require_after_start(*times);
    }
    const GivenStart start = start_.read(law_.read(start_.standard_law()));
    const reduction::ReducedSystem& system = start.system;
    const Route route = route_.read(system);
    const auto* at = instants_.at();
    const InstantsOption::Times sampled = until_.given() ? sampled_until() : InstantsOption::Times();
    if (until_.given()) at = &sampled;
    const auto load = start_.load_history();
    if (load) {
      fmt::print(stderr, "{}", require_load_alone(*start.experiment, system.law()));
      // The seconds of a time left would depend on the future load, if the load changes.
      if (time_left_.given() && time_left_->in_seconds)
        time_left_.reject("with a load that changes so much tau is left, and no seconds: leave the unit out");
    }
    const Eigen::ArrayXd lefts = time_left_.given() ? taus(*time_left_, start, load) : Eigen::ArrayXd();
    const std::vector<si::ReducedPiece> pieces = start.pieces();
    if (pieces.size() > 1) require_one_orbit(route);
    const auto routed = [&] { return RoutedMotion(system, start.state, route); };
    OrbitColumns motion =
        pieces.size() > 1 ? motion_of_pieces(pieces, at != nullptr ? taus(*at, start, load) : Eigen::ArrayXd(), lefts)
        : time_left_.given() ? routed().at_time_left(lefts)
        : beta_.given()      ? routed().at_beta(*beta_)
        : at != nullptr      ? routed().at(taus(*at, start, load))
                             : routed().samples(instants_.samples(), instants_.equidistant());
    // At rest the row contains the limit of k, because 0/0 has no value.
    if (const auto at_rest = motion.u == 0 && motion.v == 0; at_rest.any()) {
      const double k0 = start.state.u == 0 ? infinity : start.state.v / (system.mu() * std::abs(start.state.u));
      const Flow last = pieces.empty() ? Flow(system) : pieces.back().flow;
      const double k_end = start.at_rest() ? 0 : last.terminal().end_of(k0).k;
      motion.k = at_rest.select(k_end, motion.k);
    }
    OrbitReport report{start, route, motion, load};
    if (estimate_) add_estimate(report);
    report.tau_left = lefts;
    if (start.experiment) {
      const auto seconds = [&](double tau) {
        const double nominal = si::seconds(*start.experiment, tau);
        return load ? load->time_of(nominal) : nominal;
      };
      const bool given = at != nullptr && at->in_seconds;  // true: the output repeats the typed seconds
      report.t = given ? at->values : Eigen::ArrayXd(motion.tau.unaryExpr(seconds));
    }
    if (reduction_) add_canonical(report);
    return output.write(
        Answer{.members = members_of(orbit_fields, report), .columns = columns_of(orbit_columns, report)});
  }

 private:
  ExitStatus run_system(const Output& output) const {
    const TypedSystem typed = system_.read(law_.parameters());
    const auto plain = [](const InstantsOption::Times& times) {
      if (times.in_seconds) throw BadInput("the time of a typed system has no unit: give plain numbers");
      return times.values;
    };
    SystemInstants instants{{}, {}, instants_.samples()};
    if (instants_.at() != nullptr) instants.at = plain(*instants_.at());
    if (until_.given()) instants.until = plain(*until_)[0];
    const StartedSystem system{typed.field, typed.formulas, system_.text(), system_.require_start(typed, start_)};
    return output.write(orbit_system_answer(system, instants));
  }

  void require_after_start(const InstantsOption::Times& times) const {
    try {
      InstantsOption::require_not_negative(times, "tau");
    } catch (const NotAllowed& error) {
      (until_.given() ? until_ : instants_.at_argument()).reject(error.what());
    }
  }

  InstantsOption::Times sampled_until() const {
    return {Eigen::ArrayXd::LinSpaced(instants_.samples(), 0, until_->values[0]), until_->in_seconds};
  }

  /// @throws BadInput  for options that need a single orbit, if rolling friction divides the motion into several orbits
  void require_one_orbit(Route route) const {
    const char* const why = " needs one orbit, and rolling friction divides this motion into several";
    if (route != Route::quadrature) throw BadInput("--route {}{}: leave it out", name(route), why);
    if (beta_.given()) throw BadInput("--beta{}: leave it out, or give --at", why);
    if (estimate_) throw BadInput("--estimate{}: leave it out", why);
    if (reduction_) throw BadInput("--reduction{}: leave it out", why);
  }

  /// Returns the states at the given times, or at the given times left, or else at equidistant times.
  OrbitColumns motion_of_pieces(const std::vector<si::ReducedPiece>& pieces, Eigen::ArrayXd at,
                                const Eigen::ArrayXd& lefts) const {
    if (at.size() == 0 && lefts.size() == 0) at = instants(instants_.samples(), 0, si::stop_time(pieces));
    OrbitColumns columns(at.size() + lefts.size());
    for (Eigen::Index i = 0; i < at.size(); ++i) columns.set(i, si::state_at(pieces, at[i]));
    for (Eigen::Index i = 0; i < lefts.size(); ++i) columns.set(i, si::state_at_time_left(pieces, lefts[i]));
    return columns;
  }

  static Eigen::ArrayXd taus(const InstantsOption::Times& times, const GivenStart& start,
                             const std::optional<si::LoadHistory>& load) {
    if (!times.in_seconds) return times.values;
    const auto clock = [&](double t) { return load ? load->clock(t) : t; };
    if (start.experiment) return times.values.unaryExpr(clock) / si::seconds(*start.experiment, 1);
    throw BadInput(
        "times in seconds need a ball: add --ball NAME|FILE.toml, or leave the unit out; tau is in the unit of --u0");
  }

  static void add_estimate(OrbitReport& report) {
    const reduction::SmallMuMotion estimate(report.start.system, report.start.state);
    const Eigen::ArrayXd& taus = report.motion.tau;
    for (Eigen::ArrayXd* column : {&report.u_estimate, &report.v_estimate, &report.ln_v_estimate})
      column->resize(taus.size());
    for (Eigen::Index row = 0; row < taus.size(); ++row) {
      const auto speeds = estimate.at_time(taus[row]);
      report.u_estimate[row] = speeds.u;
      report.v_estimate[row] = speeds.v;
      report.ln_v_estimate[row] = speeds.ln_v;
    }
  }

  /// Adds q = v/u, p = ln v and the first integral. The first integral is infinite at points without a value: on the
  /// axes, on an invariant ray and at rest.
  static void add_canonical(OrbitReport& report) {
    const OrbitColumns& motion = report.motion;
    const Flow flow = report.start.flow();
    report.integral = Eigen::ArrayXd::Constant(motion.rows(), infinity);
    for (Eigen::Index i = 0; i < motion.rows(); ++i) {
      try {
        report.integral[i] = flow.log_first_integral(motion.u[i], motion.ln_v[i]);
      } catch (const std::domain_error&) {
        // the point has no first integral, so infinity stays
      }
    }
    const double factor = report.start.system.mu() * (report.start.state.u < 0 ? -1 : 1);
    report.q = factor * motion.k + 0.0;  // adding 0 avoids -0
    report.p = motion.ln_v;
  }

  SystemOption system_;
  StartOptions start_;
  LawOption law_;
  RouteOption route_;
  InstantsOption instants_;
  ArgumentOf<InstantsOption::Times> until_;
  ArgumentOf<InstantsOption::Times> time_left_;
  ArgumentOf<Eigen::ArrayXd> beta_;
  Flag estimate_, reduction_;
  OutputOptions output_{{{"an orbit", answer_formats("csv")}}};
};

const RegisteredVerb<OrbitCommand> orbit_verb(Purpose::compute, "orbit",
                                              "Compute spin and slip at instants of a motion",
                                              "contensou orbit --mu 0.1 --u0 1 --v0 1 --samples 50",
                                              {{"", orbit_texts}, {"--system", orbit_system_fields}},
                                              {"u", "v", "mu", "k", "f, N", "tau", "beta", "stop", "(speed)"});

}  // namespace

}  // namespace contensou::program
