#pragma once

#include <vector>

#include "contensou/reduction/friction_law.hpp"
#include "stop_times/stop_time_kernel.hpp"

namespace contensou::reduction {

/// S/P where v0 = |u0|/lever, and what G is given in units of.
struct PanelScales {
  long double sliding_share;
  long double unit;  ///< times P/|u0|
};

/// The panels of G, README (R18), for the Pade law and r up to this, on one sheet.
///
/// @param fold  1/(mu lever): A/B = pade_fold(r) but for rounding
/// Source  README (R20): Taylor series, in long double. Their recurrence loses digits where a = r/(2 - r) is large.
constexpr double largest_pade_r = 1.75;
std::vector<StopTimePanels::Panel> pade_panels(long double r, long double fold, const PanelScales& scales);
/// A/B.
long double pade_fold(long double r);

/// The same for any law and r, on four sheets.
///
/// Source   README (R19): collocation on panel after panel, away from the k that every motion tends to.
/// Assumes  as terminal_ratio; 1/(mu lever) is 1 but for rounding
std::vector<StopTimePanels::Panel> law_panels(const Law& law, double r, const PanelScales& scales);

}  // namespace contensou::reduction
