#pragma once

#include "contensou/reduction/motion.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The regularised system (2.7) with the time map (2.8), for any law with the same weight, in the variables
/// (ln u, ln v, tau) and the independent variable beta: Dormand-Prince 5(4) with dense output.
///
/// In (u, v) the system is as stiff as (2.6); in logarithms it is not. Steps end at k = 1, where the exact law is only
/// twice differentiable. The stop lies at beta = infinity: once k < 1e-17 (or the rest is negligible) the tail is
/// closed with its exact limit. On an axis, and where pivoting takes less than 1e-18 of the time, the limit closes it
/// at once.
///
/// @param times  instants to report, tau >= 0, in increasing order; empty: every accepted step, the tail, the stop
/// @throws std::domain_error  if start is not a state or times are negative or decrease
///
/// Accuracy  stop time 1e-11 relative at the default tolerance; states 1e-10.
Motion integrate_regularised(const ReducedSystem& system, State start, const Eigen::ArrayXd& times = {},
                             const StepperSettings& stepping = {});

}  // namespace contensou::reduction
