#include "views/portrait_panel.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "contensou/portraits/layout.hpp"

namespace contensou::portraits {

Text Drawing::speed(const Text& name) const {
  return caption.speed_unit.empty() ? name : name + ", " + caption.speed_unit;
}

Text law_legend(const PhasePortrait& portrait) { return "law " + shortened(portrait.system().law().name()); }

std::vector<double> ray_log_ratios(const PhasePortrait& portrait) {
  std::vector<double> ln_k;
  for (const reduction::InvariantRay& ray : portrait.plane.terminal.rays) ln_k.push_back(std::log(ray.k));
  return ln_k;
}

Instant at_log_ratio(const PortraitOrbit& curve, double ln_k) {
  for (Eigen::Index i = 1; i < curve.rows(); ++i) {
    const double before = curve.ln_k[i - 1], now = curve.ln_k[i];
    if ((before - ln_k) * (now - ln_k) > 0 || before == now) continue;
    const double fraction = std::isfinite(now) ? (ln_k - before) / (now - before) : 0;
    const auto mixed = [&](double a, double b) {
      return b > 0 ? std::exp((1 - fraction) * std::log(a) + fraction * std::log(b)) : a;
    };
    return {mixed(curve.u[i - 1], curve.u[i]), mixed(curve.v[i - 1], curve.v[i]),
            std::isfinite(curve.ln_v[i]) ? curve.ln_v[i - 1] + fraction * (curve.ln_v[i] - curve.ln_v[i - 1])
                                         : curve.ln_v[i - 1],
            ln_k, mixed(curve.tau_left[i - 1], curve.tau_left[i])};
  }
  return curve.at(curve.rows() - 2);
}

Instant instant_at(double mu, double u, double ln_v) {
  return {u, std::exp(ln_v), ln_v, ln_v - std::log(mu * std::abs(u)), 0};
}

Instant instant_at_logarithms(double mu, double ln_k, double ln_v) {
  return {std::exp(ln_v - ln_k) / mu, std::exp(ln_v), ln_v, ln_k, 0};
}

Polyline PanelMap::line(const PortraitOrbit& orbit) const {
  Polyline line;
  for (Eigen::Index i = 0; i < orbit.rows(); ++i) line.push_back(place(orbit.at(i), orbit.at(0)));
  return line;
}

Polyline PortraitPanel::line_of(const Copy& copy) const {
  const auto row = [&](Eigen::Index i) {
    Instant at = copy.orbit.at(i, copy.factor);
    at.u *= copy.sign;
    return at;
  };
  Polyline line;
  for (Eigen::Index i = 0; i < copy.orbit.rows(); ++i) line.push_back(map_.place(row(i), row(0)));
  return line;
}

Polyline PortraitPanel::line_of(const Isochrone& isochrone) const {
  Polyline line;
  for (Eigen::Index i = 0; i < isochrone.u.size(); ++i) line.push_back(place(isochrone.u[i], isochrone.v[i]));
  return line;
}

Point PortraitPanel::place(double u, double v) const {
  const Instant at{u, v, std::log(v), std::log(v / (drawing_.portrait.system().mu() * std::abs(u))), 0};
  return map_.place(at, at);
}

void PortraitPanel::add_highlights() {
  if (!drawing_.style.asked) return;
  const PhasePortrait& portrait = drawing_.portrait;
  if (!portrait.through.empty()) {
    const Stroke stroke = asked_stroke(drawing_.palette, false);
    std::vector<Copy> copies;
    Marks points{{}, stroke.colour, 0.9, Marks::Shape::circle, through_legend};
    for (const PortraitOrbit& orbit : portrait.through) copies.push_back({orbit});
    for (const reduction::State& point : portrait.points) points.points.push_back(place(point.u, point.v));
    heads_.clear();
    add_plain(copies, stroke, through_legend);
    panel_.marks.push_back(std::move(points));
  }
  if (portrait.highlight) {
    heads_.clear();
    const Stroke stroke = asked_stroke(drawing_.palette, true);
    const Text& legend = drawing_.caption.highlight;
    add_plain({{*portrait.highlight}}, stroke, legend);
    panel_.marks.push_back({{map_.line(*portrait.highlight).front()}, stroke.colour, 0.6, Marks::Shape::dot, legend});
  }
}

/// Points on paper along a line, no farther apart than a step.
std::vector<Point> PortraitPanel::on_paper_along(const Polyline& line, double step) const {
  std::vector<Point> points;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point from = on_paper(panel_, line[i - 1]), to = on_paper(panel_, line[i]);
    const int pieces = 1 + static_cast<int>(std::min(1 / step, std::hypot(to.x - from.x, to.y - from.y) / step));
    for (int j = 0; j < pieces; ++j) points.push_back(between(from, to, static_cast<double>(j) / pieces));
  }
  if (!line.empty()) points.push_back(on_paper(panel_, line.back()));
  return points;
}

void PortraitPanel::add_invariant(std::vector<Polyline> axes,
                                  const std::function<std::vector<Polyline>(double ln_k)>& ray) {
  if (!drawing_.style.invariant) return;
  const auto add_arrows = [this](const Lines& lines) {
    if (drawing_.style.arrows == PortraitStyle::Arrows::none) return;
    Arrows arrows{{}, lines.stroke.colour};
    for (const Polyline& line : lines.lines) {
      for (const Polyline& part : clipped(panel_, line)) {
        for (double fraction : {0.3, 0.7}) arrows.arrows.push_back(arrow_along(panel_, part, fraction));
      }
    }
    panel_.arrows.push_back(std::move(arrows));
  };
  if (!axes.empty()) {
    panel_.lines.push_back({std::move(axes), {drawing_.palette.invariant, 1.8, false}, "invariant axes"});
    add_arrows(panel_.lines.back());
  }
  Lines attracting{{}, {drawing_.palette.comparison, 3, false}, "invariant ray " + math("k = k*")};
  Lines repelling{{}, {drawing_.palette.comparison, 2.2, true}, "invariant ray that orbits leave"};
  for (const reduction::InvariantRay& of : drawing_.portrait.plane.terminal.rays) {
    Lines& lines = of.attracts_above || of.attracts_below ? attracting : repelling;
    std::ranges::move(ray(std::log(of.k)), std::back_inserter(lines.lines));
  }
  for (Lines& lines : {std::ref(attracting), std::ref(repelling)}) {
    if (lines.lines.empty()) continue;
    add_arrows(lines);
    panel_.lines.push_back(std::move(lines));
  }
}

void PortraitPanel::add_field() {
  using Field = PortraitStyle::Field;
  if (drawing_.style.field == Field::none) return;
  const reduction::ReducedSystem& system = drawing_.portrait.system();
  constexpr double cell_mm = 6.5;
  const int columns = static_cast<int>(drawing_.panel_mm.x / cell_mm),
            rows = static_cast<int>(drawing_.panel_mm.y / cell_mm);
  struct Needle {
    Point at, direction;  ///< on paper, the direction of length 1
    double size;
  };
  std::vector<Needle> needles;
  double min_size = std::numeric_limits<double>::infinity(), max_size = 0;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const Point at{(i + 0.5) / columns, (j + 0.5) / rows};
      const auto there = map_.state(from_paper(panel_, at));
      if (!there) continue;
      const reduction::State here{there->u, there->v};
      const reduction::Rate rate =
          drawing_.style.field == Field::regularised ? system.regularised_field(here) : system.field(here);
      // A step that is small beside both speeds.
      const double fastest = std::max(std::abs(rate.u / here.u), std::abs(rate.v / here.v));
      const double h = 1e-4 / fastest;
      const Point from = on_paper(panel_, place(here.u, here.v));
      const Point to = on_paper(panel_, place(here.u + h * rate.u, here.v + h * rate.v));
      const double x = to.x - from.x, y = to.y - from.y;
      const double length = std::hypot(x, y);
      const double size = std::hypot(rate.u / drawing_.portrait.window.u, rate.v / drawing_.portrait.window.v);
      if (!(length > 0) || !(size > 0)) continue;
      min_size = std::min(min_size, size);
      max_size = std::max(max_size, size);
      needles.push_back({at, {x / length, y / length}, size});
    }
  }
  Lines lines{{},
              {drawing_.palette.field, 1, false},
              drawing_.style.field == Field::regularised ? "direction of the regularised motion (2.7)"
                                                         : "direction of the motion (2.6)"};
  Arrows heads{{}, drawing_.palette.field, 0.6};
  for (const Needle& needle : needles) {
    const double fraction = max_size > min_size ? std::log(needle.size / min_size) / std::log(max_size / min_size) : 1;
    const double cell = 1 / std::max(std::abs(needle.direction.x) * columns, std::abs(needle.direction.y) * rows);
    const double half = (0.25 + 0.6 * fraction) / 2 * cell;
    const Point tail{needle.at.x - half * needle.direction.x, needle.at.y - half * needle.direction.y};
    const Point tip{needle.at.x + half * needle.direction.x, needle.at.y + half * needle.direction.y};
    lines.lines.push_back({from_paper(panel_, tail), from_paper(panel_, tip)});
    heads.arrows.push_back(arrow_along(panel_, lines.lines.back(), 1));
  }
  panel_.lines.insert(panel_.lines.begin(), std::move(lines));
  panel_.arrows.insert(panel_.arrows.begin(), std::move(heads));
}

}  // namespace contensou::portraits
