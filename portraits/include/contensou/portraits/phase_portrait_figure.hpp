#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// Texts and units of a drawing. The defaults suit the dimensionless system (2.6).
struct PortraitCaption {
  Text title = {};                  ///< if empty, the title consists of the law and mu
  Text subtitle = {};               ///< if empty, the subtitle names the quantities that the view shows
  std::string speed_unit = {};      ///< unit of u and v, "m/s" for a ball; empty if any common unit may be used
  Text time_symbol = math("τ*");    ///< symbol in the labels of isochrones
  std::string time_unit_name = {};  ///< "s" for a ball
  double time_unit = 1;             ///< number of tau in one time unit
  Text highlight = {};              ///< legend of the highlighted orbit
  Text panel = {};                  ///< name of this panel among several, before the view's own title
};

/// Options of a drawing.
struct PortraitStyle {
  enum class Arrows { time, one, none } arrows = Arrows::time;  ///< heads: at equal times, one on each orbit, or none
  enum class Field { none, motion, regularised } field = Field::none;  ///< needles: none, of (2.6) or of (2.7)
  bool invariant = true;       ///< draw the axes and the invariant rays, on which k is constant
  bool colour_by_time = true;  ///< colour orbits by the time left, unless two laws are compared
  bool asked = true;      ///< true: draw the highlighted orbit and the orbits through the requested points; false: the
                          ///< caller draws these orbits
  bool estimate = false;  ///< draw the approximation for small mu beside each motion (view time)
  bool screen = false;    ///< light on dark for a projector; false: dark on light for paper
  AskedSize size = {};    ///< an empty side follows from the view
};

/// Returns the name of the law for a title, with the name of the compared law if there is one.
std::string law_names(const PhasePortrait& portrait);

/// The map of a panel from states to points of its axes, and back.
struct PanelMap {
  using Instant = PortraitOrbit::Instant;

  /// Returns the point of a state on an orbit. At rest, the first state of the orbit determines the side of u = 0.
  std::function<Point(const Instant& at, const Instant& start)> place;
  /// Returns the state at a point, without its time left; empty if there is none. The function is null if the axes are
  /// times. In the view time, x is the fraction of the stop time that has passed.
  std::function<std::optional<Instant>(Point)> state = {};

  Polyline line(const PortraitOrbit& orbit) const;
};

/// Draws the portrait in its view. All numbers come from the portrait.
Figure draw(const PhasePortrait& portrait, const PortraitCaption& caption = {}, PortraitStyle style = {});

/// Draws portraits that are compared (phase_portraits), each in a panel with its name, with one colour scale.
/// @param captions  one for each portrait; title and subtitle are taken from the first
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
