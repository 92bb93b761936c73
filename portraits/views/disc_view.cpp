// The whole half-plane in one picture: the Poincare disc. In the view blowup the origin is blown up to a half-circle.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "contensou/reduction/detail/infinity.hpp"
#include "views/portrait_views.hpp"

namespace contensou::portraits {

using std::numbers::pi;

namespace {

/// A polar map of the half-plane to a half-disc or half-annulus of radius 1: rho = hypot(mu u, v), theta = atan(k).
struct PolarMap {
  double unit;  ///< unit of rho, a speed
  double hole;  ///< radius of the half-circle to which the origin is blown up

  double radius(double rho) const {
    if (std::isinf(rho)) return 1;
    const double x = rho / unit;
    return hole == 0 ? x / std::hypot(1, x) : hole + (1 - hole) * x / (1 + x);
  }
  double rho(double radius) const {
    if (hole == 0) return unit * radius / std::sqrt((1 - radius) * (1 + radius));
    const double x = (radius - hole) / (1 - hole);
    return unit * x / (1 - x);
  }
  Point at(double rho, double theta, double sign) const {
    const double r = radius(rho);
    return {sign * r * std::cos(theta), r * std::sin(theta)};
  }
};

Polyline half_circle(double radius) {
  Polyline line;
  constexpr int pieces = 180;
  for (int i = 0; i <= pieces; ++i) {
    line.push_back({radius * std::cos(pi * i / pieces), radius * std::sin(pi * i / pieces)});
  }
  return line;
}

/// Adds singular points by kind, on the circle at infinity and on the circle of the origin.
void add_points(Panel& panel, const Drawing& drawing, const PolarMap& map) {
  using reduction::SingularPlace;
  const auto kind = [&](std::string_view which, Marks::Shape shape) {
    Marks marks{{}, drawing.palette.highlight, 1.4, shape, which};
    for (const reduction::SingularPoint& point : drawing.portrait.plane.points) {
      if (point.kind != which) continue;
      if (point.place == SingularPlace::origin && map.hole == 0) continue;
      const double theta = std::atan(point.k);
      const double rho = point.place == SingularPlace::origin ? 0 : infinity;
      marks.points.push_back(map.at(rho, theta, 1));
      if (std::cos(theta) > 1e-12) marks.points.push_back(map.at(rho, theta, -1));
    }
    if (!marks.points.empty()) panel.marks.push_back(std::move(marks));
  };
  kind("stable node", Marks::Shape::dot);
  kind("unstable node", Marks::Shape::circle);
  kind("saddle", Marks::Shape::square);
  kind("degenerate", Marks::Shape::diamond);
}

/// Adds the directions of motion along the circle of the points at infinity and the circle of the blown-up origin.
void add_turning(Panel& panel, const Drawing& drawing, const PolarMap& map) {
  std::vector<double> angles{0};  // angles of v = 0 and the invariant half-lines, up to u = 0
  for (const reduction::SingularPoint& point : drawing.portrait.plane.points) {
    const double angle = std::atan(point.k);
    if (angle > angles.back()) angles.push_back(angle);
  }
  Arrows arrows{{}, drawing.palette.invariant};
  const reduction::ReducedSystem& system = drawing.portrait.system();
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    const double middle = (angles[i] + angles[i + 1]) / 2;
    const double k = std::tan(middle);
    const auto [force, moment] = system.law()(reduction::slip_of_ratio(k));
    const double turn = force - system.drive() - system.r() * k * moment > 0 ? -1 : 1;  // 1: theta grows; -1: it falls
    for (double sign : {1.0, -1.0}) {
      for (double rho : {0.0, infinity}) {
        if (rho == 0 && map.hole == 0) continue;
        arrows.arrows.push_back(
            {map.at(rho, middle, sign), {-sign * turn * std::sin(middle), turn * std::cos(middle)}});
      }
    }
  }
  panel.arrows.push_back(std::move(arrows));
}

MappedPanel polar_panel(const Drawing& drawing, double hole) {
  const PhasePortrait& portrait = drawing.portrait;
  const double mu = portrait.system().mu();
  const PolarMap map{portrait.window.v(), hole};
  Panel panel;
  // The distance of labels grows with the letters, so that labels avoid the marks in a small panel, too.
  const double letter = drawing.letter / std::min(drawing.panel_mm.x / 2.26, drawing.panel_mm.y / 1.26);
  const double off = std::max(0.075, 0.62 * letter), margin = std::max(0.13, off + 0.5 * letter);
  panel.x = {"", -1 - 0.13, 1 + 0.13, false, {}};
  // Beside the chart, the line v = 0 is level with an axis, and labels have the room of its numbers.
  panel.y = {"", hole > 0 ? 0 : -margin, 1 + margin, false, {}};
  panel.to_scale = true;
  panel.bare = true;
  panel.regions.push_back({half_circle(1), drawing.palette.region});
  if (hole > 0) panel.regions.push_back({half_circle(hole), drawing.palette.theme.ground});

  const auto place = [mu, map](const Instant& at, const Instant& start) {
    const double rho = std::hypot(mu * at.u, at.v);
    const double theta = at.ln_k > 0 ? pi / 2 - std::atan(std::exp(-at.ln_k)) : std::atan(std::exp(at.ln_k));
    return map.at(rho, theta, std::copysign(1, start.u));
  };
  const auto state = [mu, map](Point at) -> std::optional<Instant> {
    const double radius = std::hypot(at.x, at.y);
    if (radius <= map.hole || radius >= 1 || at.y <= 0) return std::nullopt;
    const double rho = map.rho(radius);
    Instant there = instant_at_logarithms(mu, std::log(at.y / std::abs(at.x)), std::log(rho * at.y / radius));
    there.u = rho * at.x / radius / mu;
    return there;
  };
  PortraitPanel layers(drawing, std::move(panel), {place, state});
  layers.set_arrows(0.4, 1);
  const auto copies = [&](const PortraitOrbit& curve) {
    // Orbits cross the line k = 1 at equal steps of the radius.
    const int count = drawing.crowd(10);
    const Instant at = at_log_ratio(curve, 0);
    const double rho = std::hypot(mu * at.u, at.v);
    std::vector<OrbitCopy> result;
    for (int i = 0; i < count; ++i) {
      const double radius = hole + (1 - hole) * (i + 0.5) / count;
      for (double sign : {1.0, -1.0}) result.push_back({curve, map.rho(radius) / rho, sign});
    }
    return result;
  };
  layers.add_copies(copies, true);
  const auto half_line = [&](double theta, double sign) {
    return Polyline{map.at(infinity, theta, sign), map.at(0, theta, sign)};
  };
  layers.add_invariant({half_line(pi / 2, 1)}, {half_line(0, 1), half_line(0, -1)}, [&](double ln_k) {
    const double theta = std::atan(std::exp(ln_k));
    return std::vector{half_line(theta, 1), half_line(theta, -1)};
  });
  layers.add_highlights();
  MappedPanel finished = std::move(layers).finished();
  panel = std::move(finished.panel);
  panel.lines.push_back({{half_circle(1)}, {drawing.palette.invariant, 1.2, false}, ""});
  if (hole > 0) panel.lines.push_back({{half_circle(hole)}, {drawing.palette.invariant, 2.2, false}, ""});
  add_turning(panel, drawing, map);
  add_points(panel, drawing, map);
  const Colour ink = drawing.palette.theme.ink;
  panel.labels.push_back({{1.03, -off}, math("u → ∞"), ink, Label::Align::centre});
  panel.labels.push_back({{-1.03, -off}, math("u → −∞"), ink, Label::Align::centre});
  panel.labels.push_back({{0, 1 + off}, math("v → ∞"), ink, Label::Align::centre});
  if (hole > 0) {
    panel.labels.push_back({{0, 0.42 * hole}, "the stop", ink, Label::Align::centre});
  } else {
    panel.marks.push_back({{{0, 0}}, drawing.palette.invariant, 1.4, Marks::Shape::dot, "the stop"});
  }
  finished.panel = std::move(panel);
  return finished;
}

}  // namespace

std::vector<MappedPanel> disc_view(const Drawing& drawing) { return {polar_panel(drawing, 0)}; }

std::vector<MappedPanel> blowup_view(const Drawing& drawing) {
  constexpr double hole = 0.35;
  MappedPanel polar = polar_panel(drawing, hole);
  polar.panel.title = "inner half-circle: the origin; outer: infinity";

  MappedPanel chart = contact_panel(drawing, true);
  chart.panel.title = "the chart " + math("u") + ", ln " + math("k") + "; " + math("u = 0") + " is the origin";
  return {std::move(polar), std::move(chart)};
}

}  // namespace contensou::portraits
