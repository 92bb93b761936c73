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

/// The times of isochrones, ascending, and the step that they are all multiples of, without gaps; 0: none.
struct IsochroneTimes {
  std::vector<double> times;
  double step;
};

/// Those that were asked for, in any order.
/// @param times  not empty
/// @param unit   of them
IsochroneTimes asked_times(std::vector<double> times, double unit);

/// Multiples of a round time up to the last, in its unit: as many as are asked for, as nearly as round times allow; about as
/// many as usual, by the roundest steps, where no number is.
IsochroneTimes even_times(double last, double unit, std::optional<int> asked, int usual);

/// The pieces of isochrones that lie in the rectangle, by growing time; along each, v/u turns from u > 0 to u < 0.
///
/// tau*(c u, c v) = c tau*(u, v): one of them is computed, as a function of the direction v/u, and the others are its
/// copies. Points are close enough to be joined by lines, and end on the border to the last digits.
std::vector<Isochrone> isochrones(const reduction::Flow& flow, const Rectangle& rectangle,
                                  const std::vector<double>& times);

}  // namespace contensou::portraits
