#include "javascript.hpp"

#include <limits>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"

namespace contensou::page {

namespace {

using portraits::Axis;
using portraits::Colour;
using portraits::Panel;
using portraits::Polyline;

std::string css(Colour colour) { return fmt::format("#{:06x}", colour.rgb); }

val ticks_value(const std::vector<Axis::Tick>& ticks) {
  return list(ticks, [](const Axis::Tick& tick) { return object("at", tick.at, "text", tick.text); });
}

val axis_value(const Axis& axis) {
  return object("name", axis.name, "low", axis.low, "high", axis.high, "ticks", ticks_value(axis.ticks));
}

val arrows_value(const portraits::Arrows& layer) {
  std::vector<double> numbers;
  for (const auto& [at, direction] : layer.arrows)
    numbers.insert(numbers.end(), {at.x, at.y, direction.x, direction.y});
  return object("arrows", numbers, "colour", css(layer.colour));
}

val marks_value(const portraits::Marks& layer) {
  constexpr const char* shapes[] = {"dot", "circle", "square"};
  return object("points", std::vector<Polyline>{layer.points}, "colour", css(layer.colour), "size", layer.size, "shape",
                shapes[static_cast<int>(layer.shape)], "legend", layer.legend);
}

val label_value(const portraits::Label& label) {
  constexpr const char* alignments[] = {"left", "center", "right"};
  return object("x", label.at.x, "y", label.at.y, "text", label.text, "colour", css(label.colour), "align",
                alignments[static_cast<int>(label.align)]);
}

val region_value(const portraits::Region& region) {
  return object("border", std::vector<Polyline>{region.border}, "colour", css(region.colour));
}

val panel_value(const Panel& panel) {
  const auto lines_value = [&](const portraits::Lines& layer) {
    return object("lines", portraits::visible(panel, layer.lines), "colour", css(layer.stroke.colour), "width",
                  layer.stroke.width, "dashed", layer.stroke.dashed, "legend", layer.legend);
  };
  return object("title", panel.title, "x", axis_value(panel.x), "y", axis_value(panel.y), "lines",
                list(panel.lines, lines_value), "arrows", list(panel.arrows, arrows_value), "marks",
                list(panel.marks, marks_value), "labels", list(panel.labels, label_value), "regions",
                list(panel.regions, region_value), "bare", panel.bare, "toScale", panel.to_scale);
}

}  // namespace

val column(const std::vector<Polyline>& lines) {
  std::vector<double> numbers;
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  for (const Polyline& line : lines) {
    if (!numbers.empty()) numbers.insert(numbers.end(), {gap, gap});
    for (const auto& [x, y] : line) numbers.insert(numbers.end(), {x, y});
  }
  return column(numbers);
}

val text_value(const portraits::Text& text) {
  return list(text.runs(), [](const portraits::Run& run) {
    return object("words", portraits::with_minus_signs(run.words), "italic", run.italic, "level", run.level);
  });
}

val figure_value(const portraits::Figure& figure) {
  val value = object("title", figure.title, "panels", list(figure.panels, panel_value), "ground",
                     css(figure.theme.ground), "ink", css(figure.theme.ink), "faint", css(figure.theme.faint), "line",
                     figure.theme.line, "columns", figure.max_columns);
  if (const auto& bar = figure.colour_bar) {
    const auto colour = [](Colour of) { return val(css(of)); };
    value.set("colourBar",
              object("name", bar->name, "colours", list(bar->colours, colour), "ticks", ticks_value(bar->ticks)));
  }
  return value;
}

}  // namespace contensou::page
