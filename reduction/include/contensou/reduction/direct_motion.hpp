#pragma once

#include "contensou/reduction/motion.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The system (2.6) itself, in the variables (ln u, ln v) and the independent variable tau: Fehlberg 7(8).
///
/// In (u, v) any explicit stepper runs through the stop into v < 0 and costs like 1/mu^2; logarithms cannot cross it.
/// Steps end at the law's kinks and at the instants asked for. Near the stop steps shrink in proportion to the time
/// left, and the tail is closed with its exact limit once k < 1e-17 (or the rest is negligible). On an axis, and where
/// pivoting takes less than 1e-18 of the time, the limit closes it at once.
///
/// @param times  instants to report, tau >= 0, in increasing order; empty: every accepted step, the tail, the stop
/// @throws std::domain_error  if start is not a state or times are negative or decrease
///
/// Accuracy  stop time 3e-11 relative at the default tolerance; states 1e-10 for mu <= 1, 3e-10 up to r = 2.
Motion integrate_directly(const ReducedSystem& system, State start, const Eigen::ArrayXd& times = {},
                          const StepperSettings& stepping = {});

}  // namespace contensou::reduction
