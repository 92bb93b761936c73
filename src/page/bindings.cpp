// What the page asks of the library, as functions of JavaScript.
//
// Every function answers with an object, and with {error: message} for what the library rejects: an exception of C++
// would reach JavaScript without its message. Columns are Float64Array.
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
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
#include "contensou/reduction/terminal_ratio.hpp"
#include "contensou/reduction/verification.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"
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

/// Laws are kept: some of them begin with a table.
Law law_of(const std::string& name) {
  static std::map<std::string, Law> known;
  if (const auto found = known.find(name); found != known.end()) return found->second;
  if (auto law = reduction::find_law(name)) return known.emplace(name, *law).first->second;
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
      facts.set("regime", static_cast<int>(end.regime));
      facts.set("terminalRatio", end.k);
      return facts;
    });
  }

  /// Of the law and body that were chosen.
  const Flow& flow() const {
    if (!flow_) throw std::domain_error("no law and body were chosen yet");
    return *flow_;
  }

  /// The stop time of one start.
  val stop(double u, double v) const {
    return answer([&] {
      val result = val::object();
      result.set("tau", flow().orbit({.u = u, .v = v}).stop_time());
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

  /// One instant of the motion from one start, and the friction there as a share of f N.
  val instant(double u, double v, double tau) const {
    return answer([&] {
      const auto point = flow().orbit({.u = u, .v = v}).at_time(tau);
      val result = val::object();
      result.set("tau", point.tau);
      result.set("u", point.u);
      result.set("v", point.v);
      result.set("lnV", point.ln_v);
      result.set("k", point.k);
      const double pivoting = system().mu() * std::abs(point.u);
      const bool moves = point.v > 0 || pivoting > 0;
      result.set("force", moves ? system().law()({.sliding = point.v, .pivoting = pivoting}).force : 0);
      return result;
    });
  }

  /// When the slip of one start has fallen to `least`, and how long the path is that it slides until it stops.
  val slide(double u, double v, double least) const {
    return answer([&] {
      const Orbit orbit = flow().orbit({.u = u, .v = v});
      double faster = 0;
      double slower = v > least ? orbit.stop_time() : 0;
      for (int i = 0; i < 60; ++i) {
        const double middle = (faster + slower) / 2;
        (orbit.at_time(middle).v > least ? faster : slower) = middle;
      }
      val result = val::object();
      result.set("end", slower);
      result.set("length", orbit.slip_length(orbit.stop_time()));
      return result;
    });
  }

  /// In equal times until `end`: the path that one start has slid, and its spin.
  val course(double u, double v, double end) const {
    return answer([&] {
      const Orbit orbit = flow().orbit({.u = u, .v = v});
      constexpr Eigen::Index pieces = 160;
      const Eigen::ArrayXd times = Eigen::ArrayXd::LinSpaced(pieces + 1, 0, end);
      std::vector<double> slid;
      for (const double tau : times) slid.push_back(orbit.slip_length(tau));
      val result = val::object();
      result.set("slid", column(slid));
      result.set("u", column(orbit.at_times(times).u));
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

/// {name, meaning} of each law, and of each family also what its number is: {letter, allowed, example}.
val laws() {
  val all = val::array();
  const auto add = [&](std::string_view name, std::string_view meaning) {
    val law = val::object();
    law.set("name", std::string(name));
    law.set("meaning", std::string(meaning));
    all.call<void>("push", law);
    return law;
  };
  for (const Law& law : reduction::named_laws()) add(law.name(), reduction::meaning_of_law(law.name()));
  for (const reduction::LawFamily& family : reduction::law_families()) {
    val law = add(family.name, family.meaning);
    law.set("letter", std::string(family.letter));
    law.set("example", family.example);
  }
  return all;
}

/// The name of the law that is called so, as the library writes it.
val law_name(const std::string& called) {
  return answer([&] {
    val result = val::object();
    result.set("name", law_of(called).name());
    return result;
  });
}

/// {name, chi, gamma} of each body, and `mu` of one that decides it.
val bodies() {
  val all = val::array();
  for (const si::Body& body : si::bodies()) {
    val value = val::object();
    value.set("name", std::string(body.name));
    value.set("chi", body.inertia.chi);
    value.set("gamma", body.inertia.gamma);
    if (body.patch_ratio) value.set("mu", *body.patch_ratio);
    all.call<void>("push", value);
  }
  return all;
}

/// The fields of a ball on the page, in SI units; `patch` is a radius in m or a spin deceleration in rad/s^2, or nothing
/// where a body rests on its whole face.
si::Experiment experiment_of(const val& fields) {
  const auto number = [&](const char* key) { return fields[key].as<double>(); };
  const double patch = number("patch");
  si::Experiment experiment{.ball = {.name = "ball", .mass = number("mass"), .radius = number("radius")},
                            .contact = {.friction = number("friction"), .patch = si::PatchRadius{patch}},
                            .start = si::Velocities{{number("velocityX"), number("velocityY")},
                                                    {number("omegaX"), number("omegaY"), number("omegaZ")}},
                            .environment = {.gravity = number("gravity")}};
  const auto known_by = fields["patchBy"].as<std::string>();
  if (known_by == "spin_deceleration") experiment.contact.patch = si::SpinDeceleration{patch};
  if (known_by == "whole_face") experiment.contact.patch = si::WholeFace{};
  experiment.ball.body = *std::ranges::find(si::bodies(), fields["body"].as<std::string>(), &si::Body::name);
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
    const auto* by_spin = std::get_if<si::SpinDeceleration>(&entry.experiment.contact.patch);
    val ball = val::object();
    ball.set("name", entry.name);
    ball.set("title", entry.experiment.ball.name);
    ball.set("mass", entry.experiment.ball.mass);
    ball.set("radius", entry.experiment.ball.radius);
    ball.set("friction", entry.experiment.contact.friction);
    ball.set("gravity", entry.experiment.environment.gravity);
    ball.set("body", std::string(entry.experiment.ball.body.name));
    ball.set("law", si::law_of(entry.experiment));
    const bool whole = std::holds_alternative<si::WholeFace>(entry.experiment.contact.patch);
    ball.set("patchBy", std::string(whole ? "whole_face" : by_spin ? "spin_deceleration" : "patch_radius"));
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
    const double radius = si::patch_radius_of(experiment, law_of(law));
    result.set("patchRadius", radius);
    // The one is proportional to the other.
    const double per_deceleration = si::patch_radius_of_deceleration(
        experiment.ball.radius, 1, experiment.contact.friction, experiment.environment.gravity,
        law_of(law).pivoting_moment(), experiment.ball.body.inertia.gamma);
    result.set("spinDeceleration", radius / per_deceleration);
    result.set("secondsPerTau", si::seconds(experiment, 1));
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
      .function("slide", &Plane::slide)
      .function("course", &Plane::course)
      .function("isochrone", &Plane::isochrone)
      .function("checks", &Plane::checks);
  emscripten::function("portrait", &contensou::page::portrait);
  emscripten::function("portraitFile", &contensou::page::portrait_file);
  emscripten::function("laws", &contensou::page::laws);
  emscripten::function("lawName", &contensou::page::law_name);
  emscripten::function("bodies", &contensou::page::bodies);
  emscripten::function("catalogue", &contensou::page::catalogue);
  emscripten::function("contact", &contensou::page::contact);
  emscripten::constant("rollingSlip", contensou::si::rolling_slip);
}
