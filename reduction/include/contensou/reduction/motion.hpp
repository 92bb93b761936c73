#pragma once

#include <string>

#include <Eigen/Core>

#include "contensou/reduction/orbit_point.hpp"

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
  double tolerance = 1e-14;  ///< bound of the local error of ln u, ln v and tau/(S + P), with S and P of README (R18)
  long step_limit = 2'000'000;
};

}  // namespace contensou::reduction
