#include "contensou/portraits/reduction_figure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "views/palette.hpp"
#include "views/reduced_orbits.hpp"

namespace contensou::portraits {

using std::numbers::ln2;

Figure draw(ReducedOrbits from, const Text& title, const AskedSize& size) {
  constexpr int most_doublings = 3;  // of the start's orbit, and halvings
  const Palette colours = palette(false);
  const auto mapped = [&](Polyline line) {
    std::ranges::transform(line, line.begin(), from.in_plane);
    return line;
  };
  const auto add = [&](const std::vector<Polyline>& orbits, double up, Stroke stroke, const Text& legend) {
    std::vector<Polyline> lines = orbits;
    for (Polyline& line : lines) {
      for (Point& point : line) point.y += up;
    }
    from.strip.lines.push_back({lines, stroke, legend});
    std::ranges::transform(lines, lines.begin(), mapped);
    from.plane.lines.push_back({std::move(lines), stroke, legend});
    for (Panel* panel : {&from.plane, &from.strip}) {
      Arrows heads{{}, stroke.colour, 0.9};
      for (const Polyline& line : visible(*panel, panel->lines.back().lines)) {
        if (paper_length(*panel, line) > 0.15) heads.arrows.push_back(arrow_along(*panel, line, 0.5));
      }
      panel->arrows.push_back(std::move(heads));
    }
  };
  const auto upright = [&](double x, double low, double high) {
    Polyline line;
    constexpr int pieces = 60;
    for (int i = 0; i <= pieces; ++i) line.push_back({x, from.start.y + low + (high - low) * i / pieces});
    return line;
  };
  Lines rays{{}, {colours.invariant, 1.2, true}, "rays"};
  for (double x : from.rays) rays.lines.push_back(upright(x, -orbits_beyond, orbits_beyond));
  if (!rays.lines.empty()) {
    from.strip.lines.push_back(rays);
    std::ranges::transform(rays.lines, rays.lines.begin(), mapped);
    from.plane.lines.push_back(std::move(rays));
  }
  if (!from.elsewhere.empty()) add(from.elsewhere, 0, {colours.isochrone, 1.2}, "orbits of other sectors");
  for (int i = -most_doublings; i <= most_doublings; ++i) {
    const double place = 0.5 + 0.5 * i / most_doublings;
    const Text legend = i == -most_doublings ? "its copies by " + math("X") + ", ln 2 apart" : "";
    if (i != 0) add(from.orbit, i * ln2, {viridis(0.85 * place), 1.5}, legend);
  }
  add(from.orbit, 0, {colours.highlight, 3.2}, "orbit of the start");
  // The generator, from the start to its double.
  for (Panel* panel : {&from.plane, &from.strip}) {
    Polyline way = upright(from.start.x, 0, ln2);
    if (panel == &from.plane) way = mapped(way);
    const Point from_here = way[way.size() - 2], to = way.back();
    const Point middle = on_paper(*panel, between(way.front(), to, 0.5));
    panel->labels.push_back({from_paper(*panel, {middle.x + 0.02, middle.y}),
                             panel == &from.plane ? math("X") : math("X") + ": + ln 2", colours.invariant,
                             Label::Align::left});
    panel->arrows.push_back({{{to, {to.x - from_here.x, to.y - from_here.y}}}, colours.invariant, 1.2});
    panel->marks.push_back({{way.front()}, colours.invariant, 0.9, Marks::Shape::circle, "start"});
    panel->lines.push_back({{std::move(way)}, {colours.invariant, 2}, "what the symmetry " + math("X") + " does"});
  }
  from.plane.title = "the plane: " + math("X") + " magnifies orbits";
  from.strip.title = "the strip: " + math("X") + " shifts " + math("p") + " alone";
  Figure figure;
  figure.title = title;
  figure.subtitle = Text(from.rays.empty() ? "all orbits" : "all orbits between two rays") +
                    " are one curve, moved by the symmetry " + math("X") + "; a colour is one orbit";
  figure.size = fitted({180, 105}, 2, size);
  figure.panels = {std::move(from.plane), std::move(from.strip)};
  return figure;
}

void refuse_ray() {
  throw std::domain_error(
      "the start lies on an axis or on an invariant ray, which the symmetry moves along itself: another start is "
      "needed");
}

Figure reduction_figure(const reduction::Flow& flow, reduction::State start, const AskedSize& size) {
  const double ln_u = std::log(std::abs(start.u)), ln_v = std::log(start.v), ln_mu = std::log(flow.system().mu());
  if (!std::isfinite(ln_u) || !std::isfinite(ln_v)) refuse_ray();
  const double ln_k = ln_v - ln_mu - ln_u, sign = start.u < 0 ? -1 : 1;
  ReducedOrbits from{.start = {ln_k, ln_v}, .orbit = std::vector<Polyline>(1)};
  for (const auto& ray : flow.terminal().rays) {
    from.rays.push_back(std::log(ray.k));
    if (std::abs(from.rays.back() - ln_k) < 1e-12) refuse_ray();
  }
  const reduction::SimilarityCurve& curve = *flow.solution().through(ln_k);
  const double integral = flow.log_first_integral(start.u, ln_v), xi = curve.chart().coordinate(ln_k);
  const auto at = [&](double there) {
    const double x = curve.chart().log_ratio(there);
    return Point{x, integral + curve.ln_w(there) + ln_mu + x};
  };
  // Finer about k = 1. For small mu u falls while k falls by thousands of powers of e.
  constexpr int upstream = 400, most = 4000;
  for (int i = upstream; i > 0; --i) from.orbit[0].push_back(at(xi + 0.05 * i));
  double there = xi;
  for (int i = 0; i < most && from.orbit[0].back().y - from.orbit[0].back().x > ln_u + ln_mu - orbits_beyond; ++i) {
    from.orbit[0].push_back(at(there));
    there -= 0.05 + 0.02 * std::max(0.0, std::abs(there) - 8);
  }
  from.in_plane = [=](Point point) { return Point{sign * std::exp(point.y - point.x - ln_mu), std::exp(point.y)}; };
  const double width = plane_widths * start.u;
  from.plane.x = {math("u"), std::min(width, 0.0), std::max(width, 0.0), false, {}};
  from.plane.y = {math("v"), 0, plane_widths * start.v, false, {}};
  from.strip.x = {
      "ln " + math("k") + ",  " + math("k = v/(μ|u|)"), std::min(ln_k, 0.0) - 4, std::max(ln_k, 0.0) + 3, false, {}};
  from.strip.y = {math("p") + " = ln " + math("v"), ln_v - strip_below, ln_v + strip_above, false, {}};
  return draw(std::move(from),
              title_of("The reduction of (2.6)", fmt::format("{:.3g}", flow.system().mu()),
                       shortened(flow.system().law().name())),
              size);
}

}  // namespace contensou::portraits
