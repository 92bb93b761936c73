#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/layout.hpp"

namespace contensou::portraits {

/// Returns the name of a side of a label: left, center or right.
inline const char* name(Label::Align side) {
  constexpr const char* names[]{"left", "center", "right"};
  return names[static_cast<int>(side)];
}

/// Returns a figure as an object of another language. Colours are strings such as "#0072b2".
///
/// @param to  writer of that language with the functions `object` (keys and values in turn), `list` (a range, and a
///            function of its entries), `text`, `tick` (place and text), `points` (of a Polyline), `lines` (of a
///            panel), and `optional` (as `list`, for an std::optional)
template <class Writer>
auto members_of(const Figure& figure, const Writer& to) {
  const auto colour = [](Colour of) { return fmt::format("#{:06x}", of.rgb); };
  const auto ticks = [&](const std::vector<Axis::Tick>& all) {
    return to.list(all, [&](const Axis::Tick& each) { return to.tick(each.at, each.text); });
  };
  const auto axis = [&](const Axis& of) {
    return to.object("name", to.text(of.name), "low", of.low, "high", of.high, "ticks", ticks(of.ticks));
  };
  const auto region = [&](const Region& of) {
    return to.object("border", to.points(of.border), "colour", colour(of.colour));
  };
  const auto arrows = [&](const Arrows& of) {
    Polyline ends;
    for (const auto& [at, direction] : of.arrows) ends.insert(ends.end(), {at, direction});
    return to.object("arrows", to.points(ends), "colour", colour(of.colour));
  };
  const auto marks = [&](const Marks& of) {
    constexpr const char* shapes[]{"dot", "circle", "square", "diamond"};
    return to.object("points", to.points(of.points), "colour", colour(of.colour), "size", of.size, "shape",
                     shapes[static_cast<int>(of.shape)], "legend", to.text(of.legend));
  };
  const auto label = [&](const Label& of) {
    return to.object("x", of.at.x, "y", of.at.y, "text", to.text(of.text), "colour", colour(of.colour), "align",
                     name(of.align));
  };
  const auto panel = [&](const Panel& of) {
    const auto lines = [&](const Lines& layer) {
      const auto& [look, width, dashed, dotted] = layer.stroke;
      return to.object("lines", to.lines(of, layer.lines), "colour", colour(look), "width", width, "dashed", dashed,
                       "dotted", dotted, "legend", to.text(layer.legend));
    };
    return to.object("title", to.text(of.title), "x", axis(of.x), "y", axis(of.y), "bare", of.bare, "to_scale",
                     of.to_scale, "regions", to.list(of.regions, region), "lines", to.list(of.lines, lines), "arrows",
                     to.list(of.arrows, arrows), "marks", to.list(of.marks, marks), "labels",
                     to.list(of.labels, label));
  };
  const auto bar = [&](const ColourBar& of) {
    return to.object("name", to.text(of.name), "colours", to.list(of.colours, colour), "ticks", ticks(of.ticks));
  };
  const PaperSize& size = figure.size;
  const Theme& theme = figure.theme;
  return to.object("title", to.text(figure.title), "subtitle", to.text(figure.subtitle), "width_mm", size.width_mm,
                   "height_mm", size.height_mm, "letter_pt", letter_mm(size.width_mm) * theme.letters * 72 / 25.4,
                   "ground", colour(theme.ground), "ink", colour(theme.ink), "faint", colour(theme.faint), "line",
                   theme.line, "columns", figure.max_columns, "panels", to.list(figure.panels, panel), "colour_bar",
                   to.optional(figure.colour_bar, bar));
}

}  // namespace contensou::portraits
