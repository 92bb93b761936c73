#include <cmath>
#include <initializer_list>
#include <vector>

#include <fmt/format.h>

#include "answers/input/load_table.hpp"
#include "answers/verbs/ball_answer.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/infinity.hpp"
#include "contensou/reduction/small_mu.hpp"
#include "contensou/si/scaling.hpp"
#include "options/instants_option.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/route_option.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

/// An orbit at the requested instants. Columns that were not requested are empty.
struct OrbitReport {
  const GivenStart& start;
  reduction::Route route;
  reduction::OrbitColumns motion;
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
    start_.take_load_history();
    start_.add(app);
    start_.add_drive(app);
    law_.add(app);
    route_.add(app);
    CLI::Option* at = instants_.add(app, "tau", "", " from the start to the stop");
    time_left_
        .add(app, "--time-left", "T1,T2,...|FILE",
             "times that are left until the stop, instead of --at; with --ball also in seconds, such as '1,2 s'. FILE "
             "has a column tau_left. The output adds the column tau_left",
             [](const std::string& typed) { return InstantsOption::read_times(typed, "tau_left"); })
        ->excludes(at);
    beta_
        .add(app, "--beta", "B1,B2,...|FILE", "times beta >= 0, instead of --at. FILE has a column beta",
             [](const std::string& typed) {
               auto betas = InstantsOption::read_times(typed, "beta");
               if (betas.in_seconds) throw NotAllowed("beta has no unit: plain numbers are needed");
               return betas.values;
             })
        ->excludes(at);
    app.add_flag("--estimate", estimate_,
                 "add an approximate solution for small mu: columns u_estimate (relative error of order mu^4), "
                 "v_estimate and ln_v_estimate (order mu^2)");
    app.add_flag("--reduction", reduction_,
                 "add the coordinates q = v/u and p = ln v in which the equations are solved, and integral, a constant "
                 "of the motion");
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    const GivenStart start = start_.read(law_.read(start_.standard_law()));
    const reduction::ReducedSystem& system = start.system;
    const reduction::Route route = route_.read(system);
    for (const Argument* other : std::initializer_list<const Argument*>{&time_left_, &beta_}) {
      if (!other->given() || !instants_.given()) continue;
      throw BadInput("{} and --samples, --equidistant exclude each other: give one of them", other->name());
    }
    if (time_left_.given() && beta_.given())
      throw BadInput("--time-left and --beta exclude each other: give one of them");
    const auto* at = instants_.at();
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
    reduction::OrbitColumns motion =
        pieces.size() > 1 ? motion_of_pieces(pieces, at != nullptr ? taus(*at, start, load) : Eigen::ArrayXd(), lefts)
        : time_left_.given() ? motion_at_time_left(system, start.state, route, lefts)
        : beta_.given()      ? motion_at_beta(system, start.state, route, *beta_)
        : at != nullptr      ? motion_at(system, start.state, route, taus(*at, start, load))
                             : motion_samples(system, start.state, route, instants_.samples(), instants_.equidistant());
    // At rest the row contains the limit of k, because 0/0 has no value.
    if (const auto at_rest = motion.u == 0 && motion.v == 0; at_rest.any()) {
      const double k0 = start.state.u == 0 ? infinity : start.state.v / (system.mu() * std::abs(start.state.u));
      const reduction::Flow last = pieces.empty() ? reduction::Flow(system) : pieces.back().flow;
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
  /// @throws BadInput  for options that need a single orbit, if rolling friction divides the motion into several orbits
  void require_one_orbit(reduction::Route route) const {
    const char* const why = " needs one orbit, and rolling friction divides this motion into several";
    if (route != reduction::Route::quadrature) throw BadInput("--route {}{}: leave it out", name(route), why);
    if (beta_.given()) throw BadInput("--beta{}: leave it out, or give --at", why);
    if (estimate_) throw BadInput("--estimate{}: leave it out", why);
    if (reduction_) throw BadInput("--reduction{}: leave it out", why);
  }

  /// Returns the states at the given times, or at the given times left, or else at equidistant times.
  reduction::OrbitColumns motion_of_pieces(const std::vector<si::ReducedPiece>& pieces, const Eigen::ArrayXd& at,
                                           const Eigen::ArrayXd& lefts) const {
    const auto state = [&](double tau) { return si::state_at(pieces, tau); };
    if (at.size() == 0 && lefts.size() == 0) return motion_samples(state, si::stop_time(pieces), instants_.samples());
    reduction::OrbitColumns columns(at.size() + lefts.size());
    for (Eigen::Index i = 0; i < at.size(); ++i) columns.set(i, state(at[i]));
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
    const reduction::OrbitColumns& motion = report.motion;
    const reduction::Flow flow = report.start.flow();
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

  StartOptions start_;
  LawOption law_;
  RouteOption route_;
  InstantsOption instants_;
  ArgumentOf<InstantsOption::Times> time_left_;
  ArgumentOf<Eigen::ArrayXd> beta_;
  bool estimate_ = false;
  bool reduction_ = false;
  OutputOptions output_{{{"an orbit", answer_formats("csv")}}};
};

const RegisteredVerb<OrbitCommand> orbit_verb(Purpose::compute, "orbit",
                                              "Compute spin and slip at instants of a motion",
                                              "contensou orbit --mu 0.1 --u0 1 --v0 1 --samples 50",
                                              {{"", orbit_texts}},
                                              {"u", "v", "mu", "k", "f, N", "tau", "beta", "stop", "(speed)"});

}  // namespace

}  // namespace contensou::program
