#pragma once

#include "contensou/reduction/motion.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// Integrates the equations of motion (2.6) of ReducedSystem in time, in ln u and ln v, by the method of Fehlberg 7(8).
///
/// An explicit stepper in (u, v) would step past the stop into v < 0 and would need about 1/mu^2 steps. Logarithms
/// cannot pass the stop. Steps end at the law's kinks and at the times to report. Near the stop, steps shrink like the
/// time left. Below k = v/(mu |u|) = 1e-17, or if the time left is negligible, one exact formula (the tail) replaces
/// the remaining steps. The tail replaces all steps on an axis, and if pivoting takes less than 1e-18 of the time.
///
/// @param times  times tau to report, >= 0, increasing; if empty, the result contains every step, the tail and the stop
/// @throws std::domain_error  if start is not a state, or if times are negative or decrease
///
/// Accuracy  stop time 3e-11 relative at the default tolerance; states 1e-10 for mu <= 1, 3e-10 for r = gamma mu^2/chi
///           up to 2.
Motion integrate_directly(const ReducedSystem& system, State start, const Eigen::ArrayXd& times = {},
                          const StepperSettings& stepping = {});

}  // namespace contensou::reduction
