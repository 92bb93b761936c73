#pragma once

#include <cmath>

#include "contensou/reduction/reduced_system.hpp"
#include "system/balance.hpp"

namespace contensou::reduction {

/// The right sides of the equations of motion, README (R1), times the larger of w and v, so that no divisor vanishes.
/// Only one division, by `larger`, remains:
///   -d ln w/ds = r of_spin/larger,   -d ln v/ds = of_slip/larger
struct Braking {
  double larger, of_spin, of_slip;
  double weight;  ///< dtau/dbeta of (2.8) at these speeds w and v
};

/// Returns the right sides at scaled speeds. If v/w is NaN, all numbers are NaN, and the stepper ends as not_finite.
inline Braking braking(const ReducedSystem& system, double ln_w, double ln_v) {
  const double w = std::exp(ln_w), v = std::exp(ln_v), k = std::exp(ln_v - ln_w);
  if (std::isnan(k)) return {k, k, k, k};
  const Balance balance = Balance::of(system.law(), system.r(), system.drive(), k);
  const double net = balance.force, moment = balance.moment, weight = regularising_weight(w, v);
  return k > 1 ? Braking{v, k * moment, net, weight} : Braking{w, moment, net / k, weight};
}

}  // namespace contensou::reduction
