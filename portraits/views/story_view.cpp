// One motion beside the uncoupled model, with drawings of the contact patch: why a body that spins slides so far.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
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

/// Adds a drawing of the patch at a state: a disc with the velocities of its points relative to the plane, and the part
/// of the friction that opposes the slide.
/// @param radius  radius of the drawing, as fractions of the panel's sides
void add_patch(Panel& panel, const Drawing& drawing, const Instant& at, Point middle, Point radius) {
  const double k = std::exp(at.ln_k), sense = at.u < 0 ? -1 : 1;
  const auto on_disc = [&](double x, double y) {
    return from_paper(panel, {middle.x + radius.x * x, middle.y + radius.y * y});
  };
  constexpr int sides = 72;
  Polyline rim;
  for (int i = 0; i <= sides; ++i) rim.push_back(on_disc(std::cos(2 * pi * i / sides), std::sin(2 * pi * i / sides)));
  panel.lines.push_back({{std::move(rim)}, {drawing.palette.invariant, 1}, ""});
  // In units of mu |u| a point (x, y) of the patch moves at (k - y, x), or at (k + y, -x) with the other sense of spin.
  Lines shafts{{}, {drawing.palette.times.front(), 1.3}, "velocity of the patch on the plane"};
  Arrows heads{{}, drawing.palette.times.front(), 0.55};
  const double longest = 0.3 / std::hypot(1 + k, 0.0);
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
  panel.lines.push_back(std::move(shafts));
  panel.arrows.push_back(std::move(heads));
  const double force = drawing.portrait.system().law()({.sliding = k, .pivoting = 1}).force;
  panel.labels.push_back({from_paper(panel, {middle.x, middle.y + 1.25 * radius.y}),
                          fmt::format("{:.0f} % brakes the slide", 100 * force), drawing.palette.invariant});
}

}  // namespace

std::vector<MappedPanel> story_view(const Drawing& drawing) {
  const PhasePortrait& portrait = drawing.portrait;
  const PortraitOrbit motion = told(portrait);
  const double u = motion.u[0], v = motion.v[0];
  constexpr double beside = 1.5, above = 1.25;
  Panel panel;
  panel.x = {
      drawing.speed(math("u = R ω") + sub(math("z"))), std::min(beside * u, 0.), std::max(beside * u, 0.), false, {}};
  panel.y = {drawing.speed(math("v")), 0, above * v, false, {}};
  const PanelMap map{[](const Instant& at, const Instant&) {
                       return Point{at.u, at.v};
                     },
                     [mu = portrait.system().mu()](Point at) -> std::optional<Instant> {
                       return at.y > 0 && at.x != 0 ? std::optional(instant_at(mu, at.x, std::log(at.y)))
                                                    : std::nullopt;
                     }};
  PortraitPanel layers(drawing, std::move(panel), map);
  // Other orbits begin at equal distances on the borders.
  std::vector<PortraitOrbit> others;
  const double mu = portrait.system().mu();
  for (const auto& [x, y] : {Point{1, 0.3}, {1, 0.65}, {1, 1}, {0.62, 1}, {0.3, 1}, {0.1, 1}}) {
    const double ln_v = std::log(y * above * v), ln_k = ln_v - std::log(mu * x * beside * std::abs(u));
    others.push_back(orbit_through(portrait.flow, ln_k, ln_v, 0));
    if (u < 0) others.back().u *= -1;
  }
  layers.set_arrows(0.3, 2);
  layers.add_plain(layers.lines_of(others), {drawing.palette.isochrone, 1.2}, "other motions");
  layers.add_plain(layers.lines_of(std::vector{uncoupled_orbit(portrait.flow, {u, v})}),
                   uncoupled_stroke(drawing.palette), uncoupled_legend);
  layers.add_plain(layers.lines_of(std::vector{motion}), asked_stroke(drawing.palette, true),
                   drawing.caption.highlight);
  Panel& drawn = layers.panel();
  const double height = 0.13, width = height * drawing.panel_mm.y / drawing.panel_mm.x;
  for (const double left : {1.0, 0.6, 0.25}) {
    const auto row =
        std::ranges::find_if(motion.tau_left, [&](double tau) { return tau <= left * motion.tau_left[0]; });
    const Instant at = motion.at(row - motion.tau_left.begin());
    const Point there = on_paper(drawn, {at.u, at.v});
    const Point middle{std::clamp(there.x + (u < 0 ? -1 : 1) * 1.7 * width, 1.3 * width, 1 - 1.3 * width),
                       std::clamp(there.y - 1.2 * height, 1.3 * height, 1 - 1.6 * height)};
    drawn.lines.push_back({{{{at.u, at.v}, from_paper(drawn, middle)}}, {drawing.palette.invariant, 0.8}, ""});
    add_patch(drawn, drawing, at, middle, {width, height});
    drawn.marks.push_back({{{at.u, at.v}}, drawing.palette.highlight, 0.9, Marks::Shape::dot});
  }
  return {std::move(layers).finished()};
}

}  // namespace contensou::portraits
