#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

// Lengths have one of three units: sides of the panel between its axes ("on paper"), millimetres on the page, or letter
// sizes. A logarithmic axis needs low > 0 and points with a positive coordinate; this is not checked.

/// Returns the point at a fraction (0 to 1) of the way from a to b, in the units of a and b.
Point between(Point a, Point b, double fraction);

/// Returns the place on paper of a point that is given in the units of the axes.
/// @return  x from 0 (left) to 1 (right), y from 0 (bottom) to 1 (top); outside this range if the point lies beyond the
///          axes; not finite if the point is not
Point on_paper(const Panel& panel, Point point);

/// Returns the point in the units of the axes at a place on paper, the inverse of on_paper.
Point from_paper(const Panel& panel, Point place);

/// Returns the distance on paper of two points in the units of the axes, in sides of the panel.
double paper_distance(const Panel& panel, Point a, Point b);

/// Returns the length of a line on paper, in sides of the panel; 0 for a line of fewer than 2 points.
double paper_length(const Panel& panel, const Polyline& line);

/// Returns the parts of a line that lie within the axes. A point that is not finite breaks the line.
/// @return  lines in the units of the axes; a part that leaves or enters the panel ends on the border
std::vector<Polyline> clipped(const Panel& panel, const Polyline& line);

/// Returns a line with fewer points, by the method of Douglas and Peucker (doi:10.3138/FM57-6770-U75U-7727).
/// @param tolerance  largest distance on paper, in sides of the panel, of a point of the line from the result
/// @return  some of the line's points, including the first and the last
Polyline thinned(const Panel& panel, const Polyline& line, double tolerance = 2e-4);

/// Returns the visible parts of lines: clipped, then thinned by the default tolerance.
std::vector<Polyline> visible(const Panel& panel, const std::vector<Polyline>& lines);

/// Returns the arrow at a fraction of a line's length on paper.
/// @param line      not empty
/// @param fraction  0 to 1
/// @return  arrow in the units of the axes; a line of length 0 gives its end with the direction (0, 0)
Arrow arrow_along(const Panel& panel, const Polyline& line, double fraction);

/// A rectangle in millimetres from the lower left corner of the figure.
struct Box {
  double left, bottom, width, height;
};

/// Returns an arrow of 0.5 mm that ends where the given arrow ends, so that its head covers the shaft.
/// @param box  panel on the page, mm
/// @return  arrow whose beginning is `at`, in the units of the axes; empty if the given arrow has no direction
std::optional<Arrow> short_arrow(const Panel& panel, const Box& box, const Arrow& arrow);

/// An entry of the legend: a text, and the line, the mark, or both to which the text belongs.
struct LegendEntry {
  Text text;
  const Lines* lines;
  const Marks* marks;
};

/// Returns the legend entries of all panels, each text once, in the order of panels, lines before marks. Entries point
/// into the figure, which must outlive them.
std::vector<LegendEntry> legend_entries(const Figure& figure);

/// A text on the page. Its position is its middle or the middle of its left end.
struct PlacedText {
  Text text;
  Point at;         ///< mm
  double size = 1;  ///< letter size divided by the usual size
  Label::Align align = Label::Align::centre;
  bool faint = false, turned = false;
};

/// A panel on the page.
struct PanelPlace {
  Box box;                              ///< rectangle between the axes
  std::vector<Axis::Tick> x, y, scale;  ///< ticks of the axes and of the ColourMap
  Box colour_scale;                     ///< strip of the ColourMap
};

/// The place of a sample line or mark in the legend.
struct LegendPlace {
  LegendEntry entry;
  Point from;
  double width;
};

/// The places of all parts of a figure, in mm.
///
/// Letters have the size that journals require: 6.5 pt in a column of 85 mm, 7.7 pt from 170 mm on. Panels stand side
/// by side if each is at least 50 mm wide, else one above the other. Margins and numbers of ticks follow from the width
/// of the labels. Titles are broken into lines.
struct Layout {
  double letter;  ///< size of letters in mm
  std::vector<PlacedText> texts;
  std::vector<PanelPlace> panels;
  std::vector<LegendPlace> legend;
  std::vector<Box> colours;  ///< boxes of the colour bar, from the bottom up
};

/// Computes the layout of a figure.
/// @return  layout that points into the figure; the figure must outlive it
/// @throws std::domain_error  if the figure is so small that a panel has less than 9 x 5 sizes of letters
Layout lay_out(const Figure& figure);

/// Widens one axis of a panel about its middle, so that a unit of y is `times` as long on the page as a unit of x.
/// @param panel  index of a panel with linear axes
/// @throws std::domain_error  as lay_out
void widen(Figure& figure, std::size_t panel, double times = 1);

/// The width of a line, the length of an arrow head and the width of a mark, each of size 1, in letter sizes.
inline constexpr double line_width = 0.074, head_length = 0.74, mark_size = 0.5;
/// The distance from an x axis to the middle of its numbers, in letter sizes.
inline constexpr double tick_drop = 1.5;
/// The letter sizes of ticks and of labels, divided by the usual size.
inline constexpr double tick_size = 0.9, label_size = 0.85;

/// Returns the size of letters in a figure of the given width, 2.2 to 2.7 mm.
double letter_mm(double width_mm);

/// Returns the number of panels side by side: the largest for which each is at least 50 mm wide and all rows are full.
int panel_columns(double width_mm, int panels);

/// Returns the size of a figure. Sides that are not wanted are chosen so that the panels keep their shape.
/// @param usual        best size for all panels side by side
/// @param panels       number of panels; if only the width is wanted, it determines how many stand side by side
/// @param max_columns  largest number of panels side by side; the number fills its rows
PaperSize fitted(const PaperSize& usual, int panels, const AskedSize& asked,
                 int max_columns = std::numeric_limits<int>::max());

/// Returns a figure of one panel to scale without empty space above and below it; any other figure unchanged.
/// @throws std::domain_error  as lay_out
Figure trimmed(Figure figure);

/// Returns the approximate width and height in mm of one of several panels, without names and ticks; at least 10.
Point panel_size(const PaperSize& figure, int panels);

}  // namespace contensou::portraits
