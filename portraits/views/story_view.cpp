// One motion beside the uncoupled model, with drawings of the contact patch: why a body that spins slides so far.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "data/round_numbers.hpp"
#include "views/portrait_views.hpp"

namespace contensou::portraits {

using std::numbers::pi;

namespace {

/// Returns the motion to tell of: the requested one, else one that spins faster than it slides.
PortraitOrbit told(const PhasePortrait& portrait) {
  const auto moves = [](const PortraitOrbit& orbit) { return orbit.u[0] != 0 && orbit.v[0] != 0; };
  if (!portrait.highlight.empty() && moves(portrait.highlight.front())) return portrait.highlight.front();
  constexpr double usual_k = 0.3;
  return orbit_through(portrait.flow, std::log(usual_k), std::log(portrait.window.v()), 0);
}

/// Adds a drawing of the patch at a state, seen from above while the body slides to the right: velocities of its points
/// relative to the plane, and the part of the friction that opposes the slide.
/// @param middle, radius  place and size of the drawing, as fractions of the panel's sides
void add_patch(Panel& panel, const Drawing& drawing, const Instant& at, Point middle, Point radius, bool first) {
  const double k = std::exp(at.ln_k), sense = at.u < 0 ? -1 : 1;
  const auto on_disc = [&](double x, double y) {
    return from_paper(panel, {middle.x + radius.x * x, middle.y + radius.y * y});
  };
  constexpr int sides = 72;
  Polyline rim;
  for (int i = 0; i <= sides; ++i) rim.push_back(on_disc(std::cos(2 * pi * i / sides), std::sin(2 * pi * i / sides)));
  panel.lines.push_back({{std::move(rim)}, {drawing.palette.invariant, 1}, ""});
  // In units of mu |u| a point (x, y) of the patch moves at (k - y, x), or at (k + y, -x) with the other sense of spin.
  Lines shafts{{}, {drawing.palette.orbit, 1.3}, first ? "velocity of the patch, from above" : ""};
  Arrows heads{{}, drawing.palette.orbit, 0.6};
  const double longest = 0.4 / (1 + k);
  constexpr std::array<std::pair<double, int>, 3> rings{{{0, 1}, {0.42, 6}, {0.8, 12}}};
  for (const auto& [distance, count] : rings) {
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * pi * (i + 0.5) / count, x = distance * std::cos(angle), y = distance * std::sin(angle);
      const double along = longest * (k - sense * y), across = longest * sense * x;
      Polyline shaft{on_disc(x - along / 2, y - across / 2), on_disc(x + along / 2, y + across / 2)};
      heads.arrows.push_back(arrow_along(panel, shaft, 1));
      shafts.lines.push_back(std::move(shaft));
    }
  }
  const double force = drawing.portrait.system().law()({.sliding = k, .pivoting = 1}).force;
  constexpr double from_rim = 1.08, full = 0.9;
  Polyline friction{on_disc(-from_rim, 0), on_disc(-from_rim - full * force, 0)};
  panel.arrows.push_back(std::move(heads));
  panel.arrows.push_back({{arrow_along(panel, friction, 1)}, drawing.palette.comparison, 1});
  panel.lines.push_back(std::move(shafts));
  panel.lines.push_back({{std::move(friction)},
                         {drawing.palette.comparison, 3},
                         first ? "part of the friction that brakes the slide" : ""});
  panel.labels.push_back({from_paper(panel, {middle.x, middle.y + 1.3 * radius.y}),
                          fmt::format("{:.0f} %", 100 * force), drawing.palette.invariant});
}

}  // namespace

std::vector<MappedPanel> story_view(const Drawing& drawing) {
  const PhasePortrait& portrait = drawing.portrait;
  const PortraitOrbit motion = told(portrait);
  const double mu = portrait.system().mu(), u = motion.u[0], v = motion.v[0], side = u < 0 ? -1 : 1;
  // The plane of the motions, with room for the patches beside it.
  constexpr double beside = 1.5;
  const double widest = portrait.window.u(), highest = portrait.window.v(), room = beside * widest;
  Panel panel;
  panel.x = {
      drawing.speed(math("u = R ω") + sub(math("z"))), std::min(side * room, 0.), std::max(side * room, 0.), false, {}};
  panel.y = {drawing.speed(math("v")), 0, highest, false, {}};
  const PanelMap map{[](const Instant& at, const Instant&) {
                       return Point{at.u, at.v};
                     },
                     [mu](Point at) -> std::optional<Instant> {
                       return at.y > 0 && at.x != 0 ? std::optional(instant_at(mu, at.x, std::log(at.y)))
                                                    : std::nullopt;
                     }};
  PortraitPanel layers(drawing, std::move(panel), map);
  layers.set_arrows(0.3, 2);
  layers.add_plain(layers.lines_of(std::vector{motion}), asked_stroke(drawing.palette, true),
                   drawing.caption.highlight.empty() ? "this motion" : drawing.caption.highlight);
  Text apart = uncoupled_legend;
  if (const PortraitCaption& caption = drawing.caption; !caption.time_unit_name.empty()) {
    const auto time = [&](double tau) { return number(tau / caption.time_unit, 3) + " " + caption.time_unit_name; };
    apart = Text("textbook: slip ends after ") + time(portrait.flow.orbit({0, v}).stop_time()) + ", spin after " +
            time(portrait.system().pivoting_limit(u));
  }
  layers.add_plain(layers.lines_of(std::vector{uncoupled_orbit(portrait.flow, {u, v})}),
                   uncoupled_stroke(drawing.palette), apart);
  const auto add_others = [&](const PhasePortrait& of, Stroke stroke, const Text& legend) {
    std::vector<PortraitOrbit> others;
    for (const auto& [x, y] : {Point{1, 0.3}, {1, 0.65}, {1, 1}, {0.62, 1}, {0.3, 1}, {0.1, 1}}) {
      const double ln_v = std::log(y * highest), ln_k = ln_v - std::log(mu * x * widest);
      others.push_back(orbit_through(of.flow, ln_k, ln_v, 0));
      others.back().u *= side;
    }
    layers.add_plain(layers.lines_of(others), stroke, legend);
  };
  add_others(portrait, {drawing.palette.isochrone, 1.2},
             portrait.comparisons.empty() ? "other motions" : law_legend(portrait));
  for (const PhasePortrait& other : portrait.comparisons) {
    add_others(other, {drawing.palette.comparison, 1.3, true}, law_legend(other));
  }
  Panel& drawn = layers.panel();
  const double height = 0.12, width = height * drawing.panel_mm.y / drawing.panel_mm.x;
  constexpr std::array instants{std::pair{1.0, 0.81}, std::pair{0.6, 0.49}, std::pair{0.25, 0.17}};
  for (const auto& [left, y] : instants) {
    const double slip = left * v;
    const auto row = std::ranges::find_if(motion.v, [slip](double each) { return each <= slip; });
    const Instant at = motion.at(row - motion.v.begin());
    const Point middle{u < 0 ? 2.3 * width : 1 - 1.2 * width, y};
    const Point end{middle.x - side * (u < 0 ? 1.1 : 2.2) * width, middle.y};
    drawn.lines.push_back({{{{at.u, at.v}, from_paper(drawn, end)}}, {drawing.palette.invariant, 0.8}, ""});
    add_patch(drawn, drawing, at, middle, {width, height}, left == 1);
    drawn.marks.push_back({{{at.u, at.v}}, drawing.palette.highlight, 0.9, Marks::Shape::dot});
  }
  return {std::move(layers).finished()};
}

}  // namespace contensou::portraits
