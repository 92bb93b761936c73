#pragma once

#include <optional>
#include <vector>

#include "contensou/portraits/phase_portrait.hpp"

namespace contensou::portraits {

/// Usual number of isochrones, the lines of all states with one stop time.
inline constexpr int usual_isochrones = 7;

/// The times of isochrones, increasing. All are multiples of `step`; `step` is 0 if there is no such step.
struct IsochroneTimes {
  std::vector<double> times;
  double step;
};

/// Returns the requested times, sorted. Without requested times it returns multiples of a round step up to `last`. A
/// requested number of times is met as nearly as round steps allow; otherwise steps are the roundest for about `usual`
/// times.
IsochroneTimes isochrone_times(const PortraitRequest& request, double last, int usual = usual_isochrones);

/// Returns the parts of isochrones in a window of the half-plane, by increasing time. Along each part the direction v/u
/// turns from u > 0 to u < 0.
///
/// The stop time satisfies tau*(c u, c v) = c tau*(u, v). One isochrone is therefore computed as a function of v/u, and
/// the others are scaled copies. The points are close enough for straight lines. Ends lie exactly on the border.
/// @param logarithmic  true for logarithmic axes; then the window is one of positive u and v
std::vector<Isochrone> isochrones(const reduction::Flow& flow, const Window& window, const std::vector<double>& times,
                                  bool logarithmic = false);

}  // namespace contensou::portraits
