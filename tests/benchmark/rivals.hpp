#pragma once

#include <string>
#include <vector>

namespace contensou::rivals {

/// A stop time of a ball under the Pade law, computed by another program.
struct RivalResult {
  double tau;
  long evaluations;  ///< evaluations of the right side of (2.6); 0 for a closed form
};

/// A program that computes stop times by a library, as a careful user would write it.
struct Rival {
  std::string name;
  RivalResult (*stop_time)(double mu, double u0, double v0);
};

/// Steppers of (2.6) of V. F. Zhuravlev, 1998, as printed; tolerances 1e-12 relative, 1e-14 of the speeds at the start.
/// Steps beyond the stop are halved until |u| is 1e-8 of its start. Then the time of a linear fall to 0 is added.
std::vector<Rival> all();

/// Versions of the libraries.
std::string versions();

}  // namespace contensou::rivals
