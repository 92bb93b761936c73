#include "contensou/portraits/reduction_figure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "contensou/reduction/flow.hpp"
#include "views/palette.hpp"

namespace contensou::portraits {

using std::numbers::ln2, std::numbers::pi;

namespace {

constexpr double strip_below = 4.5, strip_above = 3.2;  // range of p below and above the start, in the strip
constexpr double plane_widths = 2.2;                    // size of the window of the plane divided by the start

Colour colour_of_copy(double shift) { return viridis(0.425 * (1 + shift / copy_shifts.back())); }

Text legend_of_copies() { return "its copies under " + math("X") + ", ln 2 apart"; }

constexpr const char* legend_of_orbit = "orbit of the start";

/// Draws copies divided by their starts, as beads on one line. Copies divided by a later or earlier state of the same
/// orbit give other lines, because the symmetry does not map these states onto the start.
Panel collapse(const ReducedOrbits& from) {
  Panel panel;
  panel.title = "copies divided by their starts: one line";
  panel.x = {math("u/u") + sub("0"), 0, plane_widths, false, {}};
  panel.y = {math("v/v") + sub("0"), 0, plane_widths, false, {}};
  const Polyline& orbit = from.orbit.front();
  // Divide by the state of the copy that corresponds to `start` on the orbit.
  const auto divided = [&](Point at, Point start, double shift) {
    const Point point = from.in_plane({at.x, at.y + shift}), unit = from.in_plane({start.x, start.y + shift});
    return Point{point.x / unit.x, point.y / unit.y};
  };
  const auto line = [&](Point start) {
    Polyline all;
    for (const Point& at : orbit) all.push_back(divided(at, start, 0));
    return all;
  };
  Lines others{{}, {palette(false).isochrone, 1.4, true}, "other starts"};
  for (const double beside : {copy_shifts.front(), copy_shifts.back()}) {
    others.lines.push_back(line(
        *std::ranges::min_element(orbit, {}, [&](const Point& at) { return std::abs(at.y - from.start.y - beside); })));
  }
  panel.lines = {std::move(others), {{line(from.start)}, {palette(false).highlight, 1.2}, legend_of_orbit}};
  std::vector<Marks> beads;
  for (const double shift : copy_shifts) {
    beads.push_back({{}, colour_of_copy(shift), 0.7, Marks::Shape::dot, beads.empty() ? legend_of_copies() : Text()});
  }
  constexpr double apart = 0.03;
  double way = 0;
  std::size_t bead = 0;
  for (std::size_t i = 1; i < orbit.size(); ++i) {
    const Point last = on_paper(panel, divided(orbit[i - 1], from.start, 0));
    const Point here = on_paper(panel, divided(orbit[i], from.start, 0));
    if (!(std::max({here.x, here.y, last.x, last.y}) <= 1)) continue;
    way += std::hypot(here.x - last.x, here.y - last.y);
    if (way < apart) continue;
    way = 0;
    beads[bead % beads.size()].points.push_back(divided(orbit[i], from.start, copy_shifts[bead % beads.size()]));
    ++bead;
  }
  panel.marks = std::move(beads);
  panel.marks.push_back({{{1, 1}}, palette(false).invariant, 0.9, Marks::Shape::circle, "start"});
  return panel;
}

/// Fills plane and strip, whose axes are set, with rays, copies of the start's orbit, and the action of the symmetry.
Figure draw(const ReducedOrbits& from, Panel plane, Panel strip, const Text& title, const AskedSize& size) {
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
    strip.lines.push_back({lines, stroke, legend});
    std::ranges::transform(lines, lines.begin(), mapped);
    plane.lines.push_back({std::move(lines), stroke, legend});
    for (Panel* panel : {&plane, &strip}) {
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
    strip.lines.push_back(rays);
    std::ranges::transform(rays.lines, rays.lines.begin(), mapped);
    plane.lines.push_back(std::move(rays));
  }
  if (!from.elsewhere.empty()) add(from.elsewhere, 0, {colours.isochrone, 1.2}, "orbits of other sectors");
  for (const double shift : copy_shifts) {
    add(from.orbit, shift, {colour_of_copy(shift), 1.5}, shift == copy_shifts.front() ? legend_of_copies() : Text());
  }
  add(from.orbit, 0, {colours.highlight, 3.2}, legend_of_orbit);
  // Draw the action of the generator as an arrow from the start to twice the start.
  for (Panel* panel : {&plane, &strip}) {
    Polyline way = upright(from.start.x, 0, ln2);
    if (panel == &plane) way = mapped(way);
    const Point from_here = way[way.size() - 2], to = way.back();
    const Point middle = on_paper(*panel, between(way.front(), to, 0.5));
    panel->labels.push_back({from_paper(*panel, {middle.x + 0.02, middle.y}),
                             panel == &plane ? math("X") : math("X") + ": + ln 2", colours.invariant,
                             Label::Align::left});
    panel->arrows.push_back({{{to, {to.x - from_here.x, to.y - from_here.y}}}, colours.invariant, 1.2});
    panel->marks.push_back({{way.front()}, colours.invariant, 0.9, Marks::Shape::circle, "start"});
    panel->lines.push_back({{std::move(way)}, {colours.invariant, 2}, "shift by the symmetry " + math("X")});
  }
  plane.title = "the plane: " + math("X") + " magnifies orbits";
  strip.title = "the strip: " + math("X") + " shifts " + math("p") + " alone";
  Figure figure;
  figure.title = title;
  figure.subtitle = Text(from.rays.empty() ? "all orbits" : "all orbits between two rays") +
                    " are one curve, moved by the symmetry " + math("X") + "; each colour is one orbit";
  figure.size = fitted({180, 105}, 2, size);
  figure.panels = {std::move(plane), std::move(strip)};
  return figure;
}

}  // namespace

Figure reduction_figure(const reduction::PlanarReduction& plane, const Eigen::Vector2d& start, const std::string& name,
                        const AskedSize& size) {
  const ReducedOrbits from = reduced_orbits(plane, start);
  const auto [x, p] = from.start;
  Panel in_plane, strip;
  strip.y = {math("p"), p - strip_below, p + strip_above, false, {}};
  if (const reduction::Flow* flow = plane.flow()) {
    const Eigen::Vector2d far = plane_widths * start;
    in_plane.x = {math("u"), std::min(far[0], 0.0), std::max(far[0], 0.0), false, {}};
    in_plane.y = {math("v"), std::min(far[1], 0.0), std::max(far[1], 0.0), false, {}};
    strip.x = {"ln " + math("k") + ",  " + math("k = v/(μ|u|)"), std::min(x, 0.0) - 4, std::max(x, 0.0) + 3, false, {}};
    strip.y.name = math("p") + " = ln " + math("v");
    Figure figure = draw(from, in_plane, strip,
                         title_of("The reduction of (2.6)", fmt::format("{:.3g}", flow->system().mu()),
                                  shortened(flow->system().law().name())),
                         size);
    figure.panels.push_back(collapse(from));
    figure.size = fitted({270, 105}, 3, size);
    return figure;
  }
  const Eigen::Vector2d& centre = plane.centre();
  const double half = plane_widths * (start - centre).lpNorm<Eigen::Infinity>();
  const double first = from.rays.empty() ? 0 : from.rays[0];
  in_plane.x = {math("u"), centre[0] - half, centre[0] + half, false, {}};
  in_plane.y = {math("v"), centre[1] - half, centre[1] + half, false, {}};
  in_plane.to_scale = true;
  strip.x = {math("q") + ", the angle", first, first + 2 * pi, false, {}};
  return draw(from, in_plane, strip, "The reduction of  " + shortened(name), size);
}

}  // namespace contensou::portraits
