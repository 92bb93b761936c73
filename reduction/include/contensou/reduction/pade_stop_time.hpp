#pragma once

#include <span>

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
/// Accuracy  4 ulp for 1e-10 <= mu <= 3 and every start (tests/reference/README.md).
double pade_stop_time(double mu, State start, Inertia inertia = homogeneous_ball);

/// The same for arrays, mu of its own for each start: several at a time.
///
/// @param tau  as many as there are starts; may be one of the inputs, but must not overlap them otherwise. A start or
/// mu
///             that pade_stop_time rejects becomes NaN
/// @throws std::domain_error  if the four sizes differ, or if chi or gamma is not a positive finite number
///
/// Accuracy  4 ulp, as pade_stop_time; not always the same bits.
void pade_stop_times(std::span<const double> mu, std::span<const double> u0, std::span<const double> v0,
                     std::span<double> tau, Inertia inertia = homogeneous_ball);

}  // namespace contensou::reduction
