#include "contensou/portraits/reduction_figure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "views/palette.hpp"

namespace contensou::portraits {

namespace {

using Eigen::Vector2d;
using std::numbers::ln2, std::numbers::pi;

constexpr int most_doublings = 3;           ///< of the start's orbit, and halvings
constexpr double below = 4.5, above = 3.2;  ///< the start, of the strip in p
constexpr double beyond = 12;               ///< the start, of lines in p
constexpr double widths = 2.2;              ///< of the plane's window, in those of the start

/// What a figure is drawn from: lines (x, p) of the strip, in the way of the motion, and where the plane has them.
struct Reduced {
  Panel plane = {}, strip = {};
  Point start;                                ///< of the strip
  std::vector<Polyline> orbit;                ///< of the start
  std::vector<Polyline> elsewhere = {};       ///< orbits of other sectors
  std::vector<double> rays = {};              ///< their x
  std::function<Point(Point)> in_plane = {};  ///< of a point of the strip
};

Figure drawn(Reduced from, const std::string& title, const AskedSize& size) {
  const Palette colours = palette(false);
  const auto mapped = [&](Polyline line) {
    std::ranges::transform(line, line.begin(), from.in_plane);
    return line;
  };
  const auto add = [&](const std::vector<Polyline>& orbits, double up, Stroke stroke, const std::string& legend) {
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
  for (double x : from.rays) rays.lines.push_back(upright(x, -beyond, beyond));
  if (!rays.lines.empty()) {
    from.strip.lines.push_back(rays);
    std::ranges::transform(rays.lines, rays.lines.begin(), mapped);
    from.plane.lines.push_back(std::move(rays));
  }
  if (!from.elsewhere.empty()) add(from.elsewhere, 0, {colours.isochrone, 1.2}, "orbits of other sectors");
  for (int i = -most_doublings; i <= most_doublings; ++i) {
    const double place = 0.5 + 0.5 * i / most_doublings;
    const std::string legend = i == -most_doublings ? "its copies, 1/8 to 8 times as large" : "";
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
                             panel == &from.plane ? "{/:Italic X}" : "{/:Italic X}: + ln 2", colours.invariant,
                             Label::Align::left});
    panel->arrows.push_back({{{to, {to.x - from_here.x, to.y - from_here.y}}}, colours.invariant, 1.2});
    panel->marks.push_back({{way.front()}, colours.invariant, 0.9, Marks::Shape::circle, "start"});
    panel->lines.push_back({{std::move(way)}, {colours.invariant, 2}, "what the symmetry {/:Italic X} does"});
  }
  from.plane.title = "the plane: {/:Italic X} magnifies orbits";
  from.strip.title = "the strip: {/:Italic X} shifts {/:Italic p} alone";
  Figure figure;
  figure.title = title;
  figure.subtitle =
      fmt::format("all orbits{} are one curve, moved by the symmetry {{/:Italic X}}; a colour is one orbit",
                  from.rays.empty() ? "" : " between two rays");
  figure.size = fitted({180, 105}, 2, size);
  figure.panels = {std::move(from.plane), std::move(from.strip)};
  return figure;
}

[[noreturn]] void refuse_ray() {
  throw std::domain_error(
      "the start lies on an axis or on an invariant ray, which the symmetry moves along itself: another start is "
      "needed");
}

}  // namespace

Figure reduction_figure(const reduction::Flow& flow, reduction::State start, const AskedSize& size) {
  const double ln_u = std::log(std::abs(start.u)), ln_v = std::log(start.v), ln_mu = std::log(flow.system().mu());
  if (!std::isfinite(ln_u) || !std::isfinite(ln_v)) refuse_ray();
  const double ln_k = ln_v - ln_mu - ln_u, sign = start.u < 0 ? -1 : 1;
  Reduced from{.start = {ln_k, ln_v}, .orbit = {{}}};
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
  constexpr int upstream = 400, most = 1200;
  for (int i = upstream; i > 0; --i) from.orbit[0].push_back(at(xi + 0.05 * i));
  // For small mu u falls while k falls by hundreds of powers of e: steps grow.
  double step = 0.05, there = xi;
  for (int i = 0; i < most && from.orbit[0].back().y - from.orbit[0].back().x > ln_u + ln_mu - beyond; ++i) {
    from.orbit[0].push_back(at(there));
    there -= step *= 1.01;
  }
  from.in_plane = [=](Point point) { return Point{sign * std::exp(point.y - point.x - ln_mu), std::exp(point.y)}; };
  const double width = widths * start.u;
  from.plane.x = {"{/:Italic u}", std::min(width, 0.0), std::max(width, 0.0), false, {}};
  from.plane.y = {"{/:Italic v}", 0, widths * start.v, false, {}};
  from.strip.x = {"ln {/:Italic k},  {/:Italic k = v}/({/:Italic μ}|{/:Italic u}|)",
                  std::min(ln_k, 0.0) - 4,
                  std::max(ln_k, 0.0) + 3,
                  false,
                  {}};
  from.strip.y = {"{/:Italic p} = ln {/:Italic v}", ln_v - below, ln_v + above, false, {}};
  return drawn(std::move(from),
               fmt::format("The reduction of (2.6),  {{/:Italic μ}} = {:.3g},  law: {}", flow.system().mu(),
                           literal(flow.system().law().name())),
               size);
}

Figure reduction_figure(const reduction::PlanarField& field, const reduction::PlanarReduction& plane,
                        const Vector2d& start, const std::string& name, const AskedSize& size) {
  if (plane.kind() == "bordered") throw std::domain_error("the field has borders or jumps: its sectors are not drawn");
  if (start == plane.centre() || plane.star()) refuse_ray();
  const auto [q, p, slope] = plane.canonical(start);
  const auto level = [&](double angle) { return plane.first_integral(plane.point(angle, 0)); };
  const double integral = plane.first_integral(start);  // throws on a ray
  /// From angle to angle, in the way of the motion.
  const auto line = [&](const std::vector<double>& angles, double constant) {
    Polyline points;
    for (double angle : angles) points.push_back({angle, constant - level(angle)});
    const Point &a = points[points.size() / 2], &b = points[points.size() / 2 + 1];
    const Vector2d here = plane.point(a.x, a.y), next = plane.point(b.x, b.y);
    if (field(here).dot(next - here) < 0) std::ranges::reverse(points);
    return points;
  };
  Reduced from{.start = {q, p}, .orbit = {}};
  std::vector<double> angles;
  if (plane.rays().empty()) {
    // Turns are copies of one another, too.
    constexpr int pieces = 400;
    constexpr double margin = 1e-9;  // L goes on from 2 pi to 0 by a turn
    for (int i = 0; i <= pieces; ++i) angles.push_back(margin + (2 * pi - 2 * margin) * i / pieces);
    if (q < 0) from.start.x += 2 * pi;
    const Polyline turn = line(angles, integral);
    const double growth = std::abs(turn.back().y - turn.front().y);
    const int turns = growth < 1e-9 ? 0 : static_cast<int>(std::min(40.0, std::ceil(beyond / growth)));
    for (int i = -turns; i <= turns; ++i) {
      from.orbit.push_back(turn);
      for (Point& point : from.orbit.back()) point.y += i * growth;
    }
  }
  for (std::size_t i = 0; i < plane.rays().size(); ++i) {
    const bool last = i + 1 == plane.rays().size();
    const double left = plane.rays()[i].q, right = last ? plane.rays()[0].q + 2 * pi : plane.rays()[i + 1].q;
    const double middle = (left + right) / 2, start_q = q < left ? q + 2 * pi : q;
    from.rays.push_back(left);
    if (last) from.rays.push_back(right);
    angles.clear();
    constexpr int half = 500;  // closer and closer to the rays
    for (int j = -half; j <= half; ++j) angles.push_back(left + (right - left) / (1 + std::exp(-0.05 * j)));
    const bool of_start = start_q < right && (i == 0 || q > left || last) && start_q > left;
    if (of_start) from.start.x = start_q;
    (of_start ? from.orbit : from.elsewhere).push_back(line(angles, of_start ? integral : p + level(middle)));
  }
  from.in_plane = [plane](Point point) {
    const Vector2d x = plane.point(point.x, point.y);
    return Point{x[0], x[1]};
  };
  const Vector2d centre = plane.centre();
  const double half = widths * (start - centre).lpNorm<Eigen::Infinity>(), first = from.rays.empty() ? 0 : from.rays[0];
  from.plane.x = {"{/:Italic u}", centre[0] - half, centre[0] + half, false, {}};
  from.plane.y = {"{/:Italic v}", centre[1] - half, centre[1] + half, false, {}};
  from.plane.to_scale = true;
  from.strip.x = {"{/:Italic q}, the angle", first, first + 2 * pi, false, {}};
  from.strip.y = {"{/:Italic p}", p - below, p + above, false, {}};
  return drawn(std::move(from), "The reduction of  " + literal(name), size);
}

}  // namespace contensou::portraits
