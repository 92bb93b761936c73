#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::tests {

/// A law for which Phi/(k Psi) has a minimum, 1.9909 at k = 0.144. For r between this minimum and 2 there are two rays,
/// of which the first repels. The law is the gradient of a convex potential R, with R^8 = k^8 + 0.8 k^6 + 0.321466 k^4
/// + 8 R0^8 k^2 + R0^8 and R0 = 3 pi/16. Therefore the stop times have the bounds of Coulomb friction.
struct OcticLaw {
  static constexpr std::string_view name = "octic";
  static constexpr reduction::SlidingBounds sliding_bounds{0, 1};

  reduction::Resistance operator()(reduction::Slip slip) const {
    reduction::require_slip("OcticLaw", slip);
    const double least = 3 * std::numbers::pi / 16, c = std::pow(least, 8);
    const double size = std::max(slip.sliding, slip.pivoting);
    const double v = slip.sliding / size, w = slip.pivoting / size, x = v * v, y = w * w;
    const double octic = ((x + 0.8 * y) * x + 0.321466 * y * y) * x * x + (8 * x + y) * c * y * y * y;
    const double slope = std::pow(octic, 0.125) / octic;
    return {v * slope * (((x + 0.6 * y) * x + 0.160733 * y * y) * x + 2 * c * y * y * y),
            w * slope * ((0.2 * x + 0.160733 * y) * x * x + (6 * x + y) * c * y * y)};
  }
};

}  // namespace contensou::tests
