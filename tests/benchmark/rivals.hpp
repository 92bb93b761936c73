#pragma once

#include <string>
#include <vector>

namespace contensou::rivals {

/// A stop time of the Pade ball by somebody else's program.
struct RivalResult {
  double tau;
  long evaluations;  ///< of the right side of (2.6); 0 for a closed form
};

/// What a careful user of a library would write.
struct Rival {
  std::string name;
  RivalResult (*stop_time)(double mu, double u0, double v0);
};

/// Steppers on (2.6) as printed, at 1e-12 relative and 1e-14 of the start absolute, steps that overshoot the stop
/// halved until |u| is 1e-8 of its start and the linear rest added.
std::vector<Rival> all();

/// Versions of the libraries.
std::string versions();

}  // namespace contensou::rivals
