#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// The point at that share (0 to 1) of the way from a to b.
Point between(Point a, Point b, double share);

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

/// The arrow at a share (0 to 1) of a line's length on paper; of a line without length, an arrow without direction.
Arrow arrow_along(const Panel& panel, const Polyline& line, double share);

/// A rectangle in millimetres from the lower left corner of the figure.
struct Box {
  double left, bottom, width, height;
};

/// An arrow as short as its head, that ends where the arrow is: `at` is its beginning. Nothing if it has no direction.
std::optional<Arrow> short_arrow(const Panel& panel, const Box& box, const Arrow& arrow);

/// What the legend lists: a text with the line or the marks that it names, whichever is not null.
struct LegendEntry {
  std::string text;
  const Lines* lines;
  const Marks* marks;
};

/// The entries of all panels, each text once.
std::vector<LegendEntry> legend_entries(const Figure& figure);

/// Where everything goes.
struct Layout {
  double letter;              ///< the size of letters, mm
  double title, subtitle;     ///< heights of the middle of these lines
  double legend;              ///< of the legend
  std::vector<Box> panels;    ///< between the axes
  std::vector<double> names;  ///< height of each panel's title
  Box colour_bar;             ///< without its ticks; width 0 if there is none
  std::vector<Box> colours;   ///< of the colour bar, from the bottom up
};

Layout lay_out(const Figure& figure);

}  // namespace contensou::portraits
