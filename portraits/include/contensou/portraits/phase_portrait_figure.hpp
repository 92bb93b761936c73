#pragma once

#include <optional>
#include <string>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// Words and units of a drawing; the defaults are those of the paper's plane.
struct PortraitCaption {
  std::string title = {};           ///< empty: the law and mu
  std::string subtitle = {};        ///< empty: what the view shows
  std::string speed_unit = {};      ///< of u and v, "m/s" for a ball; empty: any one unit
  std::string time_symbol = "τ*";   ///< what isochrones are labelled with
  std::string time_unit_name = {};  ///< "s" for a ball
  double time_unit = 1;             ///< in tau
  std::string highlight = {};       ///< legend of the highlighted orbit
};

/// What is drawn and how.
struct PortraitStyle {
  enum class Arrows { time, one, none } arrows = Arrows::time;         ///< at equal times, one on each orbit, none
  enum class Field { none, motion, regularised } field = Field::none;  ///< directions of (2.6), (2.7)
  bool invariant = true;                                               ///< axes and ray, which are the nullclines
  bool colour_by_time = true;  ///< orbits by the time left; not where two laws are compared
  bool asked = true;           ///< the highlighted orbit and those through points; else the caller draws them
  bool screen = false;         ///< light on dark, for a projector, instead of dark on light, for paper
  AskedSize size = {};         ///< what is left out follows from the view
};

/// The law, and the one that it is compared with, in the words of a title.
std::string law_names(const PhasePortrait& portrait);

/// The portrait as a drawing in its view. A pure function: all numbers come from the portrait.
Figure draw(const PhasePortrait& portrait, const PortraitCaption& caption = {}, PortraitStyle style = {});

}  // namespace contensou::portraits
