#pragma once

#include <string>

#include <Eigen/Core>

#include "contensou/reduction/orbit_point.hpp"

namespace contensou::reduction {

/// How an integration ended.
struct Outcome {
  enum class Kind { stopped, step_limit, not_finite };
  Kind kind = Kind::stopped;
  std::string sentence = "The body came to rest.";

  bool ok() const { return kind == Kind::stopped; }
};

/// What a stepper returns: the states asked for, the stop time, and what it cost.
struct Motion {
  OrbitColumns points;
  double stop_time = 0;
  long steps = 0;
  long evaluations = 0;  ///< of the friction law
  Outcome outcome;
};

/// Settings of both steppers.
struct StepperSettings {
  double tolerance = 1e-14;  ///< local error of ln u, ln v and tau/(S + P), README (R18)
  long step_limit = 2'000'000;
};

}  // namespace contensou::reduction
