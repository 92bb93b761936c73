#include "views/panel_layers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "contensou/reduction/detail/infinity.hpp"

namespace contensou::portraits {

LayerLook look_of(const PaperSize& size, int panels, bool screen) {
  LayerLook look{palette(screen), {}, panel_size(size, panels), 0};
  look.letter = letter_mm(size.width_mm) * look.palette.theme.letters;
  return look;
}

TimedLine PanelLayers::line_of(const OrbitCopy& copy) const {
  const auto row = [&](Eigen::Index i) {
    PortraitOrbit::Instant at = copy.orbit.at(i, copy.factor);
    at.u *= copy.sign;
    return at;
  };
  TimedLine timed;
  for (Eigen::Index i = 0; i < copy.orbit.rows(); ++i) {
    timed.line.push_back(map_.place(row(i), row(0)));
    timed.left.push_back(copy.factor * copy.orbit.tau_left[i]);
  }
  return timed;
}

Polyline PanelLayers::line_of(const Isochrone& isochrone) const {
  Polyline line;
  for (Eigen::Index i = 0; i < isochrone.u.size(); ++i) line.push_back(place(isochrone.u[i], isochrone.v[i]));
  return line;
}

Point PanelLayers::place(double u, double v) const {
  const PortraitOrbit::Instant at{u, v, std::log(v), std::log(v / (look_.mu * std::abs(u))), 0};
  return map_.place(at, at);
}

std::vector<Point> PanelLayers::on_paper_along(const Polyline& line, double step) const {
  std::vector<Point> points;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point from = on_paper(panel_, line[i - 1]), to = on_paper(panel_, line[i]);
    const int pieces = 1 + static_cast<int>(std::min(1 / step, std::hypot(to.x - from.x, to.y - from.y) / step));
    for (int j = 0; j < pieces; ++j) points.push_back(between(from, to, static_cast<double>(j) / pieces));
  }
  if (!line.empty()) points.push_back(on_paper(panel_, line.back()));
  return points;
}

bool PanelLayers::add_orbits(std::vector<TimedLine> orbits, bool coloured, const Text& legend) {
  const auto plain = std::stable_partition(orbits.begin(), orbits.end(), [=](const TimedLine& orbit) {
    return coloured && std::isfinite(orbit.left.front());
  });
  const std::vector<TimedLine> others(plain, orbits.end());
  orbits.erase(plain, orbits.end());
  if (!others.empty()) add_plain(others, {look_.palette.orbit, 1.3}, orbits.empty() ? legend : "other orbits");
  add_coloured(orbits);
  return !orbits.empty();
}

void PanelLayers::add_coloured(const std::vector<TimedLine>& orbits) {
  // A line is divided into parts, one for each band that the orbit crosses. The last times are on top.
  const TimeBands& bands = look_.bands;
  std::map<std::size_t, std::vector<Polyline>, std::greater<>> layers;
  std::map<std::size_t, Arrows, std::greater<>> heads;
  for (const TimedLine& orbit : orbits) {
    const auto& [line, left] = orbit;
    orbits_.push_back(line);
    for (const auto& [arrow, time] : arrows_on(orbit)) heads[bands.band(time)].arrows.push_back(arrow);
    Polyline piece{line.front()};
    std::size_t band = bands.band(left[0]);
    for (std::size_t i = 1; i < line.size(); ++i) {
      const double before = left[i - 1], now = left[i];
      const Point from = line[i - 1], to = line[i];
      for (; band > 0 && now < bands.begin(band); --band) {
        const Point cut = between(from, to, (before - bands.begin(band)) / (before - now));
        piece.push_back(cut);
        layers[band].push_back(std::exchange(piece, {cut}));
      }
      piece.push_back(to);
    }
    layers[band].push_back(std::move(piece));
  }
  for (auto& [band, lines] : layers) panel_.lines.push_back({std::move(lines), {bands.colours[band], 1.5, false}, ""});
  for (auto& [band, arrows] : heads) panel_.arrows.push_back({std::move(arrows.arrows), bands.colours[band]});
}

void PanelLayers::add_plain(const std::vector<TimedLine>& orbits, Stroke stroke, const Text& legend) {
  Lines lines{{}, stroke, legend};
  Arrows arrows{{}, stroke.colour};
  for (const TimedLine& orbit : orbits) {
    lines.lines.push_back(orbit.line);
    orbits_.push_back(orbit.line);
    if (stroke.dashed) continue;
    for (const TimedArrow& timed : arrows_on(orbit)) arrows.arrows.push_back(timed.arrow);
  }
  panel_.lines.push_back(std::move(lines));
  panel_.arrows.push_back(std::move(arrows));
}

void PanelLayers::add_highlights() {
  if (!look_.style.asked) return;
  const Portrait& curves = look_.curves;
  const auto add = [&](const std::vector<PortraitOrbit>& orbits, bool of_start, const Text& legend) {
    if (asked_first_) heads_.clear();
    if (!orbits.empty()) add_plain(lines_of(orbits), asked_stroke(look_.palette, of_start), legend);
  };
  if (!curves.points.empty()) {
    add(curves.through, false, through_legend);
    add_points();
  }
  if (!curves.uncoupled.empty())
    add_plain(lines_of(curves.uncoupled), uncoupled_stroke(look_.palette), uncoupled_legend);
  if (curves.highlight.empty()) return;
  const Text& legend = look_.caption.highlight;
  add(curves.highlight, true, legend);
  const Point start = map_.line(curves.highlight.front()).front();
  if (inside(on_paper(panel_, start), 0))
    panel_.marks.push_back({{start}, look_.palette.highlight, 0.6, Marks::Shape::dot, legend});
}

void PanelLayers::add_points() {
  std::vector<Point> points;
  for (const reduction::State& point : look_.curves.points) points.push_back(place(point.u, point.v));
  const bool numbered = points.size() > 1;
  constexpr double small = 0.9, around_number = 2.6;
  const Colour colour = look_.palette.highlight;
  panel_.marks.push_back({points, colour, numbered ? around_number : small, Marks::Shape::circle, through_legend});
  for (std::size_t i = 0; numbered && i < points.size(); ++i) {
    if (inside(on_paper(panel_, points[i]), 0)) panel_.labels.push_back({points[i], fmt::format("{}", i + 1), colour});
  }
}

/// Returns arrow heads at equal times left, halfway between isochrones; every orbit gets at least one.
std::vector<PanelLayers::TimedArrow> PanelLayers::arrows_on(const TimedLine& orbit) {
  const Polyline& line = orbit.line;
  const std::vector<double>& times = orbit.left;
  using Style = PortraitStyle::Arrows;
  std::vector<TimedArrow> result;
  if (look_.style.arrows == Style::none) return result;
  const auto has_room = [&](const Arrow& arrow) {
    const Point at = on_paper(panel_, arrow.at);
    if (!std::isfinite(at.x) || !std::isfinite(at.y) || !inside(at, 0.03)) return false;
    const auto crowds = [&](Point other) {
      return std::hypot((other.x - at.x) * look_.panel_mm.x, (other.y - at.y) * look_.panel_mm.y) <
             keep_off_ * look_.letter;
    };
    if (std::ranges::any_of(heads_, crowds)) return false;
    heads_.push_back(at);
    return true;
  };
  // The nearest row gives the time of the arrow.
  const auto add_there = [&](const Arrow& arrow) {
    if (!has_room(arrow)) return;
    const auto nearest =
        std::ranges::min_element(line, {}, [&](Point point) { return paper_distance(panel_, point, arrow.at); });
    result.push_back({arrow, times[static_cast<std::size_t>(nearest - line.begin())]});
  };
  if (look_.style.arrows == Style::time) {
    // Times are taken in the order of the motion, in which the time left decreases.
    for (auto time = look_.bands.arrows.rbegin(); time != look_.bands.arrows.rend(); ++time) {
      const auto place = std::ranges::lower_bound(times, *time, std::greater<>());
      if (place == times.begin() || place == times.end()) continue;
      const auto row = static_cast<std::size_t>(place - times.begin());
      const double before = times[row - 1], now = times[row];
      const Point from = line[row - 1], to = line[row];
      const Arrow arrow{between(from, to, (before - *time) / (before - now)), {to.x - from.x, to.y - from.y}};
      if (has_room(arrow)) result.push_back({arrow, *time});
    }
  }
  const std::vector<Polyline> parts = clipped(panel_, line);
  if (parts.empty()) return result;
  // A head would cover an orbit that is as small as itself.
  const auto extent = [&](double Point::*side, double unit) {
    const auto [low, high] = std::ranges::minmax(line, {}, side);
    return (on_paper(panel_, high).*side - on_paper(panel_, low).*side) * unit;
  };
  if (std::max(extent(&Point::x, look_.panel_mm.x), extent(&Point::y, look_.panel_mm.y)) < 2.5 * look_.letter)
    return result;
  if (early_arrows_ && look_.style.arrows == Style::time) {
    const Arrow arrow = arrow_along(panel_, parts.front(), 0.2);
    if (on_paper(panel_, arrow.at).y > 0.6) add_there(arrow);
  }
  if (!result.empty()) return result;
  for (double fraction : {arrow_fraction_, arrow_fraction_ + 0.1, arrow_fraction_ - 0.1}) {
    add_there(arrow_along(panel_, parts.front(), fraction));
    if (!result.empty()) break;
  }
  return result;
}

void PanelLayers::add_invariant(Lines lines) {
  if (lines.lines.empty()) return;
  Arrows arrows{{}, lines.stroke.colour};
  for (const Polyline& line : lines.lines) {
    for (const Polyline& part : clipped(panel_, line)) {
      for (double fraction : {0.3, 0.7}) arrows.arrows.push_back(arrow_along(panel_, part, fraction));
    }
  }
  if (look_.style.arrows != PortraitStyle::Arrows::none) panel_.arrows.push_back(std::move(arrows));
  panel_.lines.push_back(std::move(lines));
}

void PanelLayers::add_directions(const std::function<std::optional<Drift>(Point)>& at, const Text& legend, bool heads) {
  constexpr double cell_mm = 6.5;
  const int columns = static_cast<int>(look_.panel_mm.x / cell_mm), rows = static_cast<int>(look_.panel_mm.y / cell_mm);
  struct Needle {
    Point at, direction;  ///< on paper, direction of length 1
    double size;
  };
  std::vector<Needle> needles;
  double min_size = infinity, max_size = 0;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const Point middle{(i + 0.5) / columns, (j + 0.5) / rows};
      const auto drift = at(from_paper(panel_, middle));
      if (!drift) continue;
      const Point from = on_paper(panel_, drift->from), to = on_paper(panel_, drift->to);
      const double x = to.x - from.x, y = to.y - from.y;
      const double length = std::hypot(x, y);
      if (!(length > 0) || !(drift->size > 0)) continue;
      min_size = std::min(min_size, drift->size);
      max_size = std::max(max_size, drift->size);
      needles.push_back({middle, {x / length, y / length}, drift->size});
    }
  }
  Lines lines{{}, {look_.palette.field, 1, false}, legend};
  Arrows tips{{}, look_.palette.field, 0.6};
  for (const Needle& needle : needles) {
    const double fraction = !heads                ? 0.5
                            : max_size > min_size ? std::log(needle.size / min_size) / std::log(max_size / min_size)
                                                  : 1;
    const double cell = 1 / std::max(std::abs(needle.direction.x) * columns, std::abs(needle.direction.y) * rows);
    const double half = (0.25 + 0.6 * fraction) / 2 * cell;
    const Point tail{needle.at.x - half * needle.direction.x, needle.at.y - half * needle.direction.y};
    const Point tip{needle.at.x + half * needle.direction.x, needle.at.y + half * needle.direction.y};
    lines.lines.push_back({from_paper(panel_, tail), from_paper(panel_, tip)});
    if (heads) tips.arrows.push_back(arrow_along(panel_, lines.lines.back(), 1));
  }
  panel_.lines.insert(panel_.lines.begin(), std::move(lines));
  if (heads) panel_.arrows.insert(panel_.arrows.begin(), std::move(tips));
}

}  // namespace contensou::portraits
