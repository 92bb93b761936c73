#pragma once

#include <string>

#include <Eigen/Core>

#include "contensou/reduction/orbit.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The end of an integration and its reason.
struct Outcome {
  enum class Kind { stopped, step_limit, not_finite };
  Kind kind = Kind::stopped;
  std::string sentence = "The body came to rest.";

  bool ok() const { return kind == Kind::stopped; }
};

/// The result of a stepper: the reported states, the stop time and the cost.
struct Motion {
  OrbitColumns points;
  double stop_time = 0;
  long steps = 0;
  long evaluations = 0;  ///< number of calls of the friction law
  Outcome outcome;
};

/// Settings of both steppers.
struct StepperSettings {
  double tolerance = 1e-14;  ///< bound of the local error of ln u, ln v and tau/(S + P), with S and P of theory.md (R5)
  long step_limit = 2'000'000;
};

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
