// The plane of any planar system as a drawing.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "contensou/portraits/planar_portrait.hpp"
#include "contensou/reduction/infinity.hpp"
#include "data/tracing.hpp"
#include "views/panel_layers.hpp"

namespace contensou::portraits {

using Eigen::Vector2d;

namespace {

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
  layers.add_invariant(std::move(others));
  layers.add_invariant(std::move(attracting));
}

/// Returns the name of a variable, with a prime for each apostrophe.
Text variable(std::string name) {
  for (std::size_t at = 0; (at = name.find('\'', at)) != std::string::npos;) name.replace(at, 1, "′");
  return math(name);
}

}  // namespace

Figure draw(const PlanarPortrait& portrait, const PortraitStyle& style) {
  const Vector2d sides = portrait.window.sides();
  const double shape = sides[1] / sides[0];
  constexpr double longest = 3, width = 150;
  const bool to_scale = shape < longest && shape > 1 / longest;
  const PaperSize size = fitted({width, std::clamp(width * (to_scale ? shape : 0.66), 90.0, 200.0)}, 1, style.size);
  const reduction::Generator* scaling = portrait.plane.scaling();
  PortraitCaption caption;
  caption.highlight = "orbit of the start";
  caption.time_symbol = scaling && scaling->time < 0 ? Text("to infinity") : math("t*");
  CurveDrawing look{look_of(size, 1, style.screen), portrait, caption, style};
  const auto& isochrones = portrait.isochrones;
  const bool even = !isochrones.empty() && portrait.isochrone_step > 0;
  const double most = even ? isochrones.back().tau_stop + portrait.isochrone_step : infinity;
  look.bands = bands_of({&portrait}, 1, look.palette, most);
  Panel axes = panel_of(portrait.window);
  axes.x.name = variable(portrait.variables[0]);
  axes.y.name = variable(portrait.variables[1]);
  axes.to_scale = to_scale;
  const auto place = [](const PortraitOrbit::Instant& at, const PortraitOrbit::Instant&) { return Point{at.u, at.v}; };
  PanelLayers layers(look, std::move(axes), {place});

  const bool coloured = layers.add_orbits(layers.lines_of(portrait.orbits), style.colour_by_time, "orbits");
  layers.add_isochrones(-1);
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
    Lines lines{{}, {look.palette.comparison, 3}, "invariant curves: V = 0"};
    for (TimedLine& curve : layers.lines_of(portrait.invariant)) lines.lines.push_back(std::move(curve.line));
    layers.panel().lines.push_back(std::move(lines));
  }
  if (style.invariant && !portrait.separatrices.empty()) {
    layers.add_plain(layers.lines_of(portrait.separatrices), {look.palette.comparison, 2}, "separatrices of saddles");
  }
  layers.add_highlights();
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
  if (coloured) figure.colour_bar = colour_bar(look.bands, caption);
  return figure;
}

}  // namespace contensou::portraits
