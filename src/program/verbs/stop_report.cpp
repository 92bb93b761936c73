#include "verbs/stop_report.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/si/bridge.hpp"
#include "contensou/si/final_motion.hpp"
#include "output/columns.hpp"
#include "output/json.hpp"

namespace contensou::program {

namespace {

/// One line of the table of times.
struct TimeLine {
  std::string label;
  double tau;
  std::string note;
};

/// The two laws of the paper are of one pressure: each says how good the other is. Of another pressure they say nothing,
/// nor of a ball at rest.
std::optional<StopReport::OtherLaw> other_law(const GivenStart& start, const reduction::Law& law) {
  const auto& laws = reduction::paper_laws();
  const bool is_pade = law.as<reduction::PadeLaw>() != nullptr;
  const bool at_rest = start.state.u == 0 && start.state.v == 0;
  if (at_rest || (!is_pade && !law.as<reduction::HertzLaw>())) return std::nullopt;
  const reduction::Law& other = laws[is_pade ? 1 : 0];
  return StopReport::OtherLaw{other.name(), reduction::Flow(start.body.system(other)).stop_time(start.state).tau};
}

std::string difference(double other, double tau) {
  if (!(tau > 0) || !std::isfinite(tau) || !std::isfinite(other)) return "";
  const double percent = 100 * (other / tau - 1);
  return fmt::format("{:.2g} % {}", std::abs(percent), percent < 0 ? "shorter" : "longer");
}

/// What an estimate is too long by; 0 where both are infinite.
double error_of(const reduction::StopEstimate& estimate, const reduction::StopTime& stop) {
  return estimate.tau == stop.tau ? 0 : estimate.tau - stop.tau;
}

class TextReport {
 public:
  TextReport(const StopReport& report, int digits) : report_(report), digits_(digits) {}

  std::string text() const {
    const bool at_rest = report_.start.state.u == 0 && report_.start.state.v == 0;
    if (at_rest) return heading() + "\nstop time 0: the ball neither slides nor spins; it rolls already, or rests\n";
    return heading() + "\n" + times() + "\n" + estimates() + methods() + ending();
  }

 private:
  std::string number(double value) const { return fmt::format("{:.{}g}", value, digits_); }

  std::string heading() const {
    const auto& [body, state, shot] = report_.start;
    if (!shot) {
      return fmt::format("mu = {}, u0 = {}, v0 = {}; times in the unit of u0 and v0\n{}", number(body.mu),
                         number(state.u), number(state.v), is_ball() ? "" : body_line());
    }
    return fmt::format(
        "{}: radius {} m, mass {} kg, friction {}, patch radius {} m\n"
        "slip {} m/s, spin {} rad/s: mu = {}, u0 = {} m/s, v0 = {} m/s\n",
        shot->ball.name, number(shot->ball.radius), number(shot->ball.mass), number(shot->contact.friction),
        number(si::patch_radius_of(*shot)), number(si::slip_at_start(*shot)), number(si::spin_at_start(*shot)),
        number(body.mu), number(state.u), number(state.v));
  }

  bool is_ball() const {
    const auto [chi, gamma] = report_.system.inertia();
    return chi == reduction::homogeneous_ball.chi && gamma == reduction::homogeneous_ball.gamma;
  }

  std::string body_line() const {
    const auto [chi, gamma] = report_.system.inertia();
    return fmt::format("body with chi = {}, gamma = {}: r = gamma mu^2/chi = {}\n", number(chi), number(gamma),
                       number(report_.system.r()));
  }

  std::string certainty() const {
    if (std::isinf(report_.stop.tau)) return "beyond the largest double: use a larger unit of speed";
    return fmt::format("relative error below {:.0e}", report_.stop.accuracy);
  }

  std::string times() const {
    std::vector<TimeLine> lines{
        {"stop time", report_.stop.tau, certainty()},
        {"at least", report_.stop.bounds.lower, ""},
        {"at most", report_.stop.bounds.upper, ""},
        {"sliding only", report_.sliding_only, "limit u0 = 0"},
        {"pivoting only", report_.pivoting_only, "limit v0 = 0"},
    };
    if (const auto& other = report_.other) {
      lines.push_back({"law " + other->law, other->tau, difference(other->tau, report_.stop.tau)});
    }
    const int width = digits_ + 8;
    const auto& shot = report_.start.shot;
    std::string all = fmt::format("{:<14}{:>{}}", "", shot ? "tau* (m/s)" : "tau*", width);
    if (shot) all += fmt::format("{:>{}}", "t* (s)", width);
    all += "\n";
    for (const auto& [label, tau, note] : lines) {
      all += fmt::format("{:<14}{:>{}.{}g}", label, tau, width, digits_);
      if (shot) all += fmt::format("{:>{}.{}g}", si::seconds(*shot, tau), width, digits_);
      all += note.empty() ? "\n" : "    " + note + "\n";
    }
    return all;
  }

  std::string estimates() const {
    if (report_.estimates.empty()) return "";
    const double r = report_.system.r();
    const reduction::Law& law = report_.system.law();
    const double limit = law.force_slope() / law.pivoting_moment();
    const int width = digits_ + 8;
    std::string all = fmt::format("for small mu  {:>{}}{:>{}}    r = gamma mu^2/chi = {}{}\n", "tau*", width, "error",
                                  width, number(r), r > 0.1 * limit ? ": not small, trust none of these" : "");
    for (const reduction::StopEstimate& estimate : report_.estimates) {
      all += fmt::format("{:<14}{:>{}.{}g}{:>{}.2g}    {}\n", estimate.name, estimate.tau, width, digits_,
                         error_of(estimate, report_.stop), width, estimate.formula);
    }
    return all + "\n";
  }

  std::string methods() const {
    return fmt::format(
        "tau*   the paper's time, (3 pi/2) f g t: it has the unit of a speed\nlaw    {}\nroute  {}: {}\n",
        report_.system.law().name(), name(report_.stop.route), description(report_.stop.route));
  }

  std::string ending() const {
    const auto& [body, state, shot] = report_.start;
    if (!shot) {
      const double chi = report_.system.inertia().chi;
      if (chi == 1) return "then   it lies still\n";
      return fmt::format("then   it rolls; the centre's velocity has changed by {} = {} along the slip\n",
                         is_ball() ? "-2 v0/7" : "-v0/chi", number(0 - state.v / chi));
    }
    const si::FinalMotion motion = si::final_motion(*shot);
    return fmt::format(
        "then   it rolls: velocity ({}, {}) m/s, angular velocity ({}, {}, {}) 1/s\n"
        "       ({}, z up)\n",
        number(motion.velocity.x()), number(motion.velocity.y()), number(motion.angular_velocity.x()),
        number(motion.angular_velocity.y()), number(motion.angular_velocity.z()),
        std::holds_alternative<si::SlipAndSpin>(shot->start) ? "x along the initial slip" : "axes of the start");
  }

  const StopReport& report_;
  int digits_;
};

}  // namespace

StopReport make_stop_report(const GivenStart& start, const reduction::ReducedSystem& system, reduction::Route route) {
  const reduction::StopTime stop = reduction::stop_time(system, start.state, route);
  return {start,
          system,
          stop,
          2 * stop.tau / (3 * std::numbers::pi),
          system.sliding_limit(start.state.v),
          system.pivoting_limit(start.state.u),
          other_law(start, system.law())};
}

std::string stop_report_as_json(const StopReport& report) {
  const auto& [body, state, shot] = report.start;
  JsonObject document = JsonObject::document();
  document.add("law", json(report.system.law().name()))
      .add("route", json(name(report.stop.route)))
      .add("mu", json(body.mu))
      .add("body", JsonObject().add("chi", json(body.inertia.chi)).add("gamma", json(body.inertia.gamma)).inline_text())
      .add("u0", json(state.u))
      .add("v0", json(state.v))
      .add("tau_stop", json(report.stop.tau))
      .add("accuracy", json(report.stop.accuracy))
      .add("T_stop", json(report.T_stop))
      .add("bounds", json_array({json(report.stop.bounds.lower), json(report.stop.bounds.upper)}))
      .add("limits", JsonObject()
                         .add("sliding_only", json(report.sliding_only))
                         .add("pivoting_only", json(report.pivoting_only))
                         .inline_text());
  if (const auto& other = report.other) {
    document.add("other_law",
                 JsonObject().add("law", json(other->law)).add("tau_stop", json(other->tau)).inline_text());
  }
  if (!report.estimates.empty()) {
    std::vector<std::string> estimates;
    for (const reduction::StopEstimate& estimate : report.estimates) {
      estimates.push_back(JsonObject()
                              .add("name", json(estimate.name))
                              .add("tau_stop", json(estimate.tau))
                              .add("error", json(error_of(estimate, report.stop)))
                              .inline_text());
    }
    document.add("estimates", json_array(estimates));
  }
  if (shot) {
    const si::FinalMotion motion = si::final_motion(*shot);
    document.add("t_stop", json(si::seconds(*shot, report.stop.tau)))
        .add("final", JsonObject()
                          .add("velocity", json(Eigen::ArrayXd(motion.velocity)))
                          .add("angular_velocity", json(Eigen::ArrayXd(motion.angular_velocity)))
                          .inline_text());
  }
  return document.text();
}

std::string stop_report_as_csv(const StopReport& report) {
  const auto& [body, state, shot] = report.start;
  std::vector<std::string> names{"law",      "route", "mu",     "u0",           "v0",
                                 "tau_stop", "lower", "upper",  "sliding_only", "pivoting_only",
                                 "chi",      "gamma", "T_stop", "accuracy"};
  std::vector<std::string> values{report.system.law().name(), std::string(name(report.stop.route))};
  for (double value : {body.mu, state.u, state.v, report.stop.tau, report.stop.bounds.lower, report.stop.bounds.upper,
                       report.sliding_only, report.pivoting_only, body.inertia.chi, body.inertia.gamma, report.T_stop,
                       report.stop.accuracy}) {
    values.push_back(fmt::format("{}", value));
  }
  if (const auto& other = report.other) {
    names.insert(names.end(), {"other_law", "other_tau"});
    values.insert(values.end(), {other->law, fmt::format("{}", other->tau)});
  }
  if (shot) {
    names.emplace_back("t_stop");
    values.push_back(fmt::format("{}", si::seconds(*shot, report.stop.tau)));
  }
  for (const reduction::StopEstimate& estimate : report.estimates) {
    for (const auto& [column, value] : {std::pair{"tau_", estimate.tau}, {"error_", error_of(estimate, report.stop)}}) {
      names.push_back(column + std::string(estimate.name));
      values.push_back(fmt::format("{}", value));
    }
  }
  return csv_line(names) + csv_line(values);
}

std::string stop_report_as_text(const StopReport& report, int digits) { return TextReport(report, digits).text(); }

}  // namespace contensou::program
