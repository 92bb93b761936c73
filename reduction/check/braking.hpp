#pragma once

#include <cmath>

#include "contensou/reduction/reduced_system.hpp"
#include "system/balance.hpp"
#include "system/regularising_weight.hpp"

namespace contensou::reduction {

/// The right sides of (R1), multiplied by the larger of w and v, so that a speed that vanishes is never a divisor. One
/// division by `larger` remains:
///   -d ln w/ds = r of_spin/larger,   -d ln v/ds = of_slip/larger
struct Braking {
  double larger, of_spin, of_slip;
  double weight;  ///< dtau/dbeta of scaled speeds
};

/// Returns the right sides at scaled speeds, or NaN if the speeds are NaN, so that the run ends with its outcome.
inline Braking braking(const ReducedSystem& system, double ln_w, double ln_v) {
  const double w = std::exp(ln_w), v = std::exp(ln_v), k = std::exp(ln_v - ln_w);
  if (std::isnan(k)) return {k, k, k, k};
  const Balance balance = Balance::of(system.law(), system.r(), system.drive(), k);
  const double net = balance.force, moment = balance.moment, weight = regularising_weight(w, v);
  return k > 1 ? Braking{v, k * moment, net, weight} : Braking{w, moment, net / k, weight};
}

}  // namespace contensou::reduction
