#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/phase_portrait_figure.hpp"

namespace contensou::portraits {

/// The colours of portraits. Times differ in lightness, so that they remain distinct in grey.
struct Palette {
  Theme theme;
  Colour orbit, comparison, highlight, invariant, isochrone, field, region;
  std::vector<Colour> times;  ///< colours of times left, from the stop on
};

Palette palette(bool screen);

/// Returns a colour of Viridis, from dark to light in steps that all viewers see as equal.
/// @param fraction  place between dark and light, 0 to 1
/// @param white     fraction of white that is added
Colour viridis(double fraction, double white = 0);

/// Times left in bands of one colour each.
struct TimeBands {
  std::vector<double> edges;        ///< increasing, between bands
  std::vector<Colour> colours;      ///< one more than edges
  std::vector<std::size_t> marked;  ///< bands at whose beginning the colour bar has a number
  std::vector<double> arrows;       ///< times left at which orbits have an arrow head

  std::size_t band(double tau) const;
  double begin(std::size_t band) const { return band == 0 ? 0 : edges[band - 1]; }
};

/// Returns bands for the times left of portraits, which change at isochrones; without isochrones in about four
/// intervals. If isochrones are multiples of a step, each interval has some equal bands, in round steps of the unit if
/// possible; else there is one band between two isochrones.
/// @param unit  unit of the bar's numbers, in tau
/// @param most  limit of the times
TimeBands bands_of(const std::vector<const Portrait*>& portraits, double unit, const Palette& palette,
                   double most = INFINITY);

/// Returns bands of equal ratio from the shortest time to the longest, in tau, with edges at multiples of the unit.
TimeBands logarithmic_bands(double shortest, double longest, double unit, const Palette& palette);

ColourBar colour_bar(const TimeBands& bands, const PortraitCaption& caption);

/// Returns the legend text for the time left, with its symbol and unit.
Text time_left(const PortraitCaption& caption);

/// Returns the stroke of requested orbits; the orbit of the start is heavier than those through points.
inline Stroke asked_stroke(const Palette& palette, bool of_start) { return {palette.highlight, of_start ? 3.4 : 2.0}; }

inline constexpr const char* through_legend = "through the points given";

}  // namespace contensou::portraits
