#pragma once

#include <cstddef>
#include <functional>

#include "contensou/reduction/flow.hpp"
#include "motion/stop_time_loop.hpp"

namespace contensou::reduction {

/// Returns the sliding coefficient m of README (R4) at k.
double sliding_coefficient(const Flow& flow, double k);

/// Returns k at the fraction x in [0, 1] of the width of a panel.
double ratio_in_panel(std::size_t panel, double x);

/// Returns the least-squares polynomial of a function of k on a panel.
StopTimePanels::Panel fitted_panel(std::size_t panel, const std::function<double(double k)>& function);

}  // namespace contensou::reduction
