#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// The colours of portraits. Colours of times differ in lightness, so that they remain distinct in grey.
struct Palette {
  Theme theme;
  Colour orbit, comparison, highlight, invariant, isochrone, field, region;
  std::vector<Colour> times;  ///< colours of the time left, starting with the stop
};

Palette palette(bool screen);

/// Returns a colour of the palette Viridis, from dark to light. All viewers see equal steps as equal.
/// @param fraction  place between dark and light, 0 to 1
/// @param white     fraction of white that is added
Colour viridis(double fraction, double white = 0);

/// Times left, divided into bands with one colour each.
struct TimeBands {
  std::vector<double> edges;        ///< times left between the bands, increasing
  std::vector<Colour> colours;      ///< one more than edges
  std::vector<std::size_t> marked;  ///< bands whose beginning has a number on the colour bar
  std::vector<double> arrows;       ///< times left at which orbits have an arrow head

  std::size_t band(double tau) const;
  double begin(std::size_t band) const { return band == 0 ? 0 : edges[band - 1]; }
};

/// Returns bands of the time left in portraits. Bands change at isochrones; without isochrones there are about four
/// intervals. If isochrones are multiples of a step, each interval contains some equal bands, if possible in round
/// steps of the unit. Otherwise there is one band between two isochrones.
/// @param unit  unit of the bar's numbers, in tau
/// @param most  upper limit of the times
TimeBands bands_of(const std::vector<const Portrait*>& portraits, double unit, const Palette& palette,
                   double most = INFINITY);

/// Returns bands of equal ratio from the shortest to the longest time, in tau. Their edges are multiples of the unit.
TimeBands logarithmic_bands(double shortest, double longest, double unit, const Palette& palette);

ColourBar colour_bar(const TimeBands& bands, const PortraitCaption& caption);

/// Returns the legend text for the time left, with its symbol and unit.
Text time_left(const PortraitCaption& caption);

/// Returns the stroke of requested orbits. The orbit of the start is heavier than orbits through requested points.
inline Stroke asked_stroke(const Palette& palette, bool of_start) { return {palette.highlight, of_start ? 3.4 : 2.0}; }

/// The stroke and the legend of the uncoupled model beside a requested motion.
inline Stroke uncoupled_stroke(const Palette& palette) { return {palette.highlight, 1.8, true}; }
inline constexpr const char* uncoupled_legend = "textbook: slip and spin apart";
inline constexpr const char* through_legend = "through the points given";

}  // namespace contensou::portraits
