#pragma once

#include <string>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// A number that a route computed, beside the truth.
struct Certificate {
  std::string lower;  ///< decimals that enclose the true stop time, 25 digits or more
  std::string upper;
  double error_ulp;  ///< |computed - true| in units of the last place of a double of the true size
};

/// What ball arithmetic proves of a stop time that a route computed: the closed form (R28) of the Pade law, every term
/// enclosed, the inputs taken as the exact numbers that the doubles are.
///
/// In the library contensou_certify, which is built where Arb is found.
///
/// @param tau  the stop time to judge; infinity counts as 2^1024
/// @throws std::domain_error  if start is not a state (finite, v >= 0), or the law is not pade
Certificate certify_stop_time(const ReducedSystem& system, State start, double tau);

}  // namespace contensou::reduction
