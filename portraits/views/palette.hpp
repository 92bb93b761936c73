#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/portraits/phase_portrait_figure.hpp"

namespace contensou::portraits {

/// The colours of what portraits are made of. Lightness tells the times apart, so they survive in grey.
struct Palette {
  Theme theme;
  Colour orbit, comparison, highlight, invariant, isochrone, field, region;
  std::vector<Colour> times;  ///< from the stop on
};

Palette palette(bool screen);

/// Viridis, from dark to light in steps that eyes of any kind see as equal.
/// @param fraction  of the way, 0 to 1
/// @param white  fraction of white that is mixed in
Colour viridis(double fraction, double white = 0);

/// Times left cut into bands, each of one colour.
struct TimeBands {
  std::vector<double> edges;        ///< increasing, between bands
  std::vector<Colour> colours;      ///< one more than edges
  std::vector<std::size_t> marked;  ///< bands that the colour bar names the beginning of
  std::vector<double> arrows;       ///< times left at which orbits have an arrow head

  std::size_t band(double tau) const;
  double begin(std::size_t band) const { return band == 0 ? 0 : edges[band - 1]; }
};

/// Bands that change at isochrones: some equal ones for each interval where they are multiples of a step, in round steps of
/// the unit where that is round; else one between each two.
/// @param longest     time that is shown, in tau
/// @param isochrones  times of isochrones; none: about four intervals
/// @param step        of them; 0: none
TimeBands bands_of(double longest, std::vector<double> isochrones, double step, double unit, const Palette& palette);

/// Bands of equal ratio from the shortest time to the longest, in tau, with edges at round multiples of the unit.
TimeBands logarithmic_bands(double shortest, double longest, double unit, const Palette& palette);

ColourBar colour_bar(const TimeBands& bands, const PortraitCaption& caption);

/// The time left in a legend, with its symbol and unit.
Text time_left(const PortraitCaption& caption);

/// The orbit of the start that is asked for is heavier than those through points.
inline Stroke asked_stroke(const Palette& palette, bool of_start) { return {palette.highlight, of_start ? 3.4 : 2.0}; }

inline constexpr const char* through_legend = "through the points given";

}  // namespace contensou::portraits
