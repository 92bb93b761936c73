#include "page/javascript.hpp"

#include <algorithm>
#include <limits>

#include "contensou/portraits/figure_members.hpp"
#include "contensou/portraits/layout.hpp"

namespace contensou::page {

namespace {

using portraits::Axis;
using portraits::Colour;
using portraits::Panel;
using portraits::Polyline;

val ticks_value(const std::vector<Axis::Tick>& ticks) {
  return list(ticks, [](const Axis::Tick& tick) { return object("at", tick.at, "text", tick.text); });
}

/// Writer of a figure (portraits::members_of) for JavaScript. Columns are Float64Array, texts objects for each run.
struct ToJavaScript {
  static val text(const portraits::Text& text) { return text_value(text); }
  static val tick(double at, const portraits::Text& text) { return object("at", at, "text", text); }
  static val points(const Polyline& points) { return column(std::vector<Polyline>{points}); }
  static val lines(const Panel& panel, const std::vector<Polyline>& lines) {
    return column(portraits::visible(panel, lines));
  }
  static val list(const auto& range, const auto& value) { return page::list(range, value); }
  static val optional(const auto& value, const auto& function) { return value ? function(*value) : val::undefined(); }
  static val object(const auto&... keys_and_values) { return page::object(keys_and_values...); }
};

portraits::Text text_of(const val& text) {
  if (text.isString()) return text.as<std::string>();
  portraits::Text all;
  for (const val& run : emscripten::vecFromJSArray<val>(text)) {
    all += run.isString() ? portraits::Text(run.as<std::string>())
                          : portraits::Text(portraits::Run{run["words"].as<std::string>(), run["italic"].as<bool>(),
                                                           run["level"].as<int>()});
  }
  return all;
}

std::vector<Axis::Tick> ticks_of(const val& ticks) {
  std::vector<Axis::Tick> all;
  for (const val& tick : emscripten::vecFromJSArray<val>(ticks)) {
    all.push_back({tick["at"].as<double>(), text_of(tick["text"])});
  }
  return all;
}

Axis axis_of(const val& axis) {
  return {text_of(axis["name"]), axis["low"].as<double>(), axis["high"].as<double>(), false, ticks_of(axis["ticks"])};
}

/// Returns the parts of a figure that determine the layout.
portraits::Figure outline_of(const val& figure) {
  portraits::Figure outline{.title = {}, .subtitle = text_of(figure["title"]), .panels = {}};
  outline.max_columns = figure["columns"].as<int>();
  for (const val& panel : emscripten::vecFromJSArray<val>(figure["panels"])) {
    outline.panels.push_back({.title = text_of(panel["title"]), .x = axis_of(panel["x"]), .y = axis_of(panel["y"])});
    outline.panels.back().bare = panel["bare"].as<bool>();
    outline.panels.back().to_scale = panel["to_scale"].as<bool>();
    for (const char* layers : {"lines", "marks"}) {
      for (const val& layer : emscripten::vecFromJSArray<val>(panel[layers])) {
        outline.panels.back().lines.push_back({.lines = {}, .stroke = {}, .legend = text_of(layer["legend"])});
      }
    }
  }
  if (const val bar = figure["colour_bar"]; !bar.isUndefined()) {
    const auto count = bar["colours"]["length"].as<std::size_t>();
    outline.colour_bar = {text_of(bar["name"]), std::vector<Colour>(count), ticks_of(bar["ticks"])};
  }
  return outline;
}

/// Returns mm per pixel. The narrowest panel of the library is 50 mm wide.
double scale_of(const val& figure) { return 50 / figure["narrowest"].as<double>(); }

constexpr double narrowest = 230;  // width of the narrowest panel, pixels

}  // namespace

int rows_of(const val& figure, double width) {
  const int panels = figure["panels"]["length"].as<int>();
  return panels / std::min(portraits::panel_columns(width * scale_of(figure), panels), figure["columns"].as<int>());
}

val layout_value(const val& figure, double width, double height, double letter) {
  const double scale = scale_of(figure);
  portraits::Figure outline = outline_of(figure);
  outline.size = {width * scale, height * scale};
  outline.theme.letters = letter * scale / portraits::letter_mm(outline.size.width_mm);
  const portraits::Layout layout = portraits::lay_out(outline);
  const auto down = [&](double y) { return height - y / scale; };
  const auto box = [&](const portraits::Box& of) {
    return object("left", of.left / scale, "top", down(of.bottom + of.height), "width", of.width / scale, "height",
                  of.height / scale);
  };
  const auto text = [&](const portraits::PlacedText& of) {
    return object("x", of.at.x / scale, "y", down(of.at.y), "text", of.text, "size", of.size * letter, "align",
                  name(of.align), "turned", of.turned, "bold", of.faint);
  };
  const auto panel = [&](const portraits::PanelPlace& of) {
    return object("box", box(of.box), "x", ticks_value(of.x), "y", ticks_value(of.y));
  };
  const auto sample = [&](const portraits::LegendPlace& of) {
    return object("legend", of.entry.text, "x", of.from.x / scale, "y", down(of.from.y), "width", of.width / scale);
  };
  return object("texts", list(layout.texts, text), "panels", list(layout.panels, panel), "legend",
                list(layout.legend, sample), "colours", list(layout.colours, box));
}

val column(const std::vector<Polyline>& lines) {
  std::vector<double> numbers;
  constexpr double gap = std::numeric_limits<double>::quiet_NaN();
  for (const Polyline& line : lines) {
    if (!numbers.empty()) numbers.insert(numbers.end(), {gap, gap});
    for (const auto& [x, y] : line) numbers.insert(numbers.end(), {x, y});
  }
  return column(numbers);
}

val start_value(const si::Experiment& experiment) {
  const Eigen::Vector2d slip = si::slip_velocity_at_start(experiment);
  const Eigen::Vector2d velocity = si::velocities_of(experiment.start).velocity;
  const Eigen::Vector2d along = slip.norm() > 0 ? Eigen::Vector2d(slip.normalized()) : Eigen::Vector2d(1, 0);
  return object("slip", slip.norm(), "spin", si::spin_at_start(experiment), "along", velocity.dot(along), "across",
                along.x() * velocity.y() - along.y() * velocity.x());
}

val text_value(const portraits::Text& text) {
  return list(text.runs(), [](const portraits::Run& run) {
    return object("words", portraits::with_minus_signs(run.words), "italic", run.italic, "level", run.level);
  });
}

val figure_value(const portraits::Figure& figure) {
  val value = portraits::members_of(figure, ToJavaScript());
  value.set("narrowest", narrowest);
  return value;
}

}  // namespace contensou::page
