#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "contensou/portraits/text.hpp"

namespace contensou::portraits {

/// A point; its coordinates have the units of a panel's axes.
struct Point {
  double x;
  double y;
};

using Polyline = std::vector<Point>;

/// Red, green and blue, eight bits each: 0xrrggbb.
struct Colour {
  unsigned rgb = 0;
};

/// The look of a line. The unit of the width is line_width of layout.hpp, about half a point.
struct Stroke {
  Colour colour;
  double width = 1;
  bool dashed = false;
  bool dotted = false;  ///< true: dots; with dashed also true, dashes and dots alternate
};

/// Polylines with the same look and one entry in the legend.
struct Lines {
  std::vector<Polyline> lines;
  Stroke stroke;
  Text legend;  ///< if empty, the legend has no entry
};

/// An arrow head with its place and direction, both in the units of the axes.
struct Arrow {
  Point at;
  Point direction;
};

/// Arrow heads with the same look and the same size on paper.
struct Arrows {
  std::vector<Arrow> arrows;
  Colour colour;
  double size = 1;
};

/// Marks at points, with one entry in the legend. Circles and squares are outlines filled with the background colour.
struct Marks {
  std::vector<Point> points;
  Colour colour;
  double size = 0.6;
  enum class Shape { dot, circle, square, diamond } shape = Shape::dot;
  Text legend = {};  ///< if empty, the legend has no entry
};

/// A filled area below all other parts of a panel.
struct Region {
  Polyline border;
  Colour colour;
};

/// A text at a point of a panel. The background colour behind it keeps it legible over lines.
struct Label {
  Point at;
  Text text;
  Colour colour;
  enum class Align { left, centre, right } align = Align::centre;
};

/// An interval with its name. If `ticks` is empty, the layout chooses ticks.
struct Axis {
  /// A mark on the axis and its text.
  struct Tick {
    double at;
    Text text;
  };
  Text name;
  double low;
  double high;
  bool logarithmic = false;
  std::vector<Tick> ticks;
};

/// A table of numbers as colours over a whole panel. The axes may be logarithmic.
struct ColourMap {
  std::vector<double> values;  ///< numbers in rows from the bottom up; each row from left to right
  std::size_t columns = 1;
  Axis scale{};                 ///< scale that maps numbers to colours, shown beside the panel
  std::vector<Colour> palette;  ///< two or more, from low to high
};

/// A system of axes. It draws colours, regions, lines, arrows, marks and labels, in this order. Only labels may extend
/// beyond the axes.
struct Panel {
  Text title;
  Axis x;
  Axis y;
  std::vector<Lines> lines;
  std::vector<Arrows> arrows;
  std::vector<Marks> marks;
  std::vector<Label> labels;
  std::optional<ColourMap> colours{};
  bool bare = false;  ///< true: no axes and no border, for a drawing of objects to scale
  std::vector<Region> regions = {};
  bool to_scale = false;  ///< a unit of x is as long as a unit of y
};

/// The meaning of the colours of lines, as a strip beside the panels.
struct ColourBar {
  Text name;
  std::vector<Colour> colours;    ///< colours from the bottom up, in steps of equal height
  std::vector<Axis::Tick> ticks;  ///< marks; `at` is a fraction of the height
};

/// The size of a figure on paper.
struct PaperSize {
  double width_mm = 180, height_mm = 120;
};

/// Colours and sizes of a whole figure.
struct Theme {
  Colour ground{0xffffff};
  Colour ink{0x222222};    ///< colour of title, names and ticks
  Colour faint{0x555555};  ///< colour of the subtitle
  double line = 1;         ///< factor of all line widths
  double letters = 1;      ///< factor of the size of letters
};

/// A drawing as data: panels side by side under one title, a colour bar beside them, a legend below.
struct Figure {
  Text title;
  Text subtitle;
  PaperSize size = {};
  double dpi = 300;       ///< resolution of a PNG
  std::string font = {};  ///< font name; empty: a sans-serif font. TeX ignores the name
  int max_columns = 4;    ///< largest number of panels side by side
  std::vector<Panel> panels;
  std::optional<ColourBar> colour_bar = {};
  Theme theme = {};
};

/// The size that a caller wants. The program chooses each side that is empty.
struct AskedSize {
  std::optional<double> width_mm = {}, height_mm = {};
};

}  // namespace contensou::portraits
