#pragma once

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// What ball arithmetic proves that a stop time misses the true one by, in units of the last place of a double of the
/// true size: the closed form (R28) of the Pade law, every term enclosed, the inputs taken as the exact numbers that
/// the doubles are.
///
/// @param tau   the stop time to judge; infinity counts as 2^1024
/// @param more  is added to tau, for one that is known to more digits than a double has
/// @throws std::domain_error  if start is not a state (finite, v >= 0), or the law is not pade
double certify_stop_time(const ReducedSystem& system, State start, double tau, double more = 0);

/// What a computed m(k) of the Pade law misses the exact one for these r and k by, in units of the last place.
/// @param r, k  positive and finite; not checked
double certify_sliding_share(double r, double k, double m);

/// What a computed Resistance misses the exact Hertz law by, in units of the last place.
struct ResistanceError {
  double force_ulp;
  double moment_ulp;
};

/// Judges a value of the exact law at sliding k over pivoting 1, k > 0 and finite: Zh98 (1.3) up to k = 1, beyond
///   Phi = 2F1(-1/2, 1/2; 5/2; 1/k^2),  Psi = 2F1(1/2, 1/2; 7/2; 1/k^2)/(5 k).
/// @throws std::domain_error  for any other k
ResistanceError certify_hertz_law(double k, Resistance computed);

}  // namespace contensou::reduction
