#include "answers/verbs/ball_answers.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "answers/asked/formula_law.hpp"
#include "answers/input/errors.hpp"
#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "contensou/reduction/small_mu.hpp"
#include "contensou/reduction/tabulated_pressure_law.hpp"

namespace contensou::answers {

namespace {

struct OtherLaw {
  std::string law;
  double tau;
};

double tau_of(const si::Experiment& experiment, const reduction::Law& law) {
  return si::Motion::reduced(experiment, law).stop_time() / si::seconds(experiment, 1);
}

/// Returns the stop time of a start with the same patch under another law.
double tau_under(const GivenStart& start, const reduction::Law& law) {
  const reduction::ReducedSystem& system = start.system;
  if (!start.is_in_pieces())
    return reduction::Flow({law, system.mu(), system.inertia(), system.drive()}).stop_time(start.state).tau;
  si::Experiment experiment = *start.experiment;
  experiment.contact.patch = si::PatchRadius{si::patch_radius_of(experiment, system.law())};
  return tau_of(experiment, law);
}

/// Returns the stop time under the other law of the paper (exact or Pade), which belongs to the same pressure. Empty
/// for other laws, and if slip or spin is 0, because both laws then give the same stop time.
std::optional<OtherLaw> other_law(const GivenStart& start) {
  const reduction::ReducedSystem& system = start.system;
  const bool is_pade = system.law().as<reduction::PadeLaw>() != nullptr;
  if (!start.slides_and_spins() || (!is_pade && !system.law().as<reduction::HertzLaw>())) return std::nullopt;
  const reduction::Law& other = reduction::paper_laws()[is_pade ? 0 : 1];
  return OtherLaw{other.name(), tau_under(start, other)};
}

/// Stop time under a pressure table without every other row. If the rows sample a curve, the change of the stop time
/// bounds the interpolation error.
struct CoarserTable {
  Eigen::Index rows;
  double tau;
};

std::optional<CoarserTable> coarser_table(const GivenStart& start) {
  const auto* table = start.system.law().as<reduction::TabulatedPressureLaw>();
  if (table == nullptr || !start.slides_and_spins()) return std::nullopt;
  const auto coarser = table->coarser();
  if (!coarser) return std::nullopt;
  return CoarserTable{coarser->rows(), tau_under(start, *coarser)};
}

struct StopReport {
  GivenStart start;
  reduction::Route route;
  reduction::StopTime stop;
  double sliding_only;                             ///< stop time tau of a body with the same slip that does not pivot
  double pivoting_only;                            ///< stop time tau of a body with the same spin that does not slide
  std::optional<OtherLaw> other;                   ///< stop time under the other law of the paper, see other_law
  std::optional<CoarserTable> coarser;             ///< stop time under a pressure table without every other row
  std::vector<reduction::StopEstimate> estimates;  ///< estimates for small mu
  std::optional<reduction::StopTimeGradient> gradient;
  std::optional<Uncertainty> uncertainty;    ///< uncertainty of t_stop for a ball, else of tau_stop
  std::optional<si::LoadHistory> load = {};  ///< changing load, if given

  /// Returns the time in s that belongs to tau >= 0 for the ball, under a constant or a changing load.
  double seconds(double tau) const {
    const double nominal = si::seconds(*start.experiment, tau);
    return load ? load->time_of(nominal) : nominal;
  }
};

/// Returns the stop time tau of a body without slip at the start. A drive makes this body slide.
double pivoting_only(const GivenStart& start) {
  const auto& [system, state, experiment, motion] = start;
  if (experiment && si::is_driven(*experiment) && state.u != 0) {
    si::Experiment still = *experiment;
    still.start = si::SlipAndSpin{0, si::spin_at_start(*experiment)};
    return tau_of(still, system.law());  // the body spins in place, or slides down the slope
  }
  return system.drive() > 0 ? reduction::Flow(system).stop_time({state.u, 0}).tau : system.pivoting_limit(state.u);
}

double sliding_only(const GivenStart& start) {
  const reduction::ReducedSystem& system = start.system;
  if (!start.is_in_pieces()) return system.sliding_limit(start.state.v) / (1 - system.drive());
  return tau_of(si::without_spin(*start.experiment), system.law());
}

/// Returns time and place at which a ball with rolling friction or on a slope comes to rest; empty if it never rests.
std::optional<si::Event> rest_of(const GivenStart& start) {
  return start.motion && !start.at_rest() ? start.motion->rest() : std::nullopt;
}

/// Returns the estimate minus the stop time; 0 if both are infinite.
double error_of(const reduction::StopEstimate& estimate, const reduction::StopTime& stop) {
  return estimate.tau == stop.tau ? 0 : estimate.tau - stop.tau;
}

/// A derivative of the stop time by a variable. `by` is the name of the variable and `at` is its value.
struct Derivative {
  const char* by;
  double value, at;
};

std::vector<Derivative> derivatives(const StopReport& report) {
  const reduction::ReducedSystem& system = report.start.system;
  const reduction::State state = report.start.state;
  const reduction::StopTimeGradient& gradient = *report.gradient;
  return {{"u", gradient.by_u, state.u},
          {"v", gradient.by_v, state.v},
          {"mu", gradient.by_mu, system.mu()},
          {"chi", gradient.by_chi, system.inertia().chi},
          {"gamma", gradient.by_gamma, system.inertia().gamma},
          {"drive", gradient.by_drive, system.drive()}};
}

constexpr auto of_ball = [](const StopReport& report, auto value) {
  return report.start.experiment ? Json(value(*report.start.experiment)) : Json();
};

constexpr Field<StopReport> fields[]{
    {"law", "", "", [](const StopReport& r) -> Json { return r.start.system.law().name(); }},
    {"route", "", "names of the law of friction and of the method",
     [](const StopReport& r) -> Json { return name(r.route); }},
    {"mu", "", "", [](const StopReport& r) -> Json { return r.start.system.mu(); }},
    {"body", "", "ratio mu, and inertia of the body",
     [](const StopReport& r) -> Json {
       const auto [chi, gamma] = r.start.system.inertia();
       return {{"chi", chi}, {"gamma", gamma}};
     },
     nullptr, 1, " {`chi`, `gamma`}"},
    {"drive", "", "force of --drive, or that of rolling friction and slope",
     [](const StopReport& r) -> Json {
       const double drive = r.start.system.drive();
       return drive > 0 ? Json(drive) : Json();
     },
     nullptr, 4},
    {"pieces", "speed, 1, 1",
     "parts of the motion, if the ball turns only for a time. tau: begin; turns: true if it turns",
     [](const StopReport& r) -> Json {
       const auto pieces = r.start.pieces();
       if (pieces.size() < 2) return {};
       Json list = Json::array();
       for (const si::ReducedPiece& piece : pieces)
         list.push_back({{"tau", piece.tau}, {"turns", piece.turns}, {"drive", piece.flow.system().drive()}});
       return list;
     },
     "", 0, " [{`tau`, `turns`, `drive`}]"},
    {"u0", "speed", "", [](const StopReport& r) -> Json { return r.start.state.u; }},
    {"v0", "speed", "u and v at the start", [](const StopReport& r) -> Json { return r.start.state.v; }},
    {"tau_stop", "speed", "", [](const StopReport& r) -> Json { return r.stop.tau; }},
    {"accuracy", "speed, 1", "tau when slip and spin end; its relative error",
     [](const StopReport& r) -> Json { return r.stop.accuracy; }, nullptr, 3},
    // f g t is tau without the factor 3 pi/2
    {"T_stop", "speed", "stop time as f g t_stop = 2 tau_stop/(3 pi)",
     [](const StopReport& r) -> Json { return r.stop.tau / (1.5 * std::numbers::pi); }, nullptr, 2},
    {"bounds", "speed", "proved bounds of tau_stop; not with pieces",
     [](const StopReport& r) {
       return r.start.is_in_pieces() ? Json() : Json::array({r.stop.bounds.lower, r.stop.bounds.upper});
     },
     "lower,upper", 0, " [lower, upper]"},
    {"limits", "speed", "tau_stop if u0 were 0, and if v0 were 0",
     [](const StopReport& r) -> Json {
       return {{"sliding_only", r.sliding_only}, {"pivoting_only", r.pivoting_only}};
     },
     nullptr, 0, " {`sliding_only`, `pivoting_only`}"},
    {"other_law", "speed", "stop time under the law pade if --law is exact, and under the law exact if --law is pade",
     [](const StopReport& r) -> Json {
       if (!r.other) return {};
       return {{"law", r.other->law}, {"tau_stop", r.other->tau}};
     },
     "other_law,other_tau", 4, " {`law`, `tau_stop`}"},
    {"coarser_table", "1; speed",
     "tau_stop without every second row of the table of --law; the change shows the interpolation error",
     [](const StopReport& r) -> Json {
       if (!r.coarser) return {};
       return {{"rows", r.coarser->rows}, {"tau_stop", r.coarser->tau}};
     },
     ",coarser_tau", 4, " {`rows`, `tau_stop`}"},
    {"estimates", "speed",
     "estimates for small mu and their errors, with --estimate; * is the name of an estimate, such as E1",
     [](const StopReport& r) {
       Json estimates;
       for (const reduction::StopEstimate& of : r.estimates) {
         estimates.push_back({{"name", of.name}, {"tau_stop", of.tau}, {"error", error_of(of, r.stop)}});
       }
       return estimates;
     },
     "tau_*,error_*", 4, " [{`name`, `tau_stop`, `error`}]"},
    {"gradient", "1; speed", "derivatives of tau_stop with respect to u0, v0 and the others, with --gradient",
     [](const StopReport& r) -> Json {
       if (!r.gradient) return {};
       Json gradient;
       for (const Derivative& derivative : derivatives(r)) gradient[derivative.by] = derivative.value;
       return gradient;
     },
     "by_u,by_v,by_mu,by_chi,by_gamma,by_drive", 5, " {`u`, `v`, `mu`, `chi`, `gamma`, `drive`}"},
    {"uncertainty", "s or speed",
     "uncertainty of t_stop, without --ball of tau_stop. standard: standard deviation to first order. shares: part of "
     "standard from each input. quantiles [{probability, value}]: results of random samples. first_order_holds: true "
     "if the samples confirm standard. outside: share of impossible samples",
     [](const StopReport& r) -> Json {
       if (!r.uncertainty) return {};
       Json members = members_of(r.uncertainty->parts.front().known);
       members.update({{"samples", r.uncertainty->samples}, {"outside", r.uncertainty->outside}});
       return members;
     },
     "", 0, " {`standard`, `quantiles` [...], `shares`, `samples`, ...}"},
    {"ball", "m; kg; 1; m/s^2; m", "values of the body and of its patch",
     [](const StopReport& r) {
       return of_ball(r, [&](const auto& ball) { return members_of_ball(ball, r.start.system.law()); });
     },
     "", 0, " {`name`, `body`, `radius`, `mass`, `friction`, `gravity`, `patch_radius`, ...}"},
    {"load", "s, N", "table in the file that --load names",
     [](const StopReport& r) { return r.load ? members_of(*r.load) : Json(); }, "", 0, " {`t` [...], `load` [...]}"},
    {"slip", "m/s", "", [](const StopReport& r) { return of_ball(r, si::slip_at_start); }, ""},
    {"spin", "m/s, 1/s", "slip and spin at the start, with --ball",
     [](const StopReport& r) { return of_ball(r, si::spin_at_start); }, ""},
    {"slip_length", "m", "distance that the contact point slides, with --ball",
     [](const StopReport& r) {
       return of_ball(r, [&](const auto& /*ball*/) { return r.start.motion->slip_length(); });
     },
     ""},
    {"t_stop", "s", "time when slip and spin end, with --ball",
     [](const StopReport& r) { return of_ball(r, [&](const auto& /*ball*/) { return r.seconds(r.stop.tau); }); },
     nullptr, 4},
    {"final", "m/s, 1/s", "rolling motion after the stop time, with --ball",
     [](const StopReport& r) {
       return of_ball(r, [&](const auto& /*ball*/) -> Json {
         const auto [velocity, angular_velocity] = r.start.motion->final_motion();
         return {{"velocity", list_of(velocity)}, {"angular_velocity", list_of(angular_velocity)}};
       });
     },
     "", 0, " {`velocity` [x, y], `angular_velocity` [x, y, z]}"},
    {"rest", "s, m, m",
     "time and place at which the centre of the ball comes to rest, with rolling friction or on a slope",
     [](const StopReport& r) -> Json {
       const auto rest = rest_of(r.start);
       return rest ? members_of(*rest) : Json();
     },
     "", 0, " {`t`, `x`, `y`}"},
};

/// Writes the answer as text for people.
class Text {
 public:
  Text(const StopReport& report, const Digits& digits) : report_(report), number_(digits) {}

  std::string all() const {
    if (report_.start.at_rest()) {
      return "It neither slides nor spins: its stop time is 0.\n" + heading() +
             "\nstop time 0: the ball neither slides nor spins; it rolls already, or rests\n";
    }
    return opening() + heading() + "\n" + times() + "\n" + estimates() + gradient() + uncertainty() + methods() +
           ending();
  }

 private:
  /// Returns a sentence of plain words about the motion.
  std::string opening() const {
    const auto& [system, state, experiment, motion] = report_.start;
    const double tau = report_.stop.tau, uncoupled = std::max(report_.sliding_only, system.pivoting_limit(state.u));
    if (std::isinf(tau)) return "";
    const auto time = [&](double of) {
      return report_.start.experiment ? time_in_words(report_.seconds(of)) : "tau = " + to_two_digits(of);
    };
    const auto rest = rest_of(report_.start);
    const bool flat = experiment && experiment->ball.body.lies_flat();
    std::string text = flat           ? "It rests"
                       : state.u == 0 ? "Its slip ends"
                       : state.v == 0 ? "Its spin ends"
                                      : "Slip and spin end";
    text += " after " + time(tau);
    if (rest && !flat) text += fmt::format(", and its centre rests after {}", time_in_words(rest->t));
    const std::string says = time(uncoupled);
    return text + "; the uncoupled model says " + (says == time(tau) ? "the same to two digits" : says) + ".\n";
  }

  std::string heading() const {
    const auto& [system, state, experiment, motion] = report_.start;
    if (!experiment) {
      return fmt::format(
          "mu = {}, u0 = {}, v0 = {}; times in the unit of u0 and v0\n{}{}", number_(system.mu()), number_(state.u),
          number_(state.v), is_ball() ? "" : body_line(),
          system.drive() > 0 ? fmt::format("drive {} of f N, along the slip\n", number_(system.drive())) : "");
    }
    return ball_heading(*experiment, system.law(), number_) +
           fmt::format("slip {} m/s, spin {} rad/s: u0 = {} m/s, v0 = {} m/s\n",
                       number_(si::slip_at_start(*experiment)), number_(si::spin_at_start(*experiment)),
                       number_(state.u), number_(state.v)) +
           loading() + resistance(*experiment);
  }

  std::string loading() const {
    if (!report_.load) return "";
    const auto& times = report_.load->instants();
    return fmt::format("the load changes until {} s; tau is that of {} N\n", number_(times.back()),
                       number_(report_.load->nominal()));
  }

  /// Returns lines on rolling friction and slope, and on the pieces of the motion; empty for a ball with neither.
  std::string resistance(const si::Experiment& experiment) const {
    if (!si::is_driven(experiment)) return "";
    std::string text;
    if (const double u_r = experiment.contact.rolling_friction; u_r != 0)
      text += fmt::format("rolling friction {}\n", number_(u_r));
    if (const double slope = experiment.environment.slope; slope != 0)
      text += fmt::format("slope {} degrees, {} along x\n", number_(slope), slope > 0 ? "uphill" : "downhill");
    for (const si::ReducedPiece& piece : report_.start.pieces()) {
      text += fmt::format("from {} s on {}, with a drive of {} of f N\n", number_(si::seconds(experiment, piece.tau)),
                          piece.turns                        ? "it turns as it slides"
                          : experiment.ball.body.lies_flat() ? "it slides"
                                                             : "rolling resistance keeps it from turning",
                          number_(piece.flow.system().drive()));
    }
    return text;
  }

  bool is_ball() const {
    const auto [chi, gamma] = system_.inertia();
    return chi == reduction::homogeneous_ball.chi && gamma == reduction::homogeneous_ball.gamma;
  }

  /// Returns the law if it is a table of pressures, else null. Such a law has kinks, where no accuracy is proved.
  const reduction::TabulatedPressureLaw* pressures() const {
    return system_.law().as<reduction::TabulatedPressureLaw>();
  }

  std::string body_line() const {
    const auto [chi, gamma] = system_.inertia();
    return fmt::format("body with chi = {}, gamma = {}: r = gamma mu^2/chi = {}\n", number_(chi), number_(gamma),
                       number_(system_.r()));
  }

  std::string times() const {
    const auto& experiment = report_.start.experiment;
    const TextTable::Column number = TextTable::right(number_.width());
    TextTable table(experiment ? std::vector{TextTable::left(18), number, number}
                               : std::vector{TextTable::left(18), number});
    /// Adds a row. For a ball, the time in seconds stands before tau.
    const auto line = [&](const std::string& label, const std::string& seconds, const std::string& tau,
                          const std::string& note) {
      std::vector<std::string> cells{label, tau, note.empty() ? "" : "    " + note};
      if (experiment) cells.insert(cells.begin() + 1, seconds);
      table.add(std::move(cells));
    };
    const auto row = [&](const std::string& label, double tau, const std::string& note = "") {
      line(label, experiment ? number_(report_.seconds(tau)) : "", number_(tau), note);
    };
    const double tau = report_.stop.tau;
    line("", "t* (s)", experiment ? "tau* (m/s)" : "tau*", "");
    row("slip and spin end", tau,
        std::isinf(tau) ? "beyond the largest double: use a larger unit of speed"
                        : fmt::format("numerical error {} {:.0e} of it", pressures() ? "some" : "below",
                                      rounded_up(report_.stop.accuracy)));
    if (!report_.start.slides_and_spins()) return table.text();
    if (!report_.start.is_in_pieces()) {
      row("at least", report_.stop.bounds.lower);
      row("at most", report_.stop.bounds.upper);
    }
    row("sliding only", report_.sliding_only, "limit u0 = 0");
    row("spinning only", report_.pivoting_only, "limit v0 = 0");
    const auto beside = [&](const std::string& label, double other, const std::string& more) {
      const double percent = 100 * (other / tau - 1);
      const bool comparable = tau > 0 && std::isfinite(tau) && std::isfinite(other);
      const std::string change =
          comparable ? fmt::format("{:.2g} % {}", std::abs(percent), percent < 0 ? "shorter" : "longer") : "";
      row(label, other, change + more);
    };
    if (report_.other) beside("law " + report_.other->law, report_.other->tau, "");
    if (report_.coarser) {
      beside(fmt::format("with {} rows", report_.coarser->rows), report_.coarser->tau,
             fmt::format(": what interpolation between all {} may cost", pressures()->rows()));
    }
    return table.text();
  }

  /// Returns a number rounded up to one digit.
  static double rounded_up(double x) {
    const double place = std::pow(10, std::floor(std::log10(x)));
    return place * std::ceil(x / place - 1e-9);
  }

  std::string estimates() const {
    if (report_.estimates.empty()) return "";
    const double r = system_.r();
    const double limit = system_.law().force_slope() / system_.law().pivoting_moment();
    const TextTable::Column number = TextTable::right(number_.width());
    TextTable table({TextTable::left(18), number, number});
    table.add({"for small mu", "tau*", "error",
               fmt::format("    r = gamma mu^2/chi = {}{}", number_(r),
                           r > 0.1 * limit ? ": not small, trust none of these" : "")});
    for (const reduction::StopEstimate& estimate : report_.estimates) {
      table.add({std::string(estimate.name), number_(estimate.tau),
                 fmt::format("{:.2g}", error_of(estimate, report_.stop)), fmt::format("    {}", estimate.formula)});
    }
    return table.text() + "\n";
  }

  std::string gradient() const {
    if (!report_.gradient) return "";
    const TextTable::Column number = TextTable::right(number_.width());
    TextTable table({TextTable::left(18), number});
    table.add({"derivative by", "of tau*"});
    for (const auto& [by, value, at] : derivatives(report_)) {
      const double percent = value * at / report_.stop.tau;
      table.add({by, number_(value),
                 at == 0 ? ""
                         : fmt::format("    1 % more of it: {:.2g} % {}", std::abs(percent),
                                       percent < 0 ? "shorter" : "longer")});
    }
    return table.text() + "\n";
  }

  std::string uncertainty() const {
    if (!report_.uncertainty) return "";
    const auto& [standard, shares, quantiles, holds] = report_.uncertainty->parts.front().known;
    const char* const unit = report_.start.experiment ? " s" : "";
    std::string text = fmt::format("known to +-{}{}, one standard deviation, to first order", number_(standard), unit);
    if (shares.size() > 1) {
      double alone = 0;
      for (const auto& [name, share] : shares) {
        text += fmt::format("{}{} {}{}", &name == &shares.front().first ? ": " : ", ", name, number_(std::abs(share)),
                            unit);
        alone = std::hypot(alone, share);
      }
      constexpr double rounding = 1e-9;
      if (std::abs(alone - standard) > rounding * standard) text += ", correlated";
    }
    text += fmt::format("\n{} samples: 95 % from {} to {}{}, 68 % from {} to {}{}, median {}{}\n",
                        report_.uncertainty->samples, number_(quantiles[0]), number_(quantiles[4]), unit,
                        number_(quantiles[1]), number_(quantiles[3]), unit, number_(quantiles[2]), unit);
    return text + remarks_on(*report_.uncertainty) + "\n";
  }

  std::string methods() const {
    const reduction::Law& law = system_.law();
    return fmt::format(
        "tau*   the paper's time, (3 pi/2) f g t: it has the unit of a speed\nlaw    {}{}\nroute  {}: {}\n", law.name(),
        law.as<reduction::PadeLaw>() ? fmt::format(": the paper's approximation,\n       {}", cost_of_pade) : "",
        name(report_.route), description(report_.route));
  }

  std::string ending() const {
    const auto& [system, state, experiment, motion] = report_.start;
    if (!experiment && system.drive() > 0) return driven_ending();
    if (!experiment) {
      const double chi = system.inertia().chi;
      if (chi == 1) return "then   it lies still\n";
      return fmt::format("then   it rolls; the centre's velocity has changed by {} = {} along the slip\n",
                         is_ball() ? "-2 v0/7" : "-v0/chi", number_(0 - state.v / chi));
    }
    if (experiment->ball.body.lies_flat()) {
      return fmt::format("then   it lies still, {} m from its start\n", number_(motion->slip_length()));
    }
    const auto [velocity, angular_velocity] = motion->final_motion();
    std::string text;
    if (si::is_driven(*experiment)) {
      const auto rest = rest_of(report_.start);
      text = rest ? fmt::format("rests  after {} s at {} m\n", number_(rest->t), number_.list(rest->place))
                  : "rests  never: it rolls down the slope, faster and faster\n";
      if (rest && rest->t < motion->stop_time()) return text + "then   it spins in place until its spin ends\n";
    }
    return text + fmt::format("then   it rolls: velocity {} m/s, angular velocity {} 1/s\n       ({}, z up)\n",
                              number_.list(velocity), number_.list(angular_velocity),
                              std::holds_alternative<si::SlipAndSpin>(experiment->start) ? "x along the initial slip"
                                                                                         : "axes of the start");
  }

  std::string driven_ending() const {
    const auto ratios = reduction::terminal_ratios(system_.law(), system_.r(), system_.drive());
    std::string text;
    if (report_.start.state.u != 0 && ratios.ends.size() == 1) {
      const auto& [regime, k, from, to] = ratios.ends.front();
      text = regime == reduction::TerminalRegime::ray
                 ? fmt::format("creeps while it spins: v/(mu |u|) tends to {}, and v = 0 is no motion\n", number_(k))
                 : "it slides faster and faster beside its spin: v/(mu |u|) tends to infinity\n";
    }
    return text + "then   slip and spin are over; what the drive does to a body that rolls depends on what it is\n";
  }

  const StopReport& report_;
  const reduction::ReducedSystem& system_ = report_.start.system;
  const Digits& number_;
};

/// Returns the stop time of several successive orbits. A root search finds the end of each orbit to 2^-48.
reduction::StopTime in_pieces(const std::vector<si::ReducedPiece>& pieces) {
  double accuracy = 0;
  long evaluations = 0;
  for (const si::ReducedPiece& piece : pieces) {
    constexpr double of_root = 0x1p-48;
    accuracy += piece.orbit.accuracy() + of_root;
    evaluations += piece.orbit.evaluations();
  }
  return {si::stop_time(pieces), accuracy, evaluations, {0, infinity}};
}

}  // namespace

std::vector<FieldText> stop_fields() { return texts_of(fields); }

Answer stop_answer(const GivenStart& start, reduction::Route route, bool estimate, bool gradient,
                   const std::optional<Uncertainty>& uncertainty, const std::optional<si::LoadHistory>& load) {
  using Estimates = std::vector<reduction::StopEstimate>;
  const auto& [system, state, experiment, motion] = start;
  const auto pieces = start.pieces();
  if (pieces.size() > 1) {
    if (route != reduction::Route::quadrature) {
      throw BadInput(
          "--route {}: with this rolling friction the motion is {} orbits, one after the other, which quadrature alone "
          "joins; 'contensou roll --route integrated' gives them in steps of time",
          name(route), pieces.size());
    }
    if (estimate)
      throw BadInput("--estimate is of a motion without rolling friction and without a slope: leave it out");
    if (gradient)
      throw BadInput("--gradient is of one orbit, and this motion with rolling friction is several: leave it out");
  }
  const bool stepped = route == reduction::Route::regularised || route == reduction::Route::direct;
  std::optional<reduction::Flow> flow;
  if (!stepped || experiment || gradient) flow = start.flow(route == reduction::Route::quadrature);
  GivenStart moves = start;
  if (experiment && !si::is_driven(*experiment)) moves.motion = si::Motion::reduced(*experiment, *flow, load);
  const StopReport report{moves,
                          route,
                          pieces.size() > 1 ? in_pieces(pieces)
                          : stepped         ? reduction::stop_time(system, state, route)
                                            : flow->stop_time(state),
                          sliding_only(start),
                          pivoting_only(start),
                          other_law(start),
                          coarser_table(start),
                          estimate ? reduction::small_mu_estimates(system, state) : Estimates{},
                          gradient && !start.at_rest() ? std::optional(flow->stop_time_gradient(state)) : std::nullopt,
                          uncertainty,
                          load};
  return {
      .text = [report](const Digits& digits) { return Text(report, digits).all(); },
      .numbers = [report] { return Answer{.members = members_of(fields, report), .rows = {row_of(fields, report)}}; }};
}

}  // namespace contensou::answers
