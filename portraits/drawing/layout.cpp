#include "contensou/portraits/layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace contensou::portraits {

namespace {

double share(const Axis& axis, double value) {
  if (axis.logarithmic) return std::log(value / axis.low) / std::log(axis.high / axis.low);
  return (value - axis.low) / (axis.high - axis.low);
}

double value(const Axis& axis, double share) {
  if (axis.logarithmic) return axis.low * std::pow(axis.high / axis.low, share);
  return axis.low + share * (axis.high - axis.low);
}

/// The part [from, to] of the way from a to b that lies in the unit square, if there is one (Liang and Barsky).
bool clip(Point a, Point b, double& from, double& to) {
  from = 0;
  to = 1;
  for (const auto& [start, way] : {std::pair{a.x, b.x - a.x}, std::pair{a.y, b.y - a.y}}) {
    if (way == 0) {
      if (start < 0 || start > 1) return false;
      continue;
    }
    const double enters = (way > 0 ? -start : 1 - start) / way;
    const double leaves = (way > 0 ? 1 - start : -start) / way;
    from = std::max(from, enters);
    to = std::min(to, leaves);
  }
  return from < to || (from == to && a.x == b.x && a.y == b.y);
}

double off_chord(Point a, Point b, Point p) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double length = dx * dx + dy * dy;
  const double t = length == 0 ? 0 : std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length, 0.0, 1.0);
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

}  // namespace

Point between(Point a, Point b, double share) { return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)}; }

Point on_paper(const Panel& panel, Point point) { return {share(panel.x, point.x), share(panel.y, point.y)}; }

Point from_paper(const Panel& panel, Point place) { return {value(panel.x, place.x), value(panel.y, place.y)}; }

double paper_distance(const Panel& panel, Point a, Point b) {
  const Point first = on_paper(panel, a), second = on_paper(panel, b);
  return std::hypot(first.x - second.x, first.y - second.y);
}

std::vector<Polyline> clipped(const Panel& panel, const Polyline& line) {
  std::vector<Polyline> parts;
  bool open = false;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point a = on_paper(panel, line[i - 1]), b = on_paper(panel, line[i]);
    double from = 0, to = 1;
    const bool finite = std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(b.x) && std::isfinite(b.y);
    if (!finite || !clip(a, b, from, to)) {
      open = false;
      continue;
    }
    // The ends of the line itself as they are; the others on the border.
    const auto at = [&](double t) { return from_paper(panel, between(a, b, t)); };
    if (!open) parts.push_back({from == 0 ? line[i - 1] : at(from)});
    parts.back().push_back(to == 1 ? line[i] : at(to));
    open = to == 1;
  }
  return parts;
}

Polyline thinned(const Panel& panel, const Polyline& line, double tolerance) {
  if (line.size() < 3) return line;
  std::vector<Point> places;
  for (const Point& point : line) places.push_back(on_paper(panel, point));
  // Douglas and Peucker.
  std::vector<bool> kept(line.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, line.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    double max_off = tolerance;
    std::size_t middle = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double off = off_chord(places[first], places[last], places[i]);
      // Of equal ones the first, whatever the last digits.
      constexpr double same = 1e-9;
      if (off > max_off * (1 + same)) {
        max_off = off;
        middle = i;
      }
    }
    if (middle == first) continue;
    kept[middle] = true;
    open.push_back({first, middle});
    open.push_back({middle, last});
  }
  Polyline result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (kept[i]) result.push_back(line[i]);
  }
  return result;
}

std::vector<Polyline> visible(const Panel& panel, const std::vector<Polyline>& lines) {
  std::vector<Polyline> result;
  for (const Polyline& line : lines) {
    for (const Polyline& part : clipped(panel, line)) result.push_back(thinned(panel, part));
  }
  return result;
}

double paper_length(const Panel& panel, const Polyline& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += paper_distance(panel, line[i - 1], line[i]);
  return length;
}

Arrow arrow_along(const Panel& panel, const Polyline& line, double share) {
  double to_go = share * paper_length(panel, line);
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double piece = paper_distance(panel, line[i - 1], line[i]);
    if (piece > 0 && to_go <= piece) {
      const Point at = between(on_paper(panel, line[i - 1]), on_paper(panel, line[i]), to_go / piece);
      return {from_paper(panel, at), {line[i].x - line[i - 1].x, line[i].y - line[i - 1].y}};
    }
    to_go -= piece;
  }
  return {line.back(), {0, 0}};
}

std::optional<Arrow> short_arrow(const Panel& panel, const Box& box, const Arrow& arrow) {
  constexpr double length_mm = 0.5;
  const Point at = on_paper(panel, arrow.at);
  // On a logarithmic axis a direction is that of a small step.
  const auto step = [](const Axis& axis, double from, double change) {
    return axis.logarithmic ? change / from / std::log(axis.high / axis.low) : change / (axis.high - axis.low);
  };
  const double x = step(panel.x, arrow.at.x, arrow.direction.x) * box.width;
  const double y = step(panel.y, arrow.at.y, arrow.direction.y) * box.height;
  const double size = std::hypot(x, y);
  if (!(size > 0)) return std::nullopt;
  const Point start{at.x - x / size * length_mm / box.width, at.y - y / size * length_mm / box.height};
  return Arrow{from_paper(panel, start), arrow.direction};
}

std::vector<LegendEntry> legend_entries(const Figure& figure) {
  std::vector<LegendEntry> entries;
  const auto add = [&](const std::string& text, const Lines* lines, const Marks* marks) {
    if (text.empty() || std::ranges::find(entries, text, &LegendEntry::text) != entries.end()) return;
    entries.push_back({text, lines, marks});
  };
  for (const Panel& panel : figure.panels) {
    for (const Lines& lines : panel.lines) add(lines.legend, &lines, nullptr);
    for (const Marks& marks : panel.marks) add(marks.legend, nullptr, &marks);
  }
  return entries;
}

Layout lay_out(const Figure& figure) {
  constexpr double letter_mm = 2.9;
  Layout layout{};
  const double em = layout.letter = letter_mm * figure.theme.letters;
  double top = figure.height_mm - 1.2 * em;
  const auto line = [&](const std::string& text, double height) {
    const double middle = top - height / 2;
    if (!text.empty()) top -= height;
    return middle;
  };
  layout.title = line(figure.title, 2.1 * em);
  layout.subtitle = line(figure.subtitle, 1.8 * em);
  const bool names = std::ranges::any_of(figure.panels, [](const Panel& panel) { return !panel.title.empty(); });
  top -= (names ? 2.2 : 0.6) * em;

  const bool legend = !legend_entries(figure).empty();
  const bool axes = !std::ranges::all_of(figure.panels, &Panel::bare);
  layout.legend = 1.5 * em;
  const double bottom = (legend ? 3.6 : 1) * em + (axes ? 3.9 : 0.5) * em;

  const double bar_room = figure.colour_bar ? 8 * em : 0;
  const double strip = (figure.width_mm - bar_room) / static_cast<double>(figure.panels.size());
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const Panel& panel = figure.panels[i];
    const double before = (!panel.bare ? 6.2 : 1.5) * em;
    const double after = (panel.colours ? 8 : 1.5) * em;
    Box box{strip * static_cast<double>(i) + before, bottom, strip - before - after, top - bottom};
    if (panel.to_scale) {
      const double unit = std::min(box.width / (panel.x.high - panel.x.low), box.height / (panel.y.high - panel.y.low));
      const double width = unit * (panel.x.high - panel.x.low), height = unit * (panel.y.high - panel.y.low);
      box = {box.left + (box.width - width) / 2, box.bottom + (box.height - height) / 2, width, height};
    }
    layout.panels.push_back(box);
    layout.names.push_back(box.bottom + box.height + 1.1 * em);
  }
  if (figure.colour_bar) {
    const double height = 0.72 * (top - bottom);
    const Box bar =
        layout.colour_bar = {figure.width_mm - bar_room + 1.2 * em, bottom + 0.08 * (top - bottom), 1.1 * em, height};
    const std::size_t count = figure.colour_bar->colours.size();
    const double step = height / static_cast<double>(count);
    constexpr double overlap = 0.1;  // so that there is no seam between them
    for (std::size_t i = 0; i < count; ++i) {
      const double from = step * static_cast<double>(i);
      layout.colours.push_back({bar.left, bar.bottom + from, bar.width, std::min(step + overlap, height - from)});
    }
  }
  return layout;
}

}  // namespace contensou::portraits
