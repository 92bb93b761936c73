#pragma once

#include <optional>
#include <vector>

#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// Usual number of isochrones.
inline constexpr int usual_isochrones = 7;

/// The times of isochrones, increasing, and the step of which they are all multiples; 0 if there is none.
struct IsochroneTimes {
  std::vector<double> times;
  double step;
};

/// Returns the requested times sorted, else multiples of a round time up to `last`: about the requested number, as
/// nearly as round times allow. Without a number it returns about the usual number, by the roundest steps.
IsochroneTimes isochrone_times(const PortraitRequest& request, double last, int usual = usual_isochrones);

/// Returns the parts of isochrones in the window of the half-plane, by increasing time. Along each, v/u turns from u >
/// 0 to u < 0.
///
/// By tau*(c u, c v) = c tau*(u, v) one isochrone is computed, as a function of the direction v/u, and the others are
/// its copies. Points are close enough for straight lines between them, and end on the border to the last digits.
/// @param logarithmic  true for logarithmic axes; then the window is one of positive u and v
std::vector<Isochrone> isochrones(const reduction::Flow& flow, const Window& window, const std::vector<double>& times,
                                  bool logarithmic = false);

}  // namespace contensou::portraits
