#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "contensou/portraits/text.hpp"

namespace contensou::portraits {

/// A point in the units of a panel's axes.
struct Point {
  double x;
  double y;
};

using Polyline = std::vector<Point>;

/// Red, green and blue, eight bits each: 0xrrggbb.
struct Colour {
  unsigned rgb = 0;
};

/// How a line looks; widths are in points.
struct Stroke {
  Colour colour;
  double width = 1;
  bool dashed = false;
  bool dotted = false;  ///< dots; with dashed, both in turn
};

/// Polylines of one look; one entry of the legend.
struct Lines {
  std::vector<Polyline> lines;
  Stroke stroke;
  Text legend;  ///< empty: not in the legend
};

/// An arrow head that points along a direction, given in the units of the axes.
struct Arrow {
  Point at;
  Point direction;
};

/// Arrow heads of one look, all of one size on paper.
struct Arrows {
  std::vector<Arrow> arrows;
  Colour colour;
  double size = 1;
};

/// Signs at points; one entry of the legend. A circle and a square are open, on the figure's ground.
struct Marks {
  std::vector<Point> points;
  Colour colour;
  double size = 0.6;
  enum class Shape { dot, circle, square } shape = Shape::dot;
  Text legend = {};  ///< empty: not in the legend
};

/// A filled area under everything else.
struct Region {
  Polyline border;
  Colour colour;
};

/// A text at a point of a panel, on the figure's ground so that it stays legible over lines.
struct Label {
  Point at;
  Text text;
  Colour colour;
  enum class Align { left, centre, right } align = Align::centre;
};

/// An interval with its name; ticks only where the default ones do not serve.
struct Axis {
  /// A mark on the axis and its words.
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

/// A field of numbers as colours, stretched over all of a panel, whose axes may be logarithmic.
struct ColourMap {
  std::vector<double> values;  ///< rows from the bottom up, each from left to right
  std::size_t columns = 1;
  Axis scale{};                 ///< of the numbers, shown beside the panel
  std::vector<Colour> palette;  ///< two or more, from low to high
};

/// One system of axes and what is drawn in it, in the order given: colours, regions, lines, arrows, marks, labels. Only
/// labels may lie beyond the axes.
struct Panel {
  Text title;
  Axis x;
  Axis y;
  std::vector<Lines> lines;
  std::vector<Arrows> arrows;
  std::vector<Marks> marks;
  std::vector<Label> labels;
  std::optional<ColourMap> colours{};
  bool bare = false;  ///< no axes and no border: a drawing of things, to the scale of its own lines
  std::vector<Region> regions = {};
  bool to_scale = false;  ///< one unit of x is as long as one of y
};

/// What the colours of lines mean: a strip beside the panels.
struct ColourBar {
  Text name;
  std::vector<Colour> colours;    ///< from the bottom up, in steps of one height
  std::vector<Axis::Tick> ticks;  ///< at: fraction of the height
};

/// The size of a figure on paper.
struct PaperSize {
  double width_mm = 180, height_mm = 120;
};

/// The colours and letters of a whole figure.
struct Theme {
  Colour ground{0xffffff};
  Colour ink{0x222222};    ///< title, names, ticks
  Colour faint{0x555555};  ///< subtitle
  double line = 1;         ///< factor of all widths
  double letters = 1;      ///< factor of the size of letters
};

/// A drawing as data: panels side by side under one title, a colour bar beside them, one legend below.
struct Figure {
  Text title;
  Text subtitle;
  PaperSize size = {};
  double dpi = 300;       ///< of a PNG
  std::string font = {};  ///< its name; empty: a sans-serif one. TeX keeps its own
  int max_columns = 4;    ///< of panels, side by side
  std::vector<Panel> panels;
  std::optional<ColourBar> colour_bar = {};
  Theme theme = {};
};

/// A size that is asked for; what is left out is chosen.
struct AskedSize {
  std::optional<double> width_mm = {}, height_mm = {};
};

}  // namespace contensou::portraits
