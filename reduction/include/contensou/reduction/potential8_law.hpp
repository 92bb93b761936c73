#pragma once

#include <string_view>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// The gradient of a dissipation potential R that is the eighth root of a polynomial: simple as the Pade pair, but
/// with both ends of the Hertz law, its potential, and within 3.41 % of it.
///
/// Source    R^8 = k^8 + 0.8 k^6 + 0.321466 k^4 + 8 R0^8 k^2 + R0^8, R0 = 3 pi/16; made homogeneous in the speeds
///           (v, w), Phi = dR/dv and Psi = dR/dw are sums of positive terms.
/// Accuracy  4 eps relative for every k (tests/reference/laws_pressure.csv).
/// Symmetry  degree 0: unchanged, bit for bit, when both speeds are scaled by a power of two.
///
/// It is no patch under Coulomb friction, but R is convex, and so the curve (Phi, Psi) bounds a convex set that holds
/// both its ends: Phi + Psi/Psi(0) >= 1 as for a patch, and the same bounds of the stop time.
struct Potential8Law {
  static constexpr std::string_view name = "potential8";
  static constexpr SlidingBounds sliding_bounds{0, 1};

  /// @throws std::domain_error  for a slip that no law can answer (require_slip)
  Resistance operator()(Slip slip) const;

  /// 1 - Psi/Psi(0), without cancellation for k << 1.
  double moment_deficit(Slip slip) const;
};

}  // namespace contensou::reduction
