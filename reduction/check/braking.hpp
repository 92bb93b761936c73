#pragma once

#include <cmath>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The right sides of (R1) times the larger of w and v, by which they are still to be divided: so no quotient is by a
/// speed that vanishes.
///   -d ln w/ds = r of_spin/larger,   -d ln v/ds = of_slip/larger
struct Braking {
  double larger, of_spin, of_slip;
};

/// @param w, v  scaled speeds, > 0
/// @param k     v/w, a number
inline Braking braking(const ReducedSystem& system, double w, double v, double k) {
  const auto [force, moment] = system.law()(slip_of_ratio(k));
  const double net = force - system.drive();
  return k > 1 ? Braking{v, k * moment, net} : Braking{w, moment, net / k};
}

}  // namespace contensou::reduction
