#include "javascript.hpp"

#include <fmt/format.h>

namespace contensou::page {

namespace {

using emscripten::val;
using portraits::Axis;
using portraits::Colour;
using portraits::Panel;
using portraits::Point;

template <class Range, class Function>
val list(const Range& range, Function value) {
  val result = val::array();
  for (const auto& entry : range) result.call<void>("push", value(entry));
  return result;
}

val colour_value(Colour colour) { return val(fmt::format("#{:06x}", colour.rgb)); }

val points_value(const std::vector<Point>& points) {
  static_assert(sizeof(Point) == 2 * sizeof(double));
  return column(points.empty() ? nullptr : &points.front().x, 2 * points.size());
}

val ticks_value(const std::vector<Axis::Tick>& ticks) {
  return list(ticks, [](const Axis::Tick& tick) {
    val value = val::object();
    value.set("at", tick.at);
    value.set("text", tick.text);
    return value;
  });
}

val axis_value(const Axis& axis) {
  val value = val::object();
  value.set("name", axis.name);
  value.set("low", axis.low);
  value.set("high", axis.high);
  value.set("ticks", ticks_value(axis.ticks));
  return value;
}

val lines_value(const portraits::Lines& layer) {
  val value = val::object();
  value.set("lines", list(layer.lines, points_value));
  value.set("colour", colour_value(layer.stroke.colour));
  value.set("width", layer.stroke.width);
  value.set("dashed", layer.stroke.dashed);
  value.set("legend", layer.legend);
  return value;
}

val arrows_value(const portraits::Arrows& layer) {
  std::vector<double> numbers;
  for (const auto& [at, direction] : layer.arrows)
    numbers.insert(numbers.end(), {at.x, at.y, direction.x, direction.y});
  val value = val::object();
  value.set("arrows", column(numbers));
  value.set("colour", colour_value(layer.colour));
  return value;
}

val marks_value(const portraits::Marks& layer) {
  constexpr const char* shapes[] = {"dot", "circle", "square"};
  val value = val::object();
  value.set("points", points_value(layer.points));
  value.set("colour", colour_value(layer.colour));
  value.set("size", layer.size);
  value.set("shape", std::string(shapes[static_cast<int>(layer.shape)]));
  value.set("legend", layer.legend);
  return value;
}

val label_value(const portraits::Label& label) {
  constexpr const char* alignments[] = {"left", "center", "right"};
  val value = val::object();
  value.set("x", label.at.x);
  value.set("y", label.at.y);
  value.set("text", label.text);
  value.set("colour", colour_value(label.colour));
  value.set("align", std::string(alignments[static_cast<int>(label.align)]));
  return value;
}

val panel_value(const Panel& panel) {
  val value = val::object();
  value.set("title", panel.title);
  value.set("x", axis_value(panel.x));
  value.set("y", axis_value(panel.y));
  value.set("lines", list(panel.lines, lines_value));
  value.set("arrows", list(panel.arrows, arrows_value));
  value.set("marks", list(panel.marks, marks_value));
  value.set("labels", list(panel.labels, label_value));
  value.set("regions", list(panel.regions, [](const portraits::Region& region) {
              val area = val::object();
              area.set("border", points_value(region.border));
              area.set("colour", colour_value(region.colour));
              return area;
            }));
  value.set("bare", panel.bare);
  value.set("toScale", panel.to_scale);
  return value;
}

}  // namespace

val column(const double* data, std::size_t size) {
  return val(emscripten::typed_memory_view(size, data)).call<val>("slice");
}

val column(const Eigen::ArrayXd& values) { return column(values.data(), static_cast<std::size_t>(values.size())); }

val column(const std::vector<double>& values) { return column(values.data(), values.size()); }

val orbit_value(const portraits::PortraitOrbit& orbit) {
  val value = val::object();
  value.set("u", column(orbit.u));
  value.set("v", column(orbit.v));
  value.set("lnV", column(orbit.ln_v));
  value.set("lnK", column(orbit.ln_k));
  value.set("left", column(orbit.tau_left));
  return value;
}

val figure_value(const portraits::Figure& figure) {
  val value = val::object();
  value.set("title", figure.title);
  value.set("panels", list(figure.panels, panel_value));
  value.set("ground", colour_value(figure.theme.ground));
  value.set("ink", colour_value(figure.theme.ink));
  value.set("faint", colour_value(figure.theme.faint));
  value.set("line", figure.theme.line);
  if (figure.colour_bar) {
    val bar = val::object();
    bar.set("name", figure.colour_bar->name);
    bar.set("colours", list(figure.colour_bar->colours, colour_value));
    bar.set("ticks", ticks_value(figure.colour_bar->ticks));
    value.set("colourBar", bar);
  }
  return value;
}

}  // namespace contensou::page
