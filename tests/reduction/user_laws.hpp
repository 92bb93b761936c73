#pragma once

#include <cmath>
#include <string_view>

#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/laws.hpp"

namespace contensou::tests {

/// The simplest law of a user, a single function: Phi = k/sqrt(c^2 + k^2), Psi = c^2/sqrt(c^2 + k^2).
struct RootLaw {
  double c = 0.8;

  reduction::Resistance operator()(reduction::Slip slip) const {
    const double size = std::hypot(c * slip.pivoting, slip.sliding);
    return {slip.sliding / size, c * c * slip.pivoting / size};
  }
};

/// The exact law with the name of the Pade law. The library identifies laws by their type.
struct Impostor : reduction::HertzLaw {
  static constexpr std::string_view name = "pade";
};

/// A law that has only the call operator of another law. Its closed form, bounds and deficits are hidden.
template <class L>
struct CallOnly {
  L law{};

  reduction::Resistance operator()(reduction::Slip slip) const { return law(slip); }
};

}  // namespace contensou::tests
