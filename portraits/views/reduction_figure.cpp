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

using std::numbers::pi;

namespace {

constexpr double strip_below = 6.5, strip_above = 4.6;  // range of p below and above the start, in steps of copies
constexpr double plane_widths = 2.2;                    // size of the window of the plane divided by the start

Colour colour_of_copy(int copy) { return viridis(0.425 * (1 + copy / double{copies.back()})); }

/// The words on a symmetry.
struct Words {
  std::string step;  ///< change of p from one copy to the next
  const char *moves, *lines;
};
Words words_of(const reduction::Generator* symmetry, double step) {
  if (!symmetry || symmetry->scales()) {
    const bool magnifies = !symmetry || symmetry->matrix(0, 0) == symmetry->matrix(1, 1);
    return {"ln 2", magnifies ? "magnifies" : "scales", magnifies ? "rays" : "invariant curves"};
  }
  if (symmetry->shift.isZero(0)) return {"2π/7", "turns", "invariant circles"};
  return {fmt::format("{:.3g}", step), "shifts", "invariant lines"};
}

Text legend_of_copies(const Words& words) { return "its copies under " + math("X") + ", " + words.step + " apart"; }

constexpr const char* legend_of_orbit = "orbit of the start";

/// Draws copies divided by their starts, as beads on one line. Copies divided by a later or earlier state of the same
/// orbit give other lines, because the symmetry does not map these states onto the start.
Panel collapse(const ReducedOrbits& from, const Words& words) {
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
  for (const double beside : {copies.front() * from.step, copies.back() * from.step}) {
    others.lines.push_back(line(
        *std::ranges::min_element(orbit, {}, [&](const Point& at) { return std::abs(at.y - from.start.y - beside); })));
  }
  panel.lines = {std::move(others), {{line(from.start)}, {palette(false).highlight, 1.2}, legend_of_orbit}};
  std::vector<Marks> beads;
  for (const int copy : copies) {
    beads.push_back(
        {{}, colour_of_copy(copy), 0.7, Marks::Shape::dot, beads.empty() ? legend_of_copies(words) : Text()});
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
    const std::size_t next = bead % beads.size();
    beads[next].points.push_back(divided(orbit[i], from.start, copies[next] * from.step));
    ++bead;
  }
  panel.marks = std::move(beads);
  panel.marks.push_back({{{1, 1}}, palette(false).invariant, 0.9, Marks::Shape::circle, "start"});
  return panel;
}

/// Fills plane and strip, whose axes are set, with rays, copies of the start's orbit, and the action of the symmetry.
Figure draw(const ReducedOrbits& from, Panel plane, Panel strip, const Words& words, const Text& title,
            const AskedSize& size) {
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
    constexpr int pieces = 400;
    for (int i = 0; i <= pieces; ++i) line.push_back({x, from.start.y + low + (high - low) * i / pieces});
    return line;
  };
  Lines rays{{}, {colours.invariant, 1.2, true}, words.lines};
  constexpr double beyond = 17;
  for (double x : from.rays) rays.lines.push_back(upright(x, -beyond * from.step, beyond * from.step));
  if (!rays.lines.empty()) {
    strip.lines.push_back(rays);
    std::ranges::transform(rays.lines, rays.lines.begin(), mapped);
    plane.lines.push_back(std::move(rays));
  }
  if (!from.elsewhere.empty()) add(from.elsewhere, 0, {colours.isochrone, 1.2}, "orbits of other sectors");
  for (const int copy : copies) {
    add(from.orbit, copy * from.step, {colour_of_copy(copy), 1.5},
        copy == copies.front() ? legend_of_copies(words) : Text());
  }
  add(from.orbit, 0, {colours.highlight, 3.2}, legend_of_orbit);
  // Draw the action of the generator as an arrow from the start to its first copy.
  for (Panel* panel : {&plane, &strip}) {
    Polyline way = upright(from.start.x, 0, from.step);
    if (panel == &plane) way = mapped(way);
    const Point from_here = way[way.size() - 2], to = way.back();
    const Point middle = on_paper(*panel, between(way.front(), to, 0.5));
    const Point arrow = on_paper(*panel, to), tail = on_paper(*panel, way.front());
    const bool flat = std::abs(arrow.y - tail.y) < std::abs(arrow.x - tail.x) / 4;
    panel->labels.push_back({from_paper(*panel, {middle.x + (flat ? 0 : 0.02), middle.y + (flat ? 0.04 : 0)}),
                             panel == &plane ? math("X") : math("X") + ": + " + words.step, colours.invariant,
                             Label::Align::left});
    panel->arrows.push_back({{{to, {to.x - from_here.x, to.y - from_here.y}}}, colours.invariant, 1.2});
    panel->marks.push_back({{way.front()}, colours.invariant, 0.9, Marks::Shape::circle, "start"});
    panel->lines.push_back({{std::move(way)}, {colours.invariant, 2}, "shift by the symmetry " + math("X")});
  }
  plane.title = "the plane: " + math("X") + " " + words.moves + " orbits";
  strip.title = "the strip: " + math("X") + " shifts " + math("p") + " alone";
  Figure figure;
  figure.title = title;
  figure.subtitle = Text(from.rays.empty() ? "all orbits" : fmt::format("all orbits between two {}", words.lines)) +
                    " are one curve, moved by the symmetry " + math("X") + "; each colour is one orbit";
  figure.size = fitted({180, 105}, 2, size);
  figure.panels = {std::move(plane), std::move(strip)};
  return figure;
}

}  // namespace

Figure reduction_figure(const reduction::PlanarReduction& plane, const Eigen::Vector2d& start,
                        const ReducedNames& names, const AskedSize& size, const reduction::Generator* symmetry) {
  const ReducedOrbits from = symmetry ? reduced_orbits(plane, start, *symmetry) : reduced_orbits(plane, start);
  const auto [x, p] = from.start;
  const Words words = words_of(symmetry, from.step);
  Panel in_plane, strip;
  strip.y = {math("p"), p - strip_below * from.step, p + strip_above * from.step, false, {}};
  if (const reduction::Flow* flow = plane.flow()) {
    const Eigen::Vector2d far = plane_widths * start;
    in_plane.x = {math("u"), std::min(far[0], 0.0), std::max(far[0], 0.0), false, {}};
    in_plane.y = {math("v"), std::min(far[1], 0.0), std::max(far[1], 0.0), false, {}};
    strip.x = {"ln " + math("k") + ",  " + math("k = v/(μ|u|)"), std::min(x, 0.0) - 4, std::max(x, 0.0) + 3, false, {}};
    strip.y.name = math("p") + " = ln " + math("v");
    Figure figure = draw(from, in_plane, strip, words,
                         title_of("The reduction of (2.6)", fmt::format("{:.3g}", flow->system().mu()),
                                  shortened(flow->system().law().name())),
                         size);
    figure.panels.push_back(collapse(from, words));
    figure.size = fitted({270, 105}, 3, size);
    return figure;
  }
  const bool scales = symmetry && symmetry->scales();
  const Eigen::Vector2d centre = scales ? symmetry->centre() : symmetry ? Eigen::Vector2d::Zero() : plane.centre();
  const Eigen::Vector2d away = (start - centre).cwiseAbs();
  Eigen::Vector2d half = Eigen::Vector2d::Constant(plane_widths * away.maxCoeff());
  Eigen::Vector2d middle = centre;
  in_plane.to_scale = true;
  if (scales) {
    // The nearest rays are seen.
    const double wide = std::max(2.0, 3 * std::abs(x));
    double low = x - wide, high = x + wide;
    const auto next = std::ranges::upper_bound(from.rays, x);
    constexpr double beyond = 0.15;
    if (next != from.rays.end()) high = std::max(high, *next + beyond * (*next - x));
    if (next != from.rays.begin()) low = std::min(low, *(next - 1) - beyond * (x - *(next - 1)));
    strip.x = {math(names.q), low, high, false, {}};
    // Orbits lie on the side of the start. A scaling with two rates is no magnification: each axis has its own unit.
    constexpr double widths = 1.3, margin = 0.95;
    in_plane.to_scale = symmetry->matrix(0, 0) == symmetry->matrix(1, 1);
    half = widths * (in_plane.to_scale ? Eigen::Vector2d::Constant(away.maxCoeff())
                                       : Eigen::Vector2d(away.cwiseMax(1e-3 * away.maxCoeff())));
    middle[0] += std::copysign(margin * half[0], start[0] - centre[0]);
  } else if (symmetry) {
    // The copies of the start lie in the window.
    const bool turns = symmetry->shift.isZero(0);
    if (turns) {
      constexpr double farthest = 5, margin = 1.3;
      for (const double radius : from.rays) {
        if (radius < farthest * x) half.setConstant(std::max(half[0], margin * radius));
      }
    } else {
      middle = start;
      half.setConstant(4.4 * from.step * symmetry->shift.lpNorm<Eigen::Infinity>());
    }
    strip.x = {math(names.q), turns ? 0 : x - half[0], turns ? std::numbers::sqrt2 * half[0] : x + half[0], false, {}};
  } else {
    const double first = from.rays.empty() ? 0 : from.rays[0];
    strip.x = {math("q") + ", the angle", first, first + 2 * pi, false, {}};
  }
  in_plane.x = {math(names.variables[0]), middle[0] - half[0], middle[0] + half[0], false, {}};
  in_plane.y = {math(names.variables[1]), middle[1] - half[1], middle[1] + half[1], false, {}};
  strip.y.name = math(names.p);
  return draw(from, in_plane, strip, words, "The reduction of  " + shortened(names.system), size);
}

}  // namespace contensou::portraits
