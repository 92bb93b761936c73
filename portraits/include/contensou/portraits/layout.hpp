#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

// Lengths are in one of three units: on paper, in sides of the panel between its axes; in millimetres on the page; in
// sizes of letters. A logarithmic axis needs low > 0 and points with a positive coordinate, which is not checked.

/// The point at that fraction (0 to 1) of the way from a to b, in their units.
Point between(Point a, Point b, double fraction);

/// Where a point of a panel, in the units of its axes, lies on paper.
/// @return  x from 0 (left) to 1 (right), y from 0 (bottom) to 1 (top); beyond the axes less or more; not finite where the
///          point is not
Point on_paper(const Panel& panel, Point point);

/// The inverse of on_paper.
/// @return  the point in the units of the axes
Point from_paper(const Panel& panel, Point place);

/// @return  the distance on paper of two points given in the units of the axes, in sides of the panel
double paper_distance(const Panel& panel, Point a, Point b);

/// @return  the length of a line on paper, in sides of the panel; 0 for a line of fewer than 2 points
double paper_length(const Panel& panel, const Polyline& line);

/// The parts of a line that lie within the axes; a point that is not finite breaks it.
/// @return  in the units of the axes; a part that leaves or enters ends on the border
std::vector<Polyline> clipped(const Panel& panel, const Polyline& line);

/// The line with fewer points, by Douglas and Peucker (doi:10.3138/FM57-6770-U75U-7727).
/// @param tolerance  in sides of the panel: no point of the line is farther than that on paper from the result
/// @return  some of the line's points, the first and the last among them
Polyline thinned(const Panel& panel, const Polyline& line, double tolerance = 2e-4);

/// What is seen of the lines: clipped, then thinned by the tolerance above.
std::vector<Polyline> visible(const Panel& panel, const std::vector<Polyline>& lines);

/// The arrow at a fraction of a line's length on paper.
/// @param line      not empty
/// @param fraction  0 to 1
/// @return  in the units of the axes; of a line without length at its end, without direction
Arrow arrow_along(const Panel& panel, const Polyline& line, double fraction);

/// A rectangle in millimetres from the lower left corner of the figure.
struct Box {
  double left, bottom, width, height;
};

/// An arrow of 0.5 mm, which its head covers, that ends where the arrow is.
/// @param box  the panel on the page, mm
/// @return  its beginning as `at`, in the units of the axes; nothing if it has no direction
std::optional<Arrow> short_arrow(const Panel& panel, const Box& box, const Arrow& arrow);

/// What the legend lists: a text with the line and the marks that it names, or one of them.
struct LegendEntry {
  Text text;
  const Lines* lines;
  const Marks* marks;
};

/// The entries of all panels, each text once, in the order of panels, lines before marks. They point into the figure, which
/// must outlive them.
std::vector<LegendEntry> legend_entries(const Figure& figure);

/// A text on the page by its middle, or by the middle of its left end.
struct PlacedText {
  Text text;
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

/// @return  it points into the figure, which must outlive it
/// @throws std::domain_error  if the figure is too small for its panels: one has less than 9 x 5 sizes of letters
Layout lay_out(const Figure& figure);

/// Widens one axis of a panel about its middle so that on the page a unit of y is as many times as long as one of x.
/// @param panel  its index, of a panel with linear axes
/// @throws std::domain_error  as lay_out
void widen(Figure& figure, std::size_t panel, double times = 1);

/// The width of a line, the length of an arrow's head and the width of a mark of size 1, in sizes of letters.
inline constexpr double line_width = 0.074, head_length = 0.74, mark_size = 0.5;
/// The size of a tick's text and of a label's.
inline constexpr double tick_size = 0.9, label_size = 0.85;

/// The size of letters in a figure of that width, 2.2 to 2.7 mm.
double letter_mm(double width_mm);

/// How many panels stand side by side: the most that leave each 50 mm and fill their rows.
int panel_columns(double width_mm, int panels);

/// The size of a figure: what is asked for, the rest so that its panels keep their shape.
/// @param usual        the size in which its panels, side by side, look best
/// @param panels       how many; a width alone that is asked for decides how many stand side by side
/// @param max_columns  of the figure; fills its rows
PaperSize fitted(const PaperSize& usual, int panels, const AskedSize& asked,
                 int max_columns = std::numeric_limits<int>::max());

/// A figure of one panel to scale, lower by what that leaves empty above and below; any other as it is.
/// @throws std::domain_error  as lay_out
Figure trimmed(Figure figure);

/// @return  width and height of a panel of such a figure in mm, about: what is left beside names and ticks; 10 at least
Point panel_size(const PaperSize& figure, int panels);

}  // namespace contensou::portraits
