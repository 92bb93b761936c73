#pragma once

#include "contensou/reduction/motion.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// Integrates the regularised equations (2.7) and the time map (2.8) over beta. The variables are ln u, ln v and tau,
/// the method is Dormand and Prince 5(4) with dense output, the weight is ReducedSystem::regularising_weight.
///
/// In (u, v) the equations are as stiff as (2.6), the equations in time; in logarithms they are not. Steps end at k =
/// 1, where the exact law has only two derivatives. The stop lies at beta = infinity. Below k = 1e-17, or if the time
/// left is negligible, one exact formula (the tail) replaces the remaining steps. The tail also replaces all steps on
/// an axis, and if pivoting takes less than 1e-18 of the time.
///
/// @param times  times tau to report, >= 0, increasing; if empty, the result contains every step, the tail and the stop
/// @throws std::domain_error  if start is not a state, or if times are negative or decrease
///
/// Accuracy  stop time 1e-11 relative at the default tolerance; states 1e-10.
Motion integrate_regularised(const ReducedSystem& system, State start, const Eigen::ArrayXd& times = {},
                             const StepperSettings& stepping = {});

}  // namespace contensou::reduction
