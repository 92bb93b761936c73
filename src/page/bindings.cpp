// The functions of the library that the page calls from JavaScript. An error of the library becomes an Error with the
// same message. Columns are Float64Array.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include <emscripten/bind.h>
#include <emscripten/val.h>

#include "answers/asked/formula_law.hpp"
#include "answers/asked/planar_system.hpp"
#include "answers/asked/portrait_spec.hpp"
#include "contensou/portraits/layout.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/planar_portrait.hpp"
#include "contensou/portraits/render.hpp"
#include "contensou/reduction/detail/root.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "contensou/si/bounce.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/description.hpp"
#include "contensou/si/experiment.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"
#include "page/javascript.hpp"
#include "text/nearest_name.hpp"

namespace contensou::page {

using reduction::Flow;
using reduction::Law;
using reduction::Orbit;
using reduction::ReducedSystem;
using reduction::State;

Law law_of(const std::string& name) {
  static std::map<std::string, Law> known;
  if (const auto found = known.find(name); found != known.end()) return found->second;
  if (auto law = answers::find_law_or_formulas(name)) return known.emplace(name, *law).first->second;
  std::vector<std::string> names;
  for (std::string_view known_name : reduction::names_of_laws()) names.emplace_back(known_name);
  for (const reduction::LawFamily& family : reduction::law_families()) names.push_back(family.form());
  throw std::domain_error(no_such("law", name, names));
}

si::Experiment experiment_of(const val& fields) {
  si::Description described;
  for (const si::Quantity* quantity : si::quantities()) {
    const std::string name(quantity->name);
    const val given = fields[name];
    if (given.isUndefined()) continue;
    described.set(*quantity,
                  quantity->count() == 1 ? std::vector{given.as<double>()}
                                         : emscripten::convertJSArrayToNumberVector<double>(given),
                  {"", name, ""});
  }
  described.set_body(fields["body"].as<std::string>(), {"", "body", ""});
  return si::experiment_of(described);
}

namespace {

std::vector<State> states_of(const val& points) {
  std::vector<State> states;
  for (const val& point : emscripten::vecFromJSArray<val>(points)) {
    states.push_back({point["u"].as<double>(), point["v"].as<double>()});
  }
  return states;
}

/// Returns the first state in the window of the motion from a start: the start itself, or the entry into the window.
State inside(const Flow& flow, State start, const Eigen::Vector2d& sides) {
  const auto is_inside = [&](const auto& state) { return std::abs(state.u) <= sides[0] && state.v <= sides[1]; };
  if (is_inside(start)) return start;
  const Orbit orbit = flow.orbit(start);
  const auto comes_in = [&](double time) { return is_inside(orbit.at_time(time)); };
  const auto point = orbit.at_time(reduction::last_where(comes_in, orbit.stop_time(), 0));
  // Next to an axis a speed may underflow to 0. But the orbit must not become the orbit on the axis.
  constexpr double least = std::numeric_limits<double>::min();
  return {std::copysign(std::max(std::abs(point.u), least), start.u), std::max(point.v, least)};
}

/// Converts a request of portrait_request.js to the program's description of a portrait.
answers::PortraitSpec question_of(const val& asked, const Flow& flow) {
  const auto has = [&](const char* key) { return !asked[key].isNull(); };
  std::optional<si::Experiment> experiment;
  if (has("ball")) {
    experiment = experiment_of(asked["ball"]);
    experiment->ball.name = asked["ball"]["title"].as<std::string>();
  }
  answers::PortraitSpec question{.flow = flow, .experiment = experiment};
  portraits::PortraitRequest& request = question.request;
  request.view = portraits::find_view(asked["view"].as<std::string>());
  request.linear = asked["linear"].as<bool>();
  if (has("window")) {
    request.sides = Eigen::Vector2d(asked["window"][0].as<double>(), asked["window"][1].as<double>());
  }
  const std::vector<State> orbits = states_of(asked["orbits"]);
  const auto chosen = static_cast<std::size_t>(asked["chosen"].as<int>());
  if (chosen < orbits.size()) question.start = experiment ? si::reduced_start(*experiment) : orbits[chosen];
  for (std::size_t i = 0; i < orbits.size(); ++i) {
    // orbits on the axes are drawn in any case
    if (i == chosen || orbits[i].u == 0 || orbits[i].v == 0) continue;
    request.through.push_back(request.sides ? inside(question.flow, orbits[i], *request.sides) : orbits[i]);
  }
  if (asked["isochrones"].as<int>() == 0) request.isochrones = 0;  // else the default number of the program applies
  if (has("against")) request.comparison = law_of(asked["against"].as<std::string>());
  using Field = portraits::PortraitStyle::Field;
  question.style.field = asked["field"].as<std::string>() == "motion" ? Field::motion : Field::none;
  question.style.screen = asked["screen"].as<bool>();
  return question;
}

/// The phase plane that the page shows. If choose() rejects new values, the last valid plane stays.
class Plane {
 public:
  /// Sets the law, patch, body and the drive of a slope or of rolling friction. Returns the limit of k and its meaning.
  val choose(const std::string& law, double mu, double chi, double gamma, double drive) {
    flow_.emplace(ReducedSystem(law_of(law), mu, {.chi = chi, .gamma = gamma}, drive));
    level_.emplace(drive == 0 ? *flow_ : ReducedSystem(law_of(law), mu, {.chi = chi, .gamma = gamma}));
    // If the limit of k depends on the start, take k = 1, at which sliding and pivoting speeds are equal.
    const auto end = flow().terminal().end_of(1);
    return object("terminalRatio", end.k, "meaning", reduction::meaning(end.regime));
  }

  /// Draws the portrait that the program draws for a request, but without the requested orbits, which the page draws.
  val portrait(const val& asked) {
    answers::PortraitSpec question = question_of(asked, flow());
    question.request.drawn_only = true;
    question.style.asked = false;
    const portraits::PhasePortrait portrait = question.portrait();
    drawn_ = question.mapped_figure(portrait);
    const auto point = [](const State& state) { return object("u", state.u, "v", state.v); };
    return object("through", list(question.request.through, point), "window",
                  list(std::array{portrait.window.u(), portrait.window.v()}, [](double side) { return val(side); }),
                  "figure", figure_value(drawn_.figure));
  }

  /// Returns the motion of each requested orbit from start to stop and, for each panel of the last portrait, its line
  /// and arrow.
  val own(const val& asked) const {
    answers::PortraitSpec question = question_of(asked, flow());
    question.request.drawn_only = true;
    question.request.orbits = question.request.isochrones = 0;
    question.request.comparison.reset();
    const portraits::PhasePortrait portrait = question.portrait();
    val own = val::array();
    auto through = portrait.through.begin();
    for (const State& start : states_of(asked["orbits"])) {
      const int index = own["length"].as<int>();
      const bool chosen = index == asked["chosen"].as<int>(), on_axis = start.u == 0 || start.v == 0;
      const portraits::PortraitOrbit* orbit = chosen && !portrait.highlight.empty() ? &portrait.highlight[0]
                                              : chosen || on_axis                   ? nullptr
                                                                                    : &*through++;
      own.set(index, own_orbit(start, orbit, portrait.window));
    }
    return own;
  }

  /// Returns the TeX file that the program writes for a request. Only the tests use it.
  std::string portrait_file(const val& asked) const {
    const answers::PortraitSpec question = question_of(asked, flow());
    return portraits::pgfplots(question.mapped_figure(question.portrait()).figure);
  }

  /// Returns the stop time of one start.
  double stop(double u, double v) const { return flow().orbit({.u = u, .v = v}).stop_time(); }

  /// Returns the stop time of one start under another law, with the mu that belongs to that law.
  double stop_by(const std::string& law, double mu, double u, double v) const {
    const Flow other(ReducedSystem(law_of(law), mu, system().inertia(), system().drive()));
    return other.orbit({.u = u, .v = v}).stop_time();
  }

  /// Returns the motion from one start to its stop, at equal times and, while the body slides, also at dense times.
  val motion(double u, double v) const {
    const Orbit orbit = flow().orbit({.u = u, .v = v});
    const double stop = orbit.stop_time();
    constexpr int count = 120;
    std::vector<double> times;
    for (int i = 0; i <= count; ++i) times.push_back(stop * i / count);
    // Sliding may end long before the stop. Therefore steps that are fractions of the time of pure sliding are added.
    const double sliding = std::min(stop, 2 * system().sliding_limit(v));
    for (int i = 1; i < count; ++i) times.push_back(sliding * i / count);
    std::ranges::sort(times);
    const auto columns =
        orbit.at_times(Eigen::Map<const Eigen::ArrayXd>(times.data(), static_cast<Eigen::Index>(times.size())));
    return object("tau", columns.tau, "u", columns.u, "v", columns.v, "lnV", columns.ln_v, "k", columns.k);
  }

  /// Returns the friction of a state against the sliding, divided by f N; 0 at rest.
  double force(double u, double v) const {
    const double pivoting = system().mu() * std::abs(u);
    return v > 0 || pivoting > 0 ? system().law()({.sliding = v, .pivoting = pivoting}).force : 0;
  }

  /// Returns the state at tau of the motion from (u, v), and its place in each panel.
  val instant(double u, double v, double tau) const {
    const Orbit orbit = flow().orbit({.u = u, .v = v});
    const auto point = orbit.at_time(tau);
    const double left = std::max(0.0, orbit.stop_time() - point.tau);
    const Instant now{point.u, point.v, point.ln_v, std::log(point.k), left};
    return object("tau", point.tau, "u", point.u, "v", point.v, "k", point.k, "places",
                  places(now, state({u, v}, orbit.stop_time())));
  }

  /// Returns the place of a state in each panel: alternately x and y.
  val place(double u, double v) const {
    const Instant at = state({u, v}, 1);
    return column(places(at, at));
  }

  /// Returns the state at a point of a panel; null if no state belongs to the point.
  val at(int panel, double x, double y) const {
    const auto& map = drawn_.maps.at(static_cast<std::size_t>(panel));
    const auto there = map.state ? map.state({x, y}) : std::nullopt;
    return there && std::isfinite(there->u) && std::isfinite(there->v) ? object("u", there->u, "v", there->v)
                                                                       : val::null();
  }

  /// Returns the time in s at which a body ceases to slide, the path of its centre until then in m, the change of
  /// direction of this path in degrees, and the time at which slip and spin end. A ball ceases to slide when its slip
  /// has fallen to `least` m/s, a body that lies flat when it stops.
  /// @param fields  fields, see ride
  val slide(const val& fields, double rolling_friction, double least) const {
    const si::Motion motion = motion_of(fields, rolling_friction);
    const bool flat = system().inertia().chi == 1;
    const double end = motion.rolls(least);
    const auto heading = [&](double t) {
      const Eigen::Vector2d velocity = motion.at(t).velocity;
      return std::atan2(velocity.y(), velocity.x());
    };
    const double turned = flat ? 0 : std::remainder(heading(end) - heading(0), 2 * std::numbers::pi);
    return object("end", end, "path", flat ? motion.slip_length() : motion.path_length(end), "turned",
                  turned * 180 / std::numbers::pi, "stop", motion.stop_time());
  }

  /// Returns the motion over the table until `end` in s, in the columns of `contensou roll`. The times are dense at the
  /// beginning. If a ball with rolling friction or on a slope comes to rest, {t, x, y} of the rest is included.
  /// @param fields  a ball; its patch is the patch of the phase plane
  val ride(const val& fields, double rolling_friction, double end) const {
    const si::Motion moves = motion_of(fields, rolling_friction);
    constexpr Eigen::Index pieces = 160;
    const Eigen::ArrayXd times = end * Eigen::ArrayXd::LinSpaced(pieces + 1, 0, 1).square();
    const si::MotionColumns motion = moves.at(times);
    val result = object("t", motion.t, "x", motion.x, "y", motion.y, "vx", motion.vx, "vy", motion.vy, "wx", motion.wx,
                        "wy", motion.wy, "wz", motion.wz, "slip", motion.slip, "energy", motion.energy);
    if (const auto rest = moves.rest()) {
      result.set("rest", object("t", rest->t, "x", rest->place.x(), "y", rest->place.y()));
    }
    return result;
  }

  /// Returns the isochrone, the curve of all states with one stop time, in each panel, for u > 0 and for u < 0.
  val isochrone(double tau) const {
    std::vector<State> states;
    const auto add = [&](State direction) {
      const double scale = tau / flow().orbit(direction).stop_time();
      states.push_back({scale * direction.u, scale * direction.v});
    };
    add({.u = 1, .v = 0});
    // Add directions of small k. Then add equal angles of a plane in which each speed is measured by its own stop time.
    for (int decade = -8; decade <= -3; ++decade) add({.u = 1, .v = system().mu() * std::pow(10, decade)});
    const double aspect = system().pivoting_limit(1) / system().sliding_limit(1);
    constexpr int pieces = 96;
    for (int i = 1; i < pieces; ++i) {
      const double angle = std::numbers::pi / 2 * i / pieces;
      add({.u = std::cos(angle), .v = aspect * std::sin(angle)});
    }
    add({.u = 0, .v = 1});
    std::size_t panel = 0;
    const auto lines = [&](const portraits::PanelMap& map) {
      std::vector<portraits::Polyline> both(2);
      for (std::size_t i = 0; map.state && i < 2 * states.size(); ++i) {
        const State& right = states[i / 2];
        const Instant at = state({i % 2 == 0 ? right.u : -right.u, right.v}, tau);
        both[i % 2].push_back(map.place(at, at));
      }
      return column(portraits::visible(drawn_.figure.panels[panel++], both));
    };
    return list(drawn_.maps, lines);
  }

 private:
  using Instant = portraits::PortraitOrbit::Instant;

  /// Returns the flow of the chosen law and body.
  const Flow& flow() const {
    if (!flow_) throw std::domain_error("no law and body were chosen yet");
    return *flow_;
  }
  const ReducedSystem& system() const { return flow().system(); }

  /// Returns the motion of a ball with the body for which the phase plane was chosen.
  si::Motion motion_of(const val& fields, double rolling_friction) const {
    si::Experiment experiment = experiment_of(fields);
    experiment.ball.body.inertia = system().inertia();
    experiment.contact.rolling_friction = rolling_friction;
    return si::Motion::reduced(experiment, level_.value()).finite();
  }

  Instant state(State at, double left) const {
    return {at.u, at.v, std::log(at.v), std::log(at.v / (system().mu() * std::abs(at.u))), left};
  }

  std::vector<double> places(const Instant& at, const Instant& start) const {
    std::vector<double> result;
    for (const portraits::PanelMap& map : drawn_.maps) {
      const auto [x, y] = map.place(at, start);
      result.insert(result.end(), {x, y});
    }
    return result;
  }

  /// Returns a requested orbit in the form that `portrait` describes.
  /// @param drawn  orbit of the portrait through the start, if there is one; it may begin earlier, or at the window's
  ///               border
  val own_orbit(State start, const portraits::PortraitOrbit* drawn, const portraits::Window& window) const {
    const Orbit orbit = flow().orbit(start);
    const double stop = orbit.stop_time();
    portraits::PortraitOrbit rows;
    if (drawn) {
      const auto after = (drawn->tau_left < stop * (1 - 1e-12)).count();
      const Instant first = state(start, stop);
      const auto from_start = [&](double value, const Eigen::ArrayXd& column) {
        return (Eigen::ArrayXd(after + 1) << value, column.tail(after)).finished();
      };
      rows = {from_start(first.u, drawn->u), from_start(first.v, drawn->v), from_start(first.ln_v, drawn->ln_v),
              from_start(first.ln_k, drawn->ln_k), from_start(stop, drawn->tau_left)};
    }
    const bool is_seen = drawn && window.contains(start);
    val own = is_seen ? object("tau", Eigen::ArrayXd(stop - rows.tau_left), "u", rows.u, "v", rows.v, "k",
                               Eigen::ArrayXd(rows.ln_k.exp()))
                      : motion(start.u, start.v);
    std::size_t panel = 0;
    const auto in_panel = [&](const portraits::PanelMap& map) {
      const portraits::Panel& axes = drawn_.figure.panels[panel++];
      const auto line = drawn ? portraits::visible(axes, {map.line(rows)}) : std::vector<portraits::Polyline>();
      constexpr double shortest = 0.06;  // a fraction of a side of the panel
      const auto length = [&](const portraits::Polyline& part) { return portraits::paper_length(axes, part); };
      const auto longest = std::ranges::max_element(line, {}, length);
      std::vector<double> arrow;
      if (longest != line.end() && length(*longest) > shortest) {
        const auto [tip, direction] = portraits::arrow_along(axes, *longest, 0.4);
        arrow = {tip.x, tip.y, direction.x, direction.y};
      }
      return object("line", line, "arrow", arrow);
    };
    own.set("stop", stop);
    own.set("panels", list(drawn_.maps, in_panel));
    return own;
  }

  std::optional<Flow> flow_, level_;  ///< level_: the same flow, but without a drive
  portraits::MappedFigure drawn_;     ///< the last portrait
};

/// Returns {name, meaning} of each law; for a family of laws also {letter, example} of its parameter.
val laws() {
  val all = list(reduction::names_of_laws(), [](std::string_view name) {
    return object("name", name, "meaning", reduction::meaning_of_law(name));
  });
  for (const reduction::LawFamily& family : reduction::law_families()) {
    all.call<void>("push", object("name", family.name, "meaning", family.meaning, "letter", family.letter, "example",
                                  family.example));
  }
  return all;
}

/// Returns the name of a law in the library.
std::string law_name(const std::string& called) { return law_of(called).name(); }

/// Returns the start (start_value) that a stroke with a cue gives to a ball.
/// The arguments are those of si::CueStrike.
val struck(const val& fields, double speed, double right, double above, double elevation) {
  si::Experiment experiment = experiment_of(fields);
  experiment.start =
      si::struck(experiment.ball, {.speed = speed, .right = right, .above = above, .elevation = elevation});
  return start_value(experiment);
}

/// Returns the rebound of a ball that falls from a height in m with the motion of its start: {down, up: normal speeds,
/// before, after: speeds along the floor, in m/s}.
/// @param as_built  true for the patch of the catalogue, which by Hertz's formula depends on the impact
val bounce(const std::string& law, const val& fields, bool as_built, double height, double restitution) {
  si::Experiment experiment = experiment_of(fields);
  if (as_built) experiment.contact.patch = si::find_ball(fields["name"].as<std::string>())->experiment.contact.patch;
  const si::Impact impact{si::drop_speed(height, experiment.environment.gravity), restitution};
  const si::Velocities after = si::bounce(experiment, law_of(law), impact).velocities;
  return object("down", impact.normal_speed, "up", restitution * impact.normal_speed, "before",
                si::velocities_of(experiment.start).velocity.norm(), "after", after.velocity.norm());
}

/// Returns the figure that `contensou portrait --system` draws, in the window that the library chooses.
/// @param points  points of orbits in this window; x and y in turn
/// @param screen  light on dark
val typed_portrait(const std::string& typed, const val& points, bool screen) {
  static std::string name;
  static std::optional<answers::FormulaField> field;
  static std::optional<reduction::PlanarReduction> plane;
  static portraits::PortraitRequest request;
  if (typed != name || !request.window) {
    name.clear();
    request = {};
    field = answers::parse_planar_system(typed, {});
    plane = reduction::reduce(*field, reduction::valued_near(*field, {1, 1}));
    request.window = planar_portrait(*plane, typed, request).window;
    name = typed;
  }
  const auto numbers = emscripten::convertJSArrayToNumberVector<double>(points);
  request.through.clear();
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) request.through.push_back({numbers[i], numbers[i + 1]});
  portraits::PlanarPortrait portrait = planar_portrait(*plane, typed, request);
  portrait.variables = {field->variables.at(0), field->variables.at(1)};
  return figure_value(draw(portrait, {.screen = screen}));
}

/// Returns {name, chi, gamma} of each body, and `mu` if the body fixes it.
val bodies() {
  return list(si::bodies(), [](const si::Body& body) {
    val value = object("name", body.name, "chi", body.inertia.chi, "gamma", body.inertia.gamma);
    if (body.patch_ratio) value.set("mu", *body.patch_ratio);
    return value;
  });
}

/// Returns for each view of the page {name, layered: true if it has isochrones and a field}. The other views are the
/// program's alone.
val views() {
  using portraits::View;
  constexpr std::array shown{View::uv, View::log, View::blowup, View::disc};
  return list(shown, [](portraits::View view) {
    return object("name", portraits::name(view), "layered", portraits::shows_window(view));
  });
}

val catalogue() {
  return list(si::catalogue(), [](const si::CatalogueEntry& entry) {
    const auto& [ball, contact, start, environment, spreads] = entry.experiment;
    const auto* by_spin = std::get_if<si::SpinDeceleration>(&contact.patch);
    const bool whole = std::holds_alternative<si::WholeFace>(contact.patch);
    return object(
        "name", entry.name, "title", ball.name, "mass", ball.mass, "radius", ball.radius, "friction", contact.friction,
        "gravity", environment.gravity, "body", ball.body.name, "law", si::law_of(entry.experiment), "patchBy",
        whole     ? "whole_face"
        : by_spin ? "spin_deceleration"
                  : "patch_radius",
        "patch", by_spin ? by_spin->value : si::patch_radius_of(entry.experiment, reduction::HertzLaw{}), "slip",
        si::slip_at_start(entry.experiment), "spin", si::spin_at_start(entry.experiment), "sources", entry.sources);
  });
}

/// Returns the reason why the phase plane cannot show a motion with rolling friction; empty if it can. Rolling friction
/// may turn the slip, or prevent the ball from turning at first.
std::string without_rolling_friction(const si::Experiment& experiment, const Law& law) {
  const double u_r = experiment.contact.rolling_friction;
  const State start = si::reduced_start(experiment);
  if (u_r == 0 || (start.u == 0 && start.v == 0)) return "";
  try {
    (void)si::drive_of(experiment);
    const auto pieces = si::Motion::reduced(experiment, law).pieces();
    return pieces.size() == 1 && pieces.front().turns ? "" : "it keeps this ball from turning at first";
  } catch (const std::domain_error& error) {
    return error.what();
  }
}

/// Returns a ball's phase plane as data. Its drive has slope and rolling friction, or `without` says why slope only.
val contact(const std::string& law, const val& fields) {
  si::Experiment experiment = experiment_of(fields);
  const std::string without = without_rolling_friction(experiment, law_of(law));
  if (!without.empty()) experiment.contact.rolling_friction = 0;
  const double radius = si::patch_radius_of(experiment, law_of(law));
  // The patch radius is proportional to the measured deceleration.
  const double per_deceleration = si::patch_radius_of_deceleration(
      experiment.ball.radius, 1, experiment.contact.friction, experiment.environment.gravity,
      law_of(law).pivoting_moment(), experiment.ball.body.inertia.gamma);
  return object("mu", si::patch_ratio(experiment, law_of(law)), "patchRadius", radius, "spinDeceleration",
                radius / per_deceleration, "momentArm",
                experiment.contact.friction * radius * law_of(law).pivoting_moment(), "secondsPerTau",
                si::seconds(experiment, 1), "drive", si::drive_of(experiment), "without", without);
}

}  // namespace

}  // namespace contensou::page

EMSCRIPTEN_BINDINGS(contensou) {
  using namespace contensou::page;
  using emscripten::function;
  emscripten::class_<Plane>("Plane")
      .constructor<>()
      .function("choose", answering<&Plane::choose>)
      .function("portrait", answering<&Plane::portrait>)
      .function("own", answering<&Plane::own>)
      .function("portraitFile", answering<&Plane::portrait_file>)
      .function("stop", answering<&Plane::stop>)
      .function("stopBy", answering<&Plane::stop_by>)
      .function("motion", answering<&Plane::motion>)
      .function("force", answering<&Plane::force>)
      .function("instant", answering<&Plane::instant>)
      .function("place", answering<&Plane::place>)
      .function("at", answering<&Plane::at>)
      .function("slide", answering<&Plane::slide>)
      .function("ride", answering<&Plane::ride>)
      .function("isochrone", answering<&Plane::isochrone>);
  function("laws", &laws);
  function("lawName", answering<law_name>);
  function("bodies", &bodies);
  function("views", &views);
  function("catalogue", &catalogue);
  function("contact", answering<contact>);
  function("struck", answering<struck>);
  function("bounce", answering<bounce>);
  function("typedPortrait", answering<typed_portrait>);
  function("layOut", answering<layout_value>);
  function("rowsOf", &rows_of);
  emscripten::constant("rollingSlip", contensou::si::rolling_slip);
  emscripten::constant("cueMass", contensou::si::standard_cue_mass);
  emscripten::constant("largestTipOffset", contensou::si::largest_tip_offset);
}
