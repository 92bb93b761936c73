// The plane of any planar system as a drawing.
#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "contensou/portraits/planar_portrait.hpp"
#include "contensou/reduction/infinity.hpp"
#include "data/round_numbers.hpp"
#include "views/panel_layers.hpp"

namespace contensou::portraits {

using Eigen::Vector2d;
using Orbits = std::vector<PlanarPortraitOrbit>;

namespace {

TimedLine line_of(const PlanarPortraitOrbit& orbit) {
  TimedLine timed;
  for (Eigen::Index i = 0; i < orbit.u.size(); ++i) timed.line.push_back({orbit.u[i], orbit.v[i]});
  timed.left.assign(orbit.tau_left.begin(), orbit.tau_left.end());
  return timed;
}

std::vector<TimedLine> lines_of(const Orbits& orbits) {
  std::vector<TimedLine> lines;
  for (const PlanarPortraitOrbit& orbit : orbits) lines.push_back(line_of(orbit));
  return lines;
}

TimeBands bands_of(const PlanarPortrait& portrait, const Palette& palette) {
  double longest = 0;
  for (const PlanarPortraitOrbit& orbit : portrait.orbits) {
    if (std::isfinite(orbit.tau_left[0])) longest = std::max(longest, orbit.tau_left[0]);
  }
  if (longest == 0) longest = 1;
  std::vector<double> times;
  for (const Isochrone& isochrone : portrait.isochrones) times.push_back(isochrone.tau_stop);
  const double step = portrait.isochrone_step;
  if (!times.empty() && step > 0) longest = std::min(longest, times.back() + step);
  return bands_of(longest, std::move(times), step, 1, palette);
}

/// Adds rays in the direction of the motion, between the border of the panel and the centre.
void add_rays(PanelLayers& layers, const PlanarPortrait& portrait, const Palette& palette) {
  const auto& [low, high] = portrait.window;
  const reduction::PlanarReduction& plane = portrait.plane;
  double highest = 0;
  for (const Vector2d& corner : {low, high, Vector2d(low[0], high[1]), Vector2d(high[0], low[1])}) {
    const double p = plane.canonical(corner).p;
    if (std::isfinite(p)) highest = std::max(highest, p);
  }
  Lines attracting{{}, {palette.comparison, 2.6}, "ray that orbits approach"};
  Lines others{{}, {palette.comparison, 2, true}, "ray that orbits leave"};
  for (const auto& ray : plane.rays()) {
    Polyline line{{plane.centre()[0], plane.centre()[1]}};
    constexpr int pieces = 200;
    constexpr double deep = 20;
    for (int i = 0; i <= pieces; ++i) {
      const Vector2d x = plane.point(ray.q, highest + 1 - deep + deep * i / pieces);
      line.push_back({x[0], x[1]});
    }
    if (ray.to_centre) std::ranges::reverse(line);
    (ray.attracts ? attracting : others).lines.push_back(std::move(line));
  }
  for (Lines* lines : {&others, &attracting}) {
    if (lines->lines.empty()) continue;
    layers.panel().lines.push_back(*lines);
    layers.add_heads(*lines);
  }
}

}  // namespace

Figure draw(const PlanarPortrait& portrait, const PortraitStyle& style) {
  const auto& [low, high] = portrait.window;
  const Vector2d sides = high - low;
  const double shape = sides[1] / sides[0];
  constexpr double longest = 3, width = 150;
  const bool to_scale = shape < longest && shape > 1 / longest;
  const PaperSize size = fitted({width, std::clamp(width * (to_scale ? shape : 0.66), 90.0, 200.0)}, 1, style.size);
  LayerLook look{palette(style.screen), {}, panel_size(size, 1), 0};
  look.letter = letter_mm(size.width_mm) * look.palette.theme.letters;
  look.bands = bands_of(portrait, look.palette);
  Panel axes;
  axes.x = {math("u"), low[0], high[0], false, {}};
  axes.y = {math("v"), low[1], high[1], false, {}};
  axes.to_scale = to_scale;
  PanelLayers layers(look, style.arrows, std::move(axes));

  Orbits timed, untimed;
  for (const PlanarPortraitOrbit& orbit : portrait.orbits) {
    (style.colour_by_time && std::isfinite(orbit.tau_left[0]) ? timed : untimed).push_back(orbit);
  }
  PortraitCaption caption;
  const reduction::Generator* scaling = portrait.plane.scaling();
  caption.time_symbol = scaling && scaling->time < 0 ? Text("to infinity") : math("t*");
  if (!untimed.empty()) {
    layers.add_plain(lines_of(untimed), {look.palette.orbit, 1.3}, timed.empty() ? "orbits" : "other orbits");
  }
  layers.add_coloured(lines_of(timed));
  std::vector<Polyline> crossed;
  for (const Orbits* orbits : {&portrait.through, &portrait.highlight}) {
    for (TimedLine& timed_line : lines_of(*orbits)) crossed.push_back(std::move(timed_line.line));
  }
  if (!portrait.isochrones.empty()) {
    std::vector<TimedPiece> pieces;
    for (const auto& [time, u, v] : portrait.isochrones) {
      pieces.push_back({time, {}});
      for (Eigen::Index i = 0; i < u.size(); ++i) pieces.back().line.push_back({u[i], v[i]});
    }
    layers.add_isochrones(pieces, time_left(caption), 1, crossed, -1);
  }
  if (style.field != PortraitStyle::Field::none) {
    const auto drift = [&](Point at) -> std::optional<Drift> {
      Vector2d rate;
      try {
        rate = portrait.plane.field()({at.x, at.y});
      } catch (const std::exception&) {
        return std::nullopt;
      }
      const double speed = rate.cwiseQuotient(sides).norm();
      if (!(speed > 0) || !std::isfinite(speed)) return std::nullopt;
      constexpr double step = 1e-4;  // a fraction of the window
      return Drift{at, {at.x + step * rate[0] / speed, at.y + step * rate[1] / speed}, speed};
    };
    layers.add_directions(drift, "direction of the motion");
  }
  if (style.invariant && scaling) add_rays(layers, portrait, look.palette);
  if (style.invariant && !portrait.invariant.empty()) {
    layers.panel().lines.push_back({portrait.invariant, {look.palette.comparison, 3}, "invariant curves: V = 0"});
  }
  if (style.invariant && !portrait.separatrices.empty()) {
    layers.add_plain(lines_of(portrait.separatrices), {look.palette.comparison, 2}, "separatrices of saddles");
  }
  const auto add_asked = [&](const Orbits& orbits, bool of_start, const Text& legend) {
    if (!orbits.empty()) layers.add_plain(lines_of(orbits), asked_stroke(look.palette, of_start), legend);
  };
  add_asked(portrait.through, false, through_legend);
  if (!portrait.points.empty()) {
    std::vector<Point> points;
    for (const Vector2d& x : portrait.points) points.push_back({x[0], x[1]});
    layers.add_points(points);
  }
  constexpr const char* start_legend = "orbit of the start";
  add_asked(portrait.highlight, true, start_legend);
  if (!portrait.highlight.empty()) {
    const PlanarPortraitOrbit& first = portrait.highlight.front();
    layers.panel().marks.push_back(
        {{{first.u[0], first.v[0]}}, look.palette.highlight, 0.6, Marks::Shape::dot, start_legend});
  }
  if (scaling) {
    const Vector2d& centre = portrait.plane.centre();
    layers.panel().marks.push_back(
        {{{centre[0], centre[1]}}, look.palette.invariant, 1.2, Marks::Shape::dot, "centre of the symmetry"});
  }
  std::map<std::string_view, Marks> of_kind;
  for (const reduction::Equilibrium& each : portrait.equilibria) {
    const auto mark = each.kind().starts_with("stable") ? Marks::Shape::dot
                      : each.kind() == "saddle"         ? Marks::Shape::square
                                                        : Marks::Shape::circle;
    Marks& marks =
        of_kind.try_emplace(each.kind(), Marks{{}, look.palette.invariant, 1.2, mark, std::string(each.kind())})
            .first->second;
    marks.points.push_back({each.x[0], each.x[1]});
  }
  for (auto& [kind, marks] : of_kind) layers.panel().marks.push_back(std::move(marks));

  Figure figure;
  figure.title = shortened(portrait.name);
  const std::string kind(portrait.plane.kind().empty() ? "kind not decided" : portrait.plane.kind());
  const std::string_view form = portrait.plane.form();
  const char* of_form = form == "affine" ? "generator of the orbits" : "inverse integrating factor";
  figure.subtitle = !scaling ? (form.empty() ? std::string("no exact solution found: orbits by time steps")
                                             : fmt::format("orbits by quadrature; {}: {}", of_form, form))
                    : portrait.plane.star()
                        ? kind
                        : fmt::format("{}: {} are one curve, moved by the symmetry", kind,
                                      portrait.plane.sectors().empty() ? "all orbits" : "all orbits between two rays");
  figure.size = size;
  figure.theme = look.palette.theme;
  figure.panels = {std::move(layers.panel())};
  if (!timed.empty()) figure.colour_bar = colour_bar(look.bands, caption);
  return figure;
}

}  // namespace contensou::portraits
