#include "contensou/portraits/layout.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "data/round_numbers.hpp"

namespace contensou::portraits {

namespace {

double fraction(const Axis& axis, double value) {
  if (axis.logarithmic) return std::log(value / axis.low) / std::log(axis.high / axis.low);
  return (value - axis.low) / (axis.high - axis.low);
}

double value(const Axis& axis, double fraction) {
  if (axis.logarithmic) return axis.low * std::pow(axis.high / axis.low, fraction);
  return axis.low + fraction * (axis.high - axis.low);
}

/// Finds the part [from, to] of the way from a to b in the unit square, by Liang and Barsky; false if there is none.
bool clip(Point a, Point b, double& from, double& to) {
  from = 0;
  to = 1;
  if (std::max(a.x, b.x) < 0 || std::min(a.x, b.x) > 1 || std::max(a.y, b.y) < 0 || std::min(a.y, b.y) > 1)
    return false;
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

/// Returns the distance of two places on paper. std::hypot is slower: it avoids overflow, which cannot occur here.
double distance(Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  return std::sqrt(dx * dx + dy * dy);
}

double off_chord(Point a, Point b, Point p) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double length = dx * dx + dy * dy;
  const double t = length == 0 ? 0 : std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length, 0.0, 1.0);
  return distance(p, {a.x + t * dx, a.y + t * dy});
}

}  // namespace

double letter_mm(double width_mm) { return std::clamp(2.0 + 0.0041 * width_mm, 2.2, 2.7); }

Point between(Point a, Point b, double fraction) {
  return {a.x + fraction * (b.x - a.x), a.y + fraction * (b.y - a.y)};
}

Point on_paper(const Panel& panel, Point point) { return {fraction(panel.x, point.x), fraction(panel.y, point.y)}; }

Point from_paper(const Panel& panel, Point place) { return {value(panel.x, place.x), value(panel.y, place.y)}; }

double paper_distance(const Panel& panel, Point a, Point b) { return distance(on_paper(panel, a), on_paper(panel, b)); }

std::vector<Polyline> clipped(const Panel& panel, const Polyline& line) {
  std::vector<Polyline> parts;
  bool open = false;
  Point a{}, b = line.empty() ? a : on_paper(panel, line.front());
  for (std::size_t i = 1; i < line.size(); ++i) {
    a = std::exchange(b, on_paper(panel, line[i]));
    double from = 0, to = 1;
    const bool finite = std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(b.x) && std::isfinite(b.y);
    if (!finite || !clip(a, b, from, to)) {
      open = false;
      continue;
    }
    // Keep the ends of the line exactly; compute the other ends, which lie on the border.
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
      // Among distances that are equal up to rounding take the first.
      constexpr double same = 1e-9;
      if (off > max_off * (1 + same)) {
        max_off = off;
        middle = i;
      }
    }
    if (middle == first) continue;
    kept[middle] = true;
    open.emplace_back(first, middle);
    open.emplace_back(middle, last);
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

Arrow arrow_along(const Panel& panel, const Polyline& line, double fraction) {
  double to_go = fraction * paper_length(panel, line);
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
  // On a logarithmic axis the direction is the derivative of the logarithm.
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
  const auto entry = [&](const Text& text) -> LegendEntry& {
    const auto found = std::ranges::find(entries, text, &LegendEntry::text);
    return found != entries.end() ? *found : entries.emplace_back(LegendEntry{text, nullptr, nullptr});
  };
  for (const Panel& panel : figure.panels) {
    for (const Lines& lines : panel.lines) {
      if (!lines.legend.empty() && !entry(lines.legend).lines) entry(lines.legend).lines = &lines;
    }
    for (const Marks& marks : panel.marks) {
      if (!marks.legend.empty() && !entry(marks.legend).marks) entry(marks.legend).marks = &marks;
    }
  }
  return entries;
}

int panel_columns(double width_mm, int panels) {
  constexpr double narrowest = 50;
  int columns = panels;
  while (columns > 1 && (panels % columns != 0 || width_mm / columns < narrowest)) --columns;
  return columns;
}

PaperSize fitted(const PaperSize& usual, int panels, const AskedSize& asked, int max_columns) {
  const double width = asked.width_mm.value_or(usual.width_mm);
  if (asked.height_mm || !asked.width_mm) return {width, asked.height_mm.value_or(usual.height_mm)};
  constexpr double around = 25, highest = 0.62;
  const int columns = std::min(panel_columns(width, panels), max_columns), rows = panels / columns;
  const double shape = std::min(highest, (usual.height_mm - around) / (usual.width_mm / panels));
  return {width, shape * width / columns * rows + around * letter_mm(width) / letter_mm(170)};
}

Point panel_size(const PaperSize& figure, int panels) {
  const double letter = letter_mm(figure.width_mm);
  const int columns = panel_columns(figure.width_mm, panels), rows = panels / columns;
  return {std::max(figure.width_mm / columns - 9 * letter, 10.0),
          std::max((figure.height_mm - 7 * letter) / rows - 6 * letter, 10.0)};
}

namespace {

/// Returns as few rows as fill(limit) gives, but about equally long ones, so that nothing stands alone in the last row.
template <class Fill>
auto balanced(const Fill& fill, double limit) {
  auto rows = fill(limit);
  while (rows.size() > 1 && (limit -= 0.5) > 1) {
    auto narrower = fill(limit);
    if (narrower.size() > rows.size()) break;
    rows = std::move(narrower);
  }
  return rows;
}

/// Breaks a text into balanced lines whose width is at most a limit, in letter sizes.
std::vector<Text> broken(const Text& text, double width) {
  std::vector<Text> words(1);
  for (const Run& run : text.runs()) {
    for (std::size_t begin = 0; begin <= run.words.size();) {
      std::size_t end = std::min(run.words.find(' ', begin), run.words.size());
      // Several spaces in a row are one place for a break.
      while (end + 1 < run.words.size() && run.words[end + 1] == ' ') ++end;
      words.back() += Text(Run{run.words.substr(begin, end - begin), run.italic, run.level});
      if (end < run.words.size()) words.emplace_back();
      begin = end + 1;
    }
  }
  const auto fill = [&words](double limit) {
    std::vector<Text> filled;
    for (const Text& word : words) {
      const Text longer = filled.empty() ? word : filled.back() + " " + word;
      if (!filled.empty() && text_width(longer) <= limit)
        filled.back() = longer;
      else
        filled.push_back(word);
    }
    return filled;
  };
  return text.empty() ? std::vector<Text>{} : balanced(fill, width);
}

/// Height of a line of text. This and the following lengths are in letter sizes.
constexpr double line_height = 1.45;

/// Returns the ticks of an axis of a given length: as many as leave room between their texts.
std::vector<Axis::Tick> ticks(const Axis& axis, double length, bool upright) {
  const auto room = [&](const Text& text) { return upright ? 1.5 : tick_size * text_width(text) + 1.2; };
  std::vector<Axis::Tick> all = axis.ticks;
  if (all.empty() && axis.logarithmic) {
    constexpr double few_decades = 2.5, same = 1e-9;
    const std::vector<double> round = round_ratios(axis.low * (1 - same), axis.high * (1 + same), few_decades);
    const bool are_powers = axis.high / axis.low >= std::pow(10, few_decades);
    std::vector<Text> names = are_powers ? powers_of_ten(round) : std::vector<Text>{};
    for (std::size_t i = 0; i < round.size(); ++i) all.push_back({round[i], are_powers ? names[i] : number(round[i])});
  } else if (all.empty()) {
    const double range = axis.high - axis.low;
    const double end = std::max(std::abs(axis.low), std::abs(axis.high));
    for (double pieces = std::max(2.0, length / (upright ? 3 : 5));; pieces *= 0.75) {
      all.clear();
      const double step = round_step(range, pieces);
      // The texts of two neighbouring ticks must differ.
      const int digits = std::clamp(static_cast<int>(std::ceil(std::log10(end / step))) + 1, 5, 15);
      for (double at : multiples(axis.low - 1e-6 * step, axis.high + 1e-6 * step, step)) {
        all.push_back({at, number(std::abs(at) < 1e-9 * step ? 0 : at, digits)});
      }
      double widest = 0;
      for (const Axis::Tick& tick : all) widest = std::max(widest, room(tick.text));
      if (all.size() <= 2 || widest <= length * step / range) return all;
    }
  }
  // Drop each tick whose text overlaps the text of the previous tick.
  std::vector<Axis::Tick> kept;
  double free = -1e300;
  for (const Axis::Tick& tick : all) {
    const double at = length * fraction(axis, tick.at), half = room(tick.text) / 2;
    if (at - half < free) continue;
    free = at + half;
    kept.push_back(tick);
  }
  return kept;
}

double widest(const std::vector<Axis::Tick>& ticks) {
  double width = 0;
  for (const Axis::Tick& tick : ticks) width = std::max(width, tick_size * text_width(tick.text));
  return width;
}

/// Places the parts of a figure. Lengths are in letter sizes.
class Compositor {
 public:
  explicit Compositor(const Figure& figure)
      : figure_(figure),
        em_(letter_mm(figure.size.width_mm) * figure.theme.letters),
        width_(figure.size.width_mm / em_),
        top_(figure.size.height_mm / em_ - 0.7) {
    layout_.letter = em_;
    heading(figure.title, 1.2, false);
    heading(figure.subtitle, 1, true);
    legend();
    const double bar = figure.colour_bar ? bar_room(*figure.colour_bar) : 0;
    panels(width_ - bar);
    if (figure.colour_bar) colour_bar(*figure.colour_bar, bar);
  }

  Layout layout() && { return std::move(layout_); }

 private:
  Box mm(double left, double bottom, double width, double height) const {
    return {left * em_, bottom * em_, width * em_, height * em_};
  }

  void text(const Text& text, double x, double y, double size = 1, Label::Align align = Label::Align::centre,
            bool faint = false, bool turned = false) {
    if (!text.empty()) layout_.texts.push_back({text, {x * em_, y * em_}, size, align, faint, turned});
  }

  void heading(const Text& all, double size, bool faint) {
    for (const Text& line : broken(all, (width_ - 1.5) / size)) {
      text(line, width_ / 2, top_ - 0.5 * line_height * size, size, Label::Align::centre, faint);
      top_ -= line_height * size;
    }
  }

  void legend() {
    constexpr double sample = 2.4, gap = 0.5, between = 1.6;
    struct Row {
      std::vector<LegendEntry> entries;
      double width = -between;
    };
    const auto length = [&](const LegendEntry& entry) { return sample + gap + text_width(entry.text) + between; };
    const auto fill = [&, entries = legend_entries(figure_)](double limit) {
      std::vector<Row> filled;
      for (const LegendEntry& entry : entries) {
        if (filled.empty() || filled.back().width + length(entry) > limit) filled.emplace_back();
        filled.back().width += length(entry);
        filled.back().entries.push_back(entry);
      }
      return filled;
    };
    const std::vector<Row> rows = balanced(fill, width_ - 1.5);
    bottom_ = 0.5 + line_height * static_cast<double>(rows.size()) + (rows.empty() ? 0 : 0.3);
    double y = bottom_ - 0.3 + line_height / 2;
    for (const Row& row : rows) {
      double x = (width_ - row.width) / 2;
      y -= line_height;
      for (const LegendEntry& entry : row.entries) {
        layout_.legend.push_back({entry, {x * em_, y * em_}, sample * em_});
        text(entry.text, x + sample + gap, y, 1, Label::Align::left);
        x += length(entry);
      }
    }
  }

  void panels(double width) {
    const int count = static_cast<int>(figure_.panels.size());
    const int columns = std::min(panel_columns(width * em_, count), figure_.max_columns), rows = count / columns;
    const double strip = width / columns;
    // Heights come first, because the ticks of y axes follow from heights, and the margins from these ticks.
    double above = 0.5, below = 0.5;
    constexpr double high = 14;  // a row with room keeps its titles off the names of the row above
    const double apart = rows > 1 && (top_ - bottom_) / rows > high ? 1.1 : 0.7;
    for (const Panel& panel : figure_.panels) {
      above = std::max(above, apart + line_height * static_cast<double>(broken(panel.title, strip - 1).size()));
      if (!panel.bare) below = std::max(below, panel.x.name.empty() ? 2.4 : 3.8);
    }
    const double height = (top_ - bottom_) / rows - above - below;
    layout_.panels.resize(figure_.panels.size());
    for (int column = 0; column < columns; ++column) {
      double before = 1, after = 1;
      for (int i = column; i < count; i += columns) {
        const Panel& panel = figure_.panels[i];
        PanelPlace& place = layout_.panels[i];
        if (panel.bare) continue;
        place.y = ticks(panel.y, height, true);
        const double names = line_height * static_cast<double>(broken(panel.y.name, height + 2).size());
        before = std::max(before, 0.4 + names + widest(place.y) + 1.5);
        const std::vector<Axis::Tick> under = ticks(panel.x, strip - before, false);
        if (!under.empty() && panel.x.high > panel.x.low) {
          const Axis::Tick& last = under.back();
          const double beyond =
              tick_size * text_width(last.text) / 2 - (1 - fraction(panel.x, last.at)) * (strip - before);
          after = std::max(after, beyond + 0.5);
        }
        if (panel.colours) {
          place.scale = ticks(panel.colours->scale, height, true);
          after = std::max(after, 3.4 + widest(place.scale));
        }
      }
      for (int i = column; i < count; i += columns) {
        const int row = i / columns;
        const double row_top = top_ - (top_ - bottom_) * row / rows - above;
        panel(i, {strip * column + before, row_top - height, strip - before - after, height}, strip * column, strip);
      }
    }
  }

  /// Places a panel.
  /// @param box   rectangle between its axes
  /// @param left  left edge of the panel's strip
  void panel(int i, Box box, double left, double strip) {
    const Panel& panel = figure_.panels[i];
    PanelPlace& place = layout_.panels[i];
    constexpr double least_width = 9, least_height = 5;
    if (!(box.width >= least_width && box.height >= least_height)) {
      throw std::domain_error(
          fmt::format("a figure of {:.4g} x {:.4g} mm leaves {:.3g} x {:.3g} mm for a panel, "
                      "which needs {:.3g} x {:.3g} mm: make it larger, or leave out its title",
                      figure_.size.width_mm, figure_.size.height_mm, std::max(0.0, box.width * em_),
                      std::max(0.0, box.height * em_), least_width * em_, least_height * em_));
    }
    if (panel.to_scale) {
      const double unit = std::min(box.width / (panel.x.high - panel.x.low), box.height / (panel.y.high - panel.y.low));
      const double width = unit * (panel.x.high - panel.x.low), height = unit * (panel.y.high - panel.y.low);
      box = {box.left + (box.width - width) / 2, box.bottom + (box.height - height) / 2, width, height};
    }
    place.box = mm(box.left, box.bottom, box.width, box.height);
    const double middle = box.left + box.width / 2;
    const std::vector<Text> title = broken(panel.title, strip - 1);
    double y = box.bottom + box.height + 0.5 + line_height * (static_cast<double>(title.size()) - 0.5);
    for (const Text& line : title) {
      // Keep the title inside the strip.
      const double half = text_width(line) / 2;
      text(line, std::clamp(middle, left + half, std::max(left + half, left + strip - half)), y);
      y -= line_height;
    }
    if (panel.bare) return;
    place.x = ticks(panel.x, box.width, false);
    text(panel.x.name, middle, box.bottom - 3);
    const std::vector<Text> name = broken(panel.y.name, box.height + 2);
    double x = box.left - 1.5 - widest(place.y) - line_height * (static_cast<double>(name.size()) - 0.5);
    for (const Text& line : name) {
      text(line, x, box.bottom + box.height / 2, 1, Label::Align::centre, false, true);
      x += line_height;
    }
    if (!panel.colours) return;
    place.colour_scale = mm(box.left + box.width + 0.9, box.bottom, 1.2, box.height);
    text(panel.colours->scale.name, box.left + box.width + 1.5, box.bottom + box.height + 1);
  }

  double bar_room(const ColourBar& bar) const { return std::max(4.2, 3.3 + widest(bar.ticks)); }

  void colour_bar(const ColourBar& bar, double room) {
    const double bottom = layout_.panels.back().box.bottom / em_;
    const Box& first = layout_.panels.front().box;
    const double total = (first.bottom + first.height) / em_ - bottom;
    // The bar stands next to the panels. Panels to scale may be narrower than their room.
    double left = 0;
    constexpr double gap = 1.6;
    for (const PanelPlace& place : layout_.panels)
      left = std::max(left, (place.box.left + place.box.width) / em_ + gap);
    left = std::min(left, width_ - room + 0.8);
    const std::vector<Text> name = broken(bar.name, room - 0.8);
    const double height = std::min(0.75 * total, top_ - bottom - line_height * static_cast<double>(name.size()) - 0.6);
    double y = bottom + height + 0.6 + line_height * (static_cast<double>(name.size()) - 0.5);
    for (const Text& line : name) {
      text(line, left, y, 1, Label::Align::left);
      y -= line_height;
    }
    const auto count = static_cast<double>(bar.colours.size());
    constexpr double overlap = 0.04;  // boxes overlap by this length, so that no seam is visible
    for (double i = 0; i < count; ++i) {
      const double from = height * i / count;
      layout_.colours.push_back(mm(left, bottom + from, 1, std::min(height / count + overlap, height - from)));
    }
    for (const Axis::Tick& tick : ticks({"", 0, 1, false, bar.ticks}, height, true)) {
      text(tick.text, left + 1.4, bottom + tick.at * height, tick_size, Label::Align::left);
    }
  }

  const Figure& figure_;
  double em_, width_, top_, bottom_ = 0;
  Layout layout_{};
};

}  // namespace

Layout lay_out(const Figure& figure) { return Compositor(figure).layout(); }

Figure trimmed(Figure figure) {
  if (figure.panels.size() != 1 || !figure.panels.front().to_scale) return figure;
  const double used = lay_out(figure).panels.front().box.height;
  Figure free = figure;
  free.panels.front().to_scale = false;
  figure.size.height_mm -= lay_out(free).panels.front().box.height - used;
  return figure;
}

void widen(Figure& figure, std::size_t panel, double times) {
  // Compute the layout twice, because other numbers at the ticks change the width.
  for (int i = 0; i < 2; ++i) {
    const Box box = lay_out(figure).panels[panel].box;
    Axis &x = figure.panels[panel].x, &y = figure.panels[panel].y;
    const double x_unit = box.width / (x.high - x.low), y_unit = box.height / (y.high - y.low);
    const double factor = y_unit / (x_unit * times);
    Axis& axis = factor > 1 ? y : x;
    const double more = (std::max(factor, 1 / factor) - 1) / 2 * (axis.high - axis.low);
    axis.low -= more;
    axis.high += more;
  }
}

}  // namespace contensou::portraits
