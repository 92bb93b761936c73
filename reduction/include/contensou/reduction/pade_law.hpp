#pragma once

#include <string_view>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// The rational approximation to HertzLaw in V. F. Zhuravlev, 1998 (Zh98): Phi = 3 pi k/(8 + 3 pi k), Psi = 3 pi/(16 +
/// 15 pi k), k = sliding/pivoting.
///
/// The approximation has the Phi(0), Phi'(0), Phi(infinity), Psi(0) and lim k Psi of the exact law. The slope of Psi at
/// k = 0 is -1.735 instead of 0, and the slope of Phi in 1/k at infinity is -0.849 instead of 0. In between, the
/// approximation is lower by up to 39 % (Phi, k = 0.91) and 48 % (Psi, k = 0.54). It has no dissipation potential.
///
/// Source    Zh98 (1.4) for the force, (1.6) for the moment.
/// Accuracy  4 eps relative for every k (tests/reference/laws.csv).
/// Symmetry  degree 0: unchanged, bit for bit, when both speeds are scaled by a power of two.
struct PadeLaw {
  static constexpr std::string_view name = "pade";
  static constexpr SlidingBounds sliding_bounds{1, 2.5};

  /// Returns force and moment. Throws as require_slip.
  Resistance operator()(Slip slip) const;

  /// Returns 1 - Psi/Psi(0) = 15 pi k/(16 + 15 pi k).
  double moment_deficit(Slip slip) const;

  /// Returns 1 - Phi, without cancellation for k >> 1.
  double force_deficit(Slip slip) const;
};

}  // namespace contensou::reduction
