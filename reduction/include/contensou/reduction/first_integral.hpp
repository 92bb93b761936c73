#pragma once

#include "contensou/reduction/reduced_system.hpp"
#include "contensou/reduction/similarity_solution.hpp"

namespace contensou::reduction {

/// The first integral of (2.6) and (2.7), as its logarithm: ln |u| - ln w(k) of the similarity curve. Constant along
/// every orbit, different on different ones, and shifted by ln c under (u, v) -> (c u, c v).
///
/// For the Pade law it is ln [ |u| k^(-a) (A + B k)^b ] up to a constant (README (R8)).
///
/// @param solution  the similarity solution of the system's law and r; the constant is its own on either side of a ray
/// @throws std::domain_error  on the axes u = 0 and v = 0, where it has no value
///
/// Accuracy  absolute, a few eps of |ln u| and of the curve's |ln w|.
double log_first_integral(const ReducedSystem& system, const SimilaritySolution& solution, State state);

}  // namespace contensou::reduction
