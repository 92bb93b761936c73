#pragma once

#include <string>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// Words and units of a drawing; the defaults are those of the paper's plane.
struct PortraitCaption {
  std::string title;               ///< empty: the law and mu
  std::string subtitle;            ///< empty: what orbits and axes are
  std::string speed_unit;          ///< of u and v, "m/s" for a ball; empty: any one unit
  std::string time_symbol = "τ*";  ///< what isochrones are labelled with
  std::string time_unit_name;      ///< "s" for a ball
  double time_unit = 1;            ///< in tau
  std::string highlight;           ///< legend of the highlighted orbit
};

/// The portrait as a drawing: orbits with arrows, labelled isochrones, both invariant axes, legend.
Figure draw(const PhasePortrait& portrait, const PortraitCaption& caption = {});

}  // namespace contensou::portraits
