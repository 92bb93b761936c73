#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// Words and units of a drawing; the defaults are those of the paper's plane.
struct PortraitCaption {
  Text title = {};                  ///< empty: the law and mu
  Text subtitle = {};               ///< empty: what the view shows
  std::string speed_unit = {};      ///< of u and v, "m/s" for a ball; empty: any one unit
  Text time_symbol = math("τ*");    ///< what isochrones are labelled with
  std::string time_unit_name = {};  ///< "s" for a ball
  double time_unit = 1;             ///< in tau
  Text highlight = {};              ///< legend of the highlighted orbit
  Text panel = {};                  ///< what the panel is, before the view's own title of it, where there are several
};

/// What is drawn and how.
struct PortraitStyle {
  enum class Arrows { time, one, none } arrows = Arrows::time;         ///< at equal times, one on each orbit, none
  enum class Field { none, motion, regularised } field = Field::none;  ///< directions of (2.6), (2.7)
  bool invariant = true;                                               ///< axes and ray, which are the nullclines
  bool colour_by_time = true;  ///< orbits by the time left; not where two laws are compared
  bool asked = true;           ///< the highlighted orbit and those through points; else the caller draws them
  bool estimate = false;       ///< in the view of time, beside each motion the asymptotic solution for small mu
  bool screen = false;         ///< light on dark, for a projector, instead of dark on light, for paper
  AskedSize size = {};         ///< what is left out follows from the view
};

/// The law, and the one that it is compared with, in the words of a title.
std::string law_names(const PhasePortrait& portrait);

/// How a panel shows the half-plane: states as points of its axes, and back.
struct PanelMap {
  using Instant = PortraitOrbit::Instant;

  /// Where a state lies of an orbit that begins at `start`, which tells the side of u = 0 also at rest.
  std::function<Point(const Instant& at, const Instant& start)> place;
  /// The state at a point, with no time left; nothing where there is none. Empty where points are moments: in the
  /// view of time, x is the fraction of the stop time that has passed.
  std::function<std::optional<Instant>(Point)> state = {};

  Polyline line(const PortraitOrbit& orbit) const;
};

/// The portrait as a drawing in its view. A pure function: all numbers come from the portrait.
Figure draw(const PhasePortrait& portrait, const PortraitCaption& caption = {}, PortraitStyle style = {});

/// Portraits that compare (phase_portraits), each in a panel that names what is its own, with one scale of colours.
/// @param captions  one for each; title and subtitle of the first
/// @throws std::domain_error  for more than 6, and in a view of several panels
Figure draw_together(const std::vector<PhasePortrait>& portraits, std::vector<PortraitCaption> captions,
                     const PortraitStyle& style = {});

/// The drawing, and the map of each of its panels.
struct MappedFigure {
  Figure figure;
  std::vector<PanelMap> maps;
};
MappedFigure draw_mapped(const PhasePortrait& portrait, const PortraitCaption& caption = {}, PortraitStyle style = {});

}  // namespace contensou::portraits
