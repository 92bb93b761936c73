#pragma once

#include "contensou/reduction/motion.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// Integrates the system (2.6) in time, in the variables (ln u, ln v), by the method of Fehlberg 7(8).
///
/// In (u, v) an explicit stepper passes the stop into v < 0 and needs about 1/mu^2 steps. Logarithms cannot cross the
/// stop. Steps end at the law's kinks and at the times to report. Near the stop, steps shrink in proportion to the time
/// left. Below k = 1e-17, or when the rest is negligible, the exact limit replaces further steps. On an axis, and if
/// pivoting takes less than 1e-18 of the time, it replaces all steps.
///
/// @param times  times tau to report, >= 0, increasing; if empty, the result contains every step, the tail and the stop
/// @throws std::domain_error  if start is not a state or times are negative or decrease
///
/// Accuracy  stop time 3e-11 relative at the default tolerance; states 1e-10 for mu <= 1, 3e-10 up to r = 2.
Motion integrate_directly(const ReducedSystem& system, State start, const Eigen::ArrayXd& times = {},
                          const StepperSettings& stepping = {});

}  // namespace contensou::reduction
