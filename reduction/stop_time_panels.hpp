#pragma once

#include <vector>

#include "contensou/reduction/friction_law.hpp"
#include "stop_time_kernel.hpp"

namespace contensou::reduction {

/// The panels of g of README (R18) for the Pade law and r up to this, on one sheet with fold = A/B = pade_fold(r).
///
/// Source  README (R20): Taylor series, in long double. Their recurrence loses digits where a = r/(2 - r) is large.
constexpr double largest_pade_r = 1.75;
std::vector<StopTimePanels::Panel> pade_panels(long double r, long double pivoting_moment);
/// A/B.
long double pade_fold(long double r);

/// The panels of g for any law and r, on four sheets.
///
/// Source   README (R19): collocation on panel after panel, away from the k that every motion tends to.
/// Assumes  as terminal_ratio
std::vector<StopTimePanels::Panel> law_panels(const Law& law, double r);

}  // namespace contensou::reduction
