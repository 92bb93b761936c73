#pragma once

#include <cstddef>
#include <functional>

#include "contensou/reduction/flow.hpp"
#include "motion/stop_time_loop.hpp"

namespace contensou::reduction {

/// m of README (R4) at k.
double sliding_coefficient(const Flow& flow, double k);

/// k at x in [0, 1] of the way through a panel of StopTimePanels.
double ratio_in_panel(std::size_t panel, double x);

/// The panel's polynomial of a function of k, by least squares.
StopTimePanels::Panel fitted_panel(std::size_t panel, const std::function<double(double k)>& function);

}  // namespace contensou::reduction
