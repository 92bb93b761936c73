#pragma once

#include <string_view>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// Exact Coulomb friction of a circular patch that slides and pivots, under Hertz's pressure; k = sliding/pivoting.
///
/// Source    V. F. Zhuravlev, 1998 (Zh98): the closed forms (1.3) of the force and (1.5) of the moment, for k < 1.25,
///           with the angle asin(1/k) by atan2. For larger k, the 2F1 series in 1/k^2: the printed (1.5) loses
///           all digits by k = 1e4, because its terms cancel to 1/k^4 of their size.
/// Accuracy  4 eps relative for every k (tests/reference/laws.csv).
/// Symmetry  degree 0: unchanged, bit for bit, when both speeds are scaled by a power of two.
struct HertzLaw {
  static constexpr std::string_view name = "exact";
  static constexpr SlidingBounds sliding_bounds{0, 1};

  /// Returns force and moment. Throws as require_slip.
  Resistance operator()(Slip slip) const;

  /// Returns 1 - Psi/Psi(0), without cancellation for k <= 1.
  double moment_deficit(Slip slip) const;

  /// Returns 1 - Phi, without cancellation for k >> 1.
  double force_deficit(Slip slip) const;
};

}  // namespace contensou::reduction
