#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// Texts and units of a drawing. The defaults are those of the paper's plane.
struct PortraitCaption {
  Text title = {};                  ///< if empty, the law and mu
  Text subtitle = {};               ///< if empty, the quantities that the view shows
  std::string speed_unit = {};      ///< unit of u and v, "m/s" for a ball; if empty, any common unit
  Text time_symbol = math("τ*");    ///< symbol in the labels of isochrones
  std::string time_unit_name = {};  ///< "s" for a ball
  double time_unit = 1;             ///< time unit in tau
  Text highlight = {};              ///< legend of the highlighted orbit
  Text panel = {};                  ///< name of a panel among several, shown before the view's own title
};

/// Options of a drawing.
struct PortraitStyle {
  enum class Arrows { time, one, none } arrows = Arrows::time;  ///< heads at equal times, one on each orbit, none
  enum class Field { none, motion, regularised } field = Field::none;  ///< directions of nothing, of (2.6), of (2.7)
  bool invariant = true;       ///< draw the axes and the ray, which are the nullclines
  bool colour_by_time = true;  ///< colour orbits by the time left, unless two laws are compared
  bool asked = true;      ///< true: draw the highlighted orbit and the orbits through the requested points; false: the
                          ///< caller draws these orbits
  bool estimate = false;  ///< draw the approximation for small mu beside each motion (view time)
  bool screen = false;    ///< light on dark for a projector; false: dark on light for paper
  AskedSize size = {};    ///< an empty side follows from the view
};

/// Returns the name of the law, and of the law compared with it, for a title.
std::string law_names(const PhasePortrait& portrait);

/// The map of a panel from states to points of its axes, and back.
struct PanelMap {
  using Instant = PortraitOrbit::Instant;

  /// Returns the point of a state on an orbit. Its beginning `start` gives the side of u = 0 at rest.
  std::function<Point(const Instant& at, const Instant& start)> place;
  /// Returns the state at a point, without its time left; empty if there is none. The function is null if points are
  /// times; in the view of time, x is the fraction of the stop time that has passed.
  std::function<std::optional<Instant>(Point)> state = {};

  Polyline line(const PortraitOrbit& orbit) const;
};

/// Draws the portrait in its view. All numbers come from the portrait.
Figure draw(const PhasePortrait& portrait, const PortraitCaption& caption = {}, PortraitStyle style = {});

/// Draws portraits that are compared (phase_portraits), each in a panel with its name, with one scale of colours.
/// @param captions  one for each portrait; title and subtitle are those of the first
/// @throws std::domain_error  for more than 6 portraits, and in a view of several panels
Figure draw_together(const std::vector<PhasePortrait>& portraits, std::vector<PortraitCaption> captions,
                     const PortraitStyle& style = {});

/// A drawing and the map of each of its panels.
struct MappedFigure {
  Figure figure;
  std::vector<PanelMap> maps;
};
MappedFigure draw_mapped(const PhasePortrait& portrait, const PortraitCaption& caption = {}, PortraitStyle style = {});

}  // namespace contensou::portraits
