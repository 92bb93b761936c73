// The whole half-plane in one picture: the Poincare disc, and the same with the origin blown up.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "views/portrait_views.hpp"

namespace contensou::portraits {

using std::numbers::pi;

namespace {

/// A polar map of the half-plane of the patch, rho = hypot(mu u, v) and theta = atan(k), onto a half-disc or a
/// half-annulus of outer radius 1.
struct PolarMap {
  double unit;  ///< the speed in whose units rho is measured
  double hole;  ///< radius of the half-circle that the origin is blown up to

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

/// Copies of each curve that cross the middle of its sector at even steps of the radius.
std::vector<PortraitPanel::Copy> evenly(const PhasePortrait& portrait, const PolarMap& map, int count) {
  const std::vector<double> angles = invariant_angles(portrait);
  std::vector<PortraitPanel::Copy> copies;
  for (const PortraitOrbit& curve : portrait.curves) {
    // The sector that the curve crosses: from where it is born to the tangent.
    const bool from_sliding = curve.ln_k[0] > 0;
    const double low = from_sliding && angles.size() > 2 ? angles[1] : 0;
    const double high = from_sliding || angles.size() == 2 ? pi / 2 : angles[1];
    const Instant at = at_log_ratio(curve, std::log(std::tan((low + high) / 2)));
    const double rho = std::hypot(portrait.system.mu() * at.u, at.v);
    for (int i = 0; i < count; ++i) {
      const double radius = map.hole + (1 - map.hole) * (i + 0.5) / count;
      for (double sign : {1.0, -1.0}) copies.push_back({curve, map.rho(radius) / rho, sign});
    }
  }
  return copies;
}

/// Singular points by kind, on the circle at infinity and on the origin's.
void add_points(Panel& panel, const Drawing& drawing, const PolarMap& map) {
  using reduction::SingularKind;
  using reduction::SingularPlace;
  const auto kind = [&](SingularKind which, Marks::Shape shape, const char* legend) {
    Marks marks{{}, drawing.palette.highlight, 1.4, shape, legend};
    for (const reduction::SingularPoint& point : drawing.portrait.plane.points) {
      if (point.kind != which) continue;
      if (point.place == SingularPlace::origin && map.hole == 0) continue;
      const double theta = std::atan(point.k);
      const double rho = point.place == SingularPlace::origin ? 0 : std::numeric_limits<double>::infinity();
      marks.points.push_back(map.at(rho, theta, 1));
      if (std::cos(theta) > 1e-12) marks.points.push_back(map.at(rho, theta, -1));
    }
    if (!marks.points.empty()) panel.marks.push_back(std::move(marks));
  };
  kind(SingularKind::stable_node, Marks::Shape::dot, "stable node");
  kind(SingularKind::unstable_node, Marks::Shape::circle, "unstable node");
  kind(SingularKind::saddle, Marks::Shape::square, "saddle");
  kind(SingularKind::degenerate, Marks::Shape::square, "degenerate");
}

/// The way of the motion along the circles of the points at infinity and of the blown-up origin.
void add_turning(Panel& panel, const Drawing& drawing, const PolarMap& map) {
  const std::vector<double> angles = invariant_angles(drawing.portrait);
  Arrows arrows{{}, drawing.palette.invariant};
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    const double middle = (angles[i] + angles[i + 1]) / 2;
    const double k = std::tan(middle);
    const auto [force, moment] = drawing.portrait.system.law()(reduction::slip_of_ratio(k));
    const double turn = force - drawing.portrait.system.r() * k * moment > 0 ? -1 : 1;  // of theta
    for (double sign : {1.0, -1.0}) {
      for (double rho : {0.0, std::numeric_limits<double>::infinity()}) {
        if (rho == 0 && map.hole == 0) continue;
        arrows.arrows.push_back(
            {map.at(rho, middle, sign), {-sign * turn * std::sin(middle), turn * std::cos(middle)}});
      }
    }
  }
  panel.arrows.push_back(std::move(arrows));
}

Panel polar_panel(const Drawing& drawing, double hole) {
  const PhasePortrait& portrait = drawing.portrait;
  const double mu = portrait.system.mu();
  const PolarMap map{portrait.window.v, hole};
  Panel panel;
  constexpr double margin = 0.13;
  panel.x = {"", -1 - margin, 1 + margin, false, {}};
  panel.y = {"", -0.13, 1 + margin, false, {}};
  panel.to_scale = true;
  panel.bare = true;
  panel.regions.push_back({half_circle(1), drawing.palette.region});
  if (hole > 0) panel.regions.push_back({half_circle(hole), drawing.palette.theme.ground});

  PortraitPanel layers(drawing, std::move(panel), [mu, map](const Instant& at) {
    const double rho = std::hypot(mu * at.u, at.v);
    const double theta = at.ln_k > 0 ? pi / 2 - std::atan(std::exp(-at.ln_k)) : std::atan(std::exp(at.ln_k));
    return map.at(rho, theta, std::copysign(1, at.u));
  });
  layers.set_arrows(0.4, 0.02);
  layers.add_orbits([&](const PhasePortrait& of) { return evenly(of, map, 10); });
  std::vector<Polyline> axes, ray;
  for (double theta : invariant_angles(portrait)) {
    std::vector<Polyline>& lines = theta > 0 && theta < pi / 2 ? ray : axes;
    for (double sign : {1.0, -1.0}) {
      if (sign < 0 && theta == pi / 2) continue;
      lines.push_back({map.at(0, theta, sign), map.at(std::numeric_limits<double>::infinity(), theta, sign)});
    }
  }
  layers.add_invariant(std::move(axes), std::move(ray));
  layers.add_highlights();
  panel = std::move(layers).finished();
  panel.lines.push_back({{half_circle(1)}, {drawing.palette.invariant, 1.2, false}, ""});
  if (hole > 0) panel.lines.push_back({{half_circle(hole)}, {drawing.palette.invariant, 2.2, false}, ""});
  add_turning(panel, drawing, map);
  add_points(panel, drawing, map);
  const Colour ink = drawing.palette.theme.ink;
  panel.labels.push_back({{1.03, -0.07}, "{/:Italic u} → ∞", ink, Label::Align::centre});
  panel.labels.push_back({{-1.03, -0.07}, "{/:Italic u} → −∞", ink, Label::Align::centre});
  panel.labels.push_back({{0, 1.08}, "{/:Italic v} → ∞", ink, Label::Align::centre});
  if (hole > 0) {
    panel.labels.push_back({{0, 0.42 * hole}, "the stop", ink, Label::Align::centre});
  } else {
    panel.marks.push_back({{{0, 0}}, drawing.palette.highlight, 1.4});
    panel.labels.push_back({{0, -0.07}, "stop", ink, Label::Align::centre});
  }
  return panel;
}

}  // namespace

std::vector<double> invariant_angles(const PhasePortrait& portrait) {
  std::vector<double> angles;
  for (const reduction::SingularPoint& point : portrait.plane.points) {
    const double angle = std::atan(point.k);
    if (angles.empty() || angle > angles.back()) angles.push_back(angle);
  }
  return angles;
}

bool reaches(const PortraitOrbit& curve, double ln_k) {
  return (curve.ln_k[0] - ln_k) * (curve.ln_k[curve.rows() - 1] - ln_k) < 0;
}

Instant at_log_ratio(const PortraitOrbit& curve, double ln_k) {
  for (Eigen::Index i = 1; i < curve.rows(); ++i) {
    const double before = curve.ln_k[i - 1], now = curve.ln_k[i];
    if ((before - ln_k) * (now - ln_k) > 0 || before == now) continue;
    const double share = std::isfinite(now) ? (ln_k - before) / (now - before) : 0;
    const auto mixed = [&](double a, double b) {
      return b > 0 ? std::exp((1 - share) * std::log(a) + share * std::log(b)) : a;
    };
    return {mixed(curve.u[i - 1], curve.u[i]), mixed(curve.v[i - 1], curve.v[i]),
            std::isfinite(curve.ln_v[i]) ? curve.ln_v[i - 1] + share * (curve.ln_v[i] - curve.ln_v[i - 1])
                                         : curve.ln_v[i - 1],
            ln_k, mixed(curve.tau_left[i - 1], curve.tau_left[i])};
  }
  return curve.at(curve.rows() - 2);
}

std::vector<Panel> disc_view(const Drawing& drawing) { return {polar_panel(drawing, 0)}; }

std::vector<Panel> blowup_view(const Drawing& drawing) {
  using reduction::InvariantDirection;
  const PhasePortrait& portrait = drawing.portrait;
  constexpr double hole = 0.35;
  Panel polar = polar_panel(drawing, hole);
  polar.title = "inner half-circle: the origin; outer: infinity";

  // The chart v = q u, with k = q/mu.
  const double U = portrait.window.u;
  const double k_star = portrait.plane.tangent == InvariantDirection::ray ? portrait.plane.terminal.k : 0;
  const double top = k_star > 0 ? 2.5 * k_star : 3;
  Panel chart;
  chart.title = "the chart {/:Italic u}, {/:Italic k = v}/({/:Italic μu}); {/:Italic u} = 0 is the origin";
  chart.x = {drawing.speed("{/:Italic u}"), 0, U, false, {}};
  chart.y = {"{/:Italic k}", 0, top, false, {}};
  PortraitPanel layers(drawing, std::move(chart), [top](const Instant& at) {
    return Point{at.u, std::min(std::exp(at.ln_k), 100 * top)};
  });
  layers.add_orbits([&](const PhasePortrait& of) {
    const bool ray = of.plane.tangent == InvariantDirection::ray;
    std::vector<PortraitPanel::Copy> copies;
    for (const PortraitOrbit& curve : of.curves) {
      constexpr int count = 12;
      const bool from_above = curve.ln_k[0] > 0;
      const double on_ray = of.plane.terminal.k;
      const double k = from_above ? (ray ? 1.6 * on_ray : top) : (ray ? 0.45 * on_ray : top / 3);
      const double u = at_log_ratio(curve, std::log(k)).u;
      for (int i = 0; i < count; ++i) copies.push_back({curve, (i + 0.5) / count * U * (ray ? 1.6 : 1) / u});
    }
    return copies;
  });
  std::vector<Polyline> ray;
  if (k_star > 0) ray = {{{0, k_star}, {U, k_star}}};
  layers.add_invariant({{{0, 0}, {U, 0}}, {{0, 0}, {0, top}}}, std::move(ray));
  layers.add_highlights();
  return {std::move(polar), std::move(layers).finished()};
}

}  // namespace contensou::portraits
