#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/slip.hpp"

namespace contensou::tests {

/// The two homogeneous terms of one rational power: Phi = k/sqrt(c^2 + k^2), Psi = c^2/sqrt(c^2 + k^2).
/// One function and nothing else, as a user would write it.
struct RootLaw {
  double c = 0.8;

  reduction::Resistance operator()(reduction::Slip slip) const {
    const double size = std::hypot(c * slip.pivoting, slip.sliding);
    return {slip.sliding / size, c * c * slip.pivoting / size};
  }
};

/// A law from a dissipation potential R(sliding, pivoting), homogeneous of degree 1: Phi and Psi are its gradient.
/// R^8 = k^8 + 0.8 k^6 + 0.321466 k^4 + 8 R0^8 k^2 + R0^8, R0 = 3 pi/16, stays within 3.41 % of the exact law.
struct OcticLaw {
  reduction::Resistance operator()(reduction::Slip slip) const {
    const double larger = std::max(slip.sliding, slip.pivoting);
    const double x = slip.sliding / larger;
    const double y = slip.pivoting / larger;
    const double s = x * x;
    const double p = y * y;
    const double c = std::pow(3 * std::numbers::pi / 16, 8);
    const double octic =
        s * s * s * s + 0.8 * s * s * s * p + 0.321466 * s * s * p * p + 8 * c * s * p * p * p + c * p * p * p * p;
    const double slope = 8 * std::pow(octic, 7.0 / 8);
    return {x * (8 * s * s * s + 4.8 * s * s * p + 4 * 0.321466 * s * p * p + 16 * c * p * p * p) / slope,
            y * (1.6 * s * s * s + 4 * 0.321466 * s * s * p + 48 * c * s * p * p + 8 * c * p * p * p) / slope};
  }
};

/// The exact law by the name of the other: a law is known by its type.
struct Impostor : reduction::HertzLaw {
  static constexpr std::string_view name = "pade";
};

/// Only the call of another law: what is left when its closed form, its bounds and its deficit are hidden.
template <class L>
struct CallOnly {
  L law{};

  reduction::Resistance operator()(reduction::Slip slip) const { return law(slip); }
};

}  // namespace contensou::tests
