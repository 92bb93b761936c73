#pragma once

#include <optional>
#include <vector>

#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// A rectangle of the half-plane v >= 0. On logarithmic axes both speeds of its corners are positive.
struct Rectangle {
  reduction::State low, high;
  bool logarithmic = false;
};

/// The times of isochrones, increasing, and the step of which they are all multiples; 0 if there is none.
struct IsochroneTimes {
  std::vector<double> times;
  double step;
};

/// Returns the requested times sorted.
/// @param times  not empty, in any order
/// @param unit   unit of the times
IsochroneTimes asked_times(std::vector<double> times, double unit);

/// Returns the multiples of a round time up to `last`, in a unit: about the requested number, as nearly as round times
/// allow. Without a number it returns about the usual number, by the roundest steps.
IsochroneTimes even_times(double last, double unit, std::optional<int> asked, int usual);

/// Returns the parts of isochrones in the rectangle, by increasing time. Along each, v/u turns from u > 0 to u < 0.
///
/// By tau*(c u, c v) = c tau*(u, v) one isochrone is computed, as a function of the direction v/u, and the others are
/// its copies. Points are close enough for straight lines between them, and end on the border to the last digits.
std::vector<Isochrone> isochrones(const reduction::Flow& flow, const Rectangle& rectangle,
                                  const std::vector<double>& times);

}  // namespace contensou::portraits
