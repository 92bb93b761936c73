#pragma once

#include <optional>
#include <vector>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// Where a point of a panel lies on paper: x from 0 (left) to 1 (right), y from 0 (bottom) to 1 (top).
Point on_paper(const Panel& panel, Point point);

/// The point of the panel that lies there.
Point from_paper(const Panel& panel, Point place);

/// Distance on paper, in sides of the panel.
double paper_distance(const Panel& panel, Point a, Point b);

/// The parts of a line that lie within the axes; a point that is not finite breaks it.
std::vector<Polyline> clipped(const Panel& panel, const Polyline& line);

/// The line with fewer points: none is farther from it on paper than the tolerance, in sides of the panel.
Polyline thinned(const Panel& panel, const Polyline& line, double tolerance = 2e-4);

/// The arrow at a share (0 to 1) of a line's length on paper; of a line without length, an arrow without direction.
Arrow arrow_along(const Panel& panel, const Polyline& line, double share);

/// A rectangle in millimetres from the lower left corner of the figure.
struct Box {
  double left, bottom, width, height;
};

/// An arrow as short as its head, that ends where the arrow is: `at` is its beginning. Nothing if it has no direction.
std::optional<Arrow> short_arrow(const Panel& panel, const Box& box, const Arrow& arrow);

/// Where everything goes.
struct Layout {
  double letter;              ///< the size of letters, mm
  double title, subtitle;     ///< heights of the middle of these lines
  double legend;              ///< of the legend
  std::vector<Box> panels;    ///< between the axes
  std::vector<double> names;  ///< height of each panel's title
  Box colour_bar;             ///< without its ticks; width 0 if there is none
};

Layout lay_out(const Figure& figure);

}  // namespace contensou::portraits
