#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// The point at that fraction (0 to 1) of the way from a to b.
Point between(Point a, Point b, double fraction);

/// Where a point of a panel lies on paper: x from 0 (left) to 1 (right), y from 0 (bottom) to 1 (top).
Point on_paper(const Panel& panel, Point point);

/// The point of the panel that lies there.
Point from_paper(const Panel& panel, Point place);

/// Distance on paper, in sides of the panel.
double paper_distance(const Panel& panel, Point a, Point b);

/// Length of a line on paper, in sides of the panel.
double paper_length(const Panel& panel, const Polyline& line);

/// The parts of a line that lie within the axes; a point that is not finite breaks it.
std::vector<Polyline> clipped(const Panel& panel, const Polyline& line);

/// The line with fewer points.
/// @param tolerance  in sides of the panel: no point of the line is farther than that on paper from the result
Polyline thinned(const Panel& panel, const Polyline& line, double tolerance = 2e-4);

/// What is seen of the lines: clipped and thinned.
std::vector<Polyline> visible(const Panel& panel, const std::vector<Polyline>& lines);

/// The arrow at a fraction (0 to 1) of a line's length on paper; of a line without length, an arrow without direction.
Arrow arrow_along(const Panel& panel, const Polyline& line, double fraction);

/// A rectangle in millimetres from the lower left corner of the figure.
struct Box {
  double left, bottom, width, height;
};

/// An arrow as short as its head, that ends where the arrow is: `at` is its beginning. Nothing if it has no direction.
std::optional<Arrow> short_arrow(const Panel& panel, const Box& box, const Arrow& arrow);

/// What the legend lists: a text with the line and the marks that it names, or one of them.
struct LegendEntry {
  std::string text;
  const Lines* lines;
  const Marks* marks;
};

/// The entries of all panels, each text once.
std::vector<LegendEntry> legend_entries(const Figure& figure);

/// A text on the page by its middle, or by the middle of its left end.
struct PlacedText {
  std::string text;
  Point at;         ///< mm
  double size = 1;  ///< in sizes of letters
  Label::Align align = Label::Align::centre;
  bool faint = false, turned = false;
};

/// A panel on the page.
struct PanelPlace {
  Box box;                              ///< between the axes
  std::vector<Axis::Tick> x, y, scale;  ///< of its axes and of its ColourMap
  Box colour_scale;                     ///< of its ColourMap
};

/// A sample of a line or a mark in the legend: from its left end.
struct LegendPlace {
  LegendEntry entry;
  Point from;
  double width;
};

/// Where everything goes, mm. Letters have the size that a journal wants: 6.5 pt in a column of 85 mm, 7.7 pt from
/// 170 mm on. Panels stand side by side where each has 50 mm, else one above the other; margins and the number of ticks
/// follow from the width of their labels, and titles are broken into lines.
struct Layout {
  double letter;  ///< the size of letters
  std::vector<PlacedText> texts;
  std::vector<PanelPlace> panels;
  std::vector<LegendPlace> legend;
  std::vector<Box> colours;  ///< of the colour bar, from the bottom up
};

/// @throws std::domain_error  if the figure is too small for its panels
Layout lay_out(const Figure& figure);

/// Widens one axis of a panel about its middle so that on the page a unit of y is as many times as long as one of x.
/// @param panel  its index, of a panel with linear axes
/// @throws std::domain_error  as lay_out
void widen(Figure& figure, std::size_t panel, double times = 1);

/// The width of a line, the length of an arrow's head and the width of a mark of size 1, in sizes of letters.
inline constexpr double line_width = 0.074, head_length = 0.74, mark_size = 0.5;

/// The size of letters in a figure of that width.
double letter_mm(double width_mm);

/// How many panels stand side by side.
int panel_columns(double width_mm, int panels);

/// The size of a figure: what is asked for, the rest so that its panels keep their shape.
/// @param usual  the size in which its panels, side by side, look best
PaperSize fitted(const PaperSize& usual, int panels, const AskedSize& asked);

/// A figure of one panel to scale, lower by what that leaves empty above and below; any other as it is.
/// @throws std::domain_error  as lay_out
Figure trimmed(Figure figure);

/// The size of a panel of such a figure in mm, about: what is left beside names and ticks.
Point panel_size(const PaperSize& figure, int panels);

}  // namespace contensou::portraits
