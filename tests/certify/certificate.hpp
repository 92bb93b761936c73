#pragma once

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// Returns a proved bound of the error of a stop time under the Pade law, in units in the last place of the true value.
/// The closed form (R45) is evaluated in ball arithmetic, in which every term is enclosed. The doubles of the input
/// count as exact numbers.
///
/// @param tau   stop time to be judged; infinity counts as 2^1024
/// @param more  added to tau, for a stop time that is known to more digits than a double has
/// @throws std::domain_error  if start is not a state (finite, v >= 0), or the law is not pade
double certify_stop_time(const ReducedSystem& system, State start, double tau, double more = 0);

/// Returns the error of a computed m(k), the sliding coefficient of the Pade law, in units in the last place.
/// @param r, k  positive and finite; not checked
double certify_sliding_share(double r, double k, double m);

/// The errors of a computed Resistance compared with the exact Hertz law, in units in the last place.
struct ResistanceError {
  double force_ulp;
  double moment_ulp;
};

/// Judges a value of the exact law at sliding k and pivoting 1, k > 0 and finite, by Zh98 (1.3) up to k = 1, and beyond
/// by
///   Phi = 2F1(-1/2, 1/2; 5/2; 1/k^2),  Psi = 2F1(1/2, 1/2; 7/2; 1/k^2)/(5 k).
/// @throws std::domain_error  for any other k
ResistanceError certify_hertz_law(double k, Resistance computed);

}  // namespace contensou::reduction
