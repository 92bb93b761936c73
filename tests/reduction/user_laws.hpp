#pragma once

#include <cmath>
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
