#pragma once

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The stop time under the Pade law, as a plain function: for a patch ratio that changes from call to call. Nothing is
/// allocated or prepared.
///
/// @param mu  patch radius/R, > 0
/// @return    the paper's time; infinity where it exceeds the largest double, 0 at rest
/// @throws std::domain_error  if mu, chi or gamma is not a positive finite number, or start is not a state (finite,
///                            v >= 0)
///
/// Source    README (R4) with (R27) to (R30).
/// Accuracy  4 ulp for 1e-10 <= mu <= 3 and every start, rounding_of_stop_time(r) for every mu (tests/certify).
double pade_stop_time(double mu, State start, Inertia inertia = homogeneous_ball);

}  // namespace contensou::reduction
