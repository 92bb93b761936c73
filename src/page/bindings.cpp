// What the page asks of the library, as functions of JavaScript.
//
// Every function answers with an object, and with {error: message} for what the library rejects: an exception of C++
// would reach JavaScript without its message. Columns are Float64Array.
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <fmt/format.h>

#include "contensou/portraits/pgfplots.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pressure_law.hpp"
#include "contensou/reduction/terminal_ratio.hpp"
#include "contensou/reduction/verification.hpp"
#include "contensou/si/ball_motion.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"
#include "contensou/si/uncoupled_motion.hpp"
#include "javascript.hpp"
#include "program/options/portrait_spec.hpp"

namespace contensou::page {

namespace {

using emscripten::val;
using reduction::Flow;
using reduction::Law;
using reduction::Orbit;
using reduction::ReducedSystem;
using reduction::State;

/// The answer of a function, or what the library says against the question.
template <class Function>
val answer(Function function) {
  try {
    return function();
  } catch (const std::exception& error) {
    val rejected = val::object();
    rejected.set("error", std::string(error.what()));
    return rejected;
  }
}

Law law_of(const std::string& name) {
  if (auto law = reduction::find_law(name)) return *law;
  throw std::domain_error(fmt::format("no such law: {}", name));
}

/// The plane that the page shows. A plane that was rejected leaves the last good one in place.
class Plane {
 public:
  /// Changes law, patch and body.
  val choose(const std::string& law, double mu, double chi, double gamma) {
    return answer([&] {
      flow_.emplace(ReducedSystem(law_of(law), mu, {.chi = chi, .gamma = gamma}));
      // Of the motions that slide and pivot at one speed, if it depends on the start.
      const auto end = flow().terminal().end_of(1);
      val facts = val::object();
      facts.set("r", system().r());
      facts.set("regime", static_cast<int>(end.regime));
      facts.set("terminalRatio", end.k);
      facts.set("slidingLimit", system().sliding_limit(1));
      facts.set("pivotingLimit", system().pivoting_limit(1));
      return facts;
    });
  }

  /// Of the law and body that were chosen.
  const Flow& flow() const {
    if (!flow_) throw std::domain_error("no law and body were chosen yet");
    return *flow_;
  }

  /// The stop time of one start, its bounds and its limits.
  val stop(double u, double v) const {
    return answer([&] {
      const State start{.u = u, .v = v};
      const auto bounds = system().stop_time_bounds(start);
      val result = val::object();
      result.set("tau", flow().orbit(start).stop_time());
      result.set("lower", bounds.lower);
      result.set("upper", bounds.upper);
      result.set("slidingOnly", system().sliding_limit(v));
      result.set("pivotingOnly", system().pivoting_limit(u));
      return result;
    });
  }

  /// The motion from one start to its stop: dense while it slides, and in equal times.
  val motion(double u, double v) const {
    return answer([&] {
      const Orbit orbit = flow().orbit({.u = u, .v = v});
      const double stop = orbit.stop_time();
      constexpr int instants = 120;
      std::vector<double> times;
      for (int i = 0; i <= instants; ++i) times.push_back(stop * i / instants);
      // Sliding may be over long before the stop: also in steps of the time that sliding alone takes.
      const double sliding = std::min(stop, 2 * system().sliding_limit(v));
      for (int i = 1; i < instants; ++i) times.push_back(sliding * i / instants);
      std::ranges::sort(times);
      const auto columns =
          orbit.at_times(Eigen::Map<const Eigen::ArrayXd>(times.data(), static_cast<Eigen::Index>(times.size())));
      val result = val::object();
      result.set("stop", stop);
      result.set("tau", column(columns.tau));
      result.set("u", column(columns.u));
      result.set("v", column(columns.v));
      result.set("lnV", column(columns.ln_v));
      result.set("k", column(columns.k));
      return result;
    });
  }

  /// One instant of the motion from one start.
  val instant(double u, double v, double tau) const {
    return answer([&] {
      const auto point = flow().orbit({.u = u, .v = v}).at_time(tau);
      val result = val::object();
      result.set("tau", point.tau);
      result.set("u", point.u);
      result.set("v", point.v);
      result.set("lnV", point.ln_v);
      result.set("k", point.k);
      return result;
    });
  }

  /// A state of the motion from one start that lies in the window: the start itself, or where it comes in.
  val inside(double u, double v, double window_u, double window_v) const {
    return answer([&] {
      const auto is_inside = [&](State state) { return std::abs(state.u) <= window_u && state.v <= window_v; };
      State state{.u = u, .v = v};
      if (!is_inside(state)) {
        const Orbit orbit = flow().orbit(state);
        double outside = 0;
        double inside = orbit.stop_time();
        for (int i = 0; i < 60; ++i) {
          const double middle = (outside + inside) / 2;
          const auto point = orbit.at_time(middle);
          (is_inside({point.u, point.v}) ? inside : outside) = middle;
        }
        // Next to an axis a speed may underflow; the orbit is not the axis.
        constexpr double least = std::numeric_limits<double>::min();
        const auto point = orbit.at_time(inside);
        state.u = u == 0 ? 0 : std::copysign(std::max(std::abs(point.u), least), u);
        state.v = v == 0 ? 0 : std::max(point.v, least);
      }
      val result = val::object();
      result.set("u", state.u);
      result.set("v", state.v);
      return result;
    });
  }

  /// All states with u >= 0 that stop after the time 1; another isochrone is this one times its time.
  val isochrone() const {
    return answer([&] {
      std::vector<double> us;
      std::vector<double> vs;
      const auto add = [&](State direction) {
        const double scale = 1 / flow().orbit(direction).stop_time();
        us.push_back(scale * direction.u);
        vs.push_back(scale * direction.v);
      };
      add({.u = 1, .v = 0});
      // Even in angle where both speeds take the same time to stop, and down to small k.
      for (int decade = -8; decade <= -3; ++decade) add({.u = 1, .v = system().mu() * std::pow(10, decade)});
      const double aspect = system().pivoting_limit(1) / system().sliding_limit(1);
      constexpr int pieces = 96;
      for (int i = 1; i < pieces; ++i) {
        const double angle = std::numbers::pi / 2 * i / pieces;
        add({.u = std::cos(angle), .v = aspect * std::sin(angle)});
      }
      add({.u = 0, .v = 1});
      val result = val::object();
      result.set("u", column(us));
      result.set("v", column(vs));
      return result;
    });
  }

  /// The table of checks of one start.
  val checks(double u, double v) const {
    return answer([&] {
      val rows = val::array();
      for (const auto& check : reduction::verify(flow(), State{.u = u, .v = v})) {
        val row = val::object();
        row.set("name", check.name);
        row.set("measured", check.measured);
        row.set("allowed", check.allowed);
        row.set("passed", check.passed());
        rows.call<void>("push", row);
      }
      val result = val::object();
      result.set("rows", rows);
      return result;
    });
  }

 private:
  const ReducedSystem& system() const { return flow().system(); }

  std::optional<Flow> flow_;
};

/// Of the laws pressure:P.
double largest_exponent() { return reduction::PressureLaw::max_p; }

val names_of_laws() {
  val names = val::array();
  for (const Law& law : reduction::named_laws()) names.call<void>("push", law.name());
  return names;
}

/// The fields of a ball on the page, in SI units; `patch` is a radius in m or a spin deceleration in rad/s^2.
si::Experiment experiment_of(const val& fields) {
  const auto number = [&](const char* key) { return fields[key].as<double>(); };
  const double patch = number("patch");
  si::Experiment experiment{.ball = {.name = "ball", .mass = number("mass"), .radius = number("radius")},
                            .contact = {.friction = number("friction"), .patch = si::PatchRadius{patch}},
                            .start = si::Velocities{{number("velocityX"), number("velocityY")},
                                                    {number("omegaX"), number("omegaY"), number("omegaZ")}},
                            .environment = {.gravity = number("gravity")}};
  if (fields["patchBy"].as<std::string>() == "spin_deceleration")
    experiment.contact.patch = si::SpinDeceleration{patch};
  si::require_experiment(experiment);
  return experiment;
}

/// The question of portrait_request.js.
/// @param known  the flow, where it is known
program::PortraitSpec question_of(const val& asked, const Flow* known = nullptr) {
  const auto has = [&](const char* key) { return !asked[key].isNull(); };
  const auto state = [](const val& point) { return State{point["u"].as<double>(), point["v"].as<double>()}; };
  std::optional<si::Experiment> experiment;
  if (has("ball")) {
    experiment = experiment_of(asked["ball"]);
    experiment->ball.name = asked["ball"]["title"].as<std::string>();
  }
  const auto flow = [&]() -> Flow {
    if (known) return *known;
    const Law law = law_of(asked["law"].as<std::string>());
    return ReducedSystem(law, experiment ? si::patch_ratio(*experiment, law) : asked["mu"].as<double>(),
                         {.chi = asked["chi"].as<double>(), .gamma = asked["gamma"].as<double>()});
  };
  program::PortraitSpec question{.flow = flow(), .experiment = experiment};
  if (experiment) {
    question.start = si::reduced_start(*experiment);
  } else if (has("start")) {
    question.start = state(asked["start"]);
  }
  portraits::PortraitRequest& request = question.request;
  request.view = portraits::find_view(asked["view"].as<std::string>());
  if (has("window")) {
    request.window = portraits::Window{asked["window"][0].as<double>(), asked["window"][1].as<double>()};
  }
  for (const val& point : emscripten::vecFromJSArray<val>(asked["through"])) request.through.push_back(state(point));
  request.isochrones = asked["isochrones"].as<int>();
  if (has("against")) request.comparison = law_of(asked["against"].as<std::string>());
  const auto field = asked["field"].as<std::string>();
  using Field = portraits::PortraitStyle::Field;
  question.style.field = field == "motion" ? Field::motion : field == "regularised" ? Field::regularised : Field::none;
  question.style.screen = asked["screen"].as<bool>();
  return question;
}

/// What the program draws when asked so of the plane's system; but the orbits that were asked for come by themselves,
/// for the page to draw.
val portrait(const val& asked, const Plane& plane) {
  return answer([&] {
    program::PortraitSpec question = question_of(asked, &plane.flow());
    question.request.drawn_only = true;
    question.style.asked = false;
    const portraits::PhasePortrait portrait = question.portrait();
    val through = val::array();
    for (const portraits::PortraitOrbit& orbit : portrait.through) through.call<void>("push", orbit_value(orbit));
    val result = val::object();
    result.set("figure", figure_value(question.figure(portrait)));
    result.set("windowU", portrait.window.u);
    result.set("windowV", portrait.window.v);
    result.set("exponent", portrait.scale.exponent);
    result.set("through", through);
    result.set("highlight", portrait.highlight ? orbit_value(*portrait.highlight) : val::null());
    return result;
  });
}

/// The file that the program writes when asked so.
val portrait_file(const val& asked, const std::string& ending) {
  return answer([&] {
    const program::PortraitSpec question = question_of(asked);
    const portraits::PhasePortrait portrait = question.portrait();
    val result = val::object();
    result.set("text", ending == "tex"    ? portraits::pgfplots(question.figure(portrait))
                       : ending == "json" ? portraits::to_json(portrait, question.source())
                                          : portraits::to_csv(portrait, question.source()));
    return result;
  });
}

val catalogue() {
  val balls = val::array();
  for (const si::CatalogueEntry& entry : si::catalogue()) {
    if (entry.experiment.ball.body.lies_flat()) continue;  // the page has balls
    const auto* by_spin = std::get_if<si::SpinDeceleration>(&entry.experiment.contact.patch);
    val ball = val::object();
    ball.set("name", entry.name);
    ball.set("title", entry.experiment.ball.name);
    ball.set("mass", entry.experiment.ball.mass);
    ball.set("radius", entry.experiment.ball.radius);
    ball.set("friction", entry.experiment.contact.friction);
    ball.set("gravity", entry.experiment.environment.gravity);
    ball.set("patchBy", std::string(by_spin ? "spin_deceleration" : "patch_radius"));
    ball.set("patch", by_spin ? by_spin->value : si::patch_radius_of(entry.experiment, reduction::HertzLaw{}));
    ball.set("slip", si::slip_at_start(entry.experiment));
    ball.set("spin", si::spin_at_start(entry.experiment));
    ball.set("sources", entry.sources);
    balls.call<void>("push", ball);
  }
  return balls;
}

/// What the plane needs to know of a ball.
val contact(const std::string& law, const val& fields) {
  return answer([&] {
    const si::Experiment experiment = experiment_of(fields);
    val result = val::object();
    result.set("mu", si::patch_ratio(experiment, law_of(law)));
    result.set("patchRadius", si::patch_radius_of(experiment, law_of(law)));
    result.set("secondsPerTau", si::seconds(experiment, 1));
    return result;
  });
}

/// The whole motion of a ball on the table, until it rolls and a little on; beside the textbook's, in which sliding and
/// spinning do not know of each other.
val roll(const std::string& law, const val& fields) {
  return answer([&] {
    const si::Experiment experiment = experiment_of(fields);
    const si::BallMotion motion(experiment, law_of(law));
    constexpr int instants = 240;
    const si::UncoupledMotion textbook(experiment, law_of(law));
    const double rolls = motion.slip_time(si::rolling_slip);
    const double end = rolls > 0 ? 1.6 * rolls : motion.stop_time();
    const Eigen::ArrayXd times = Eigen::ArrayXd::LinSpaced(instants + 1, 0, end);
    const auto columns = motion.at_times(times);
    const auto textbook_columns = textbook.at_times(times);
    const si::FinalMotion final = si::final_motion(experiment);
    val result = val::object();
    result.set("t", column(columns.t));
    result.set("x", column(columns.x));
    result.set("y", column(columns.y));
    result.set("textbookX", column(textbook_columns.x));
    result.set("textbookY", column(textbook_columns.y));
    result.set("textbookRollsAfter", textbook.slip_time(si::rolling_slip));
    result.set("rollsAfter", rolls);
    result.set("stop", motion.stop_time());
    result.set("slipLength", motion.slip_length());
    result.set("finalX", final.velocity.x());
    result.set("finalY", final.velocity.y());
    const auto there = motion.at_time(rolls);
    result.set("rollsAtX", there.position.x());
    result.set("rollsAtY", there.position.y());
    return result;
  });
}

/// Where a ball is at one instant.
val place(const std::string& law, const val& fields, double t) {
  return answer([&] {
    const auto point = si::BallMotion(experiment_of(fields), law_of(law)).at_time(t);
    val result = val::object();
    result.set("x", point.position.x());
    result.set("y", point.position.y());
    return result;
  });
}

}  // namespace

}  // namespace contensou::page

EMSCRIPTEN_BINDINGS(contensou) {
  using contensou::page::Plane;
  emscripten::class_<Plane>("Plane")
      .constructor<>()
      .function("choose", &Plane::choose)
      .function("inside", &Plane::inside)
      .function("stop", &Plane::stop)
      .function("motion", &Plane::motion)
      .function("instant", &Plane::instant)
      .function("isochrone", &Plane::isochrone)
      .function("checks", &Plane::checks);
  emscripten::function("portrait", &contensou::page::portrait);
  emscripten::function("portraitFile", &contensou::page::portrait_file);
  emscripten::function("largestExponent", &contensou::page::largest_exponent);
  emscripten::function("namesOfLaws", &contensou::page::names_of_laws);
  emscripten::function("catalogue", &contensou::page::catalogue);
  emscripten::function("contact", &contensou::page::contact);
  emscripten::function("roll", &contensou::page::roll);
  emscripten::function("place", &contensou::page::place);
}
