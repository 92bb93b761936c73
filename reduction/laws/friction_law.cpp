#include "contensou/reduction/friction_law.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::reduction {

void Law::Function::read_limits() {
  pivoting_moment = resistance({0, 1}).moment;
  const double pure_sliding = resistance({1, 0}).force;
  // Two slow slips tell a slope from a jump (Coulomb's Phi(0+) = 1) and from a root.
  constexpr double slow = 0x1p-60;
  constexpr double slower = 0x1p-80;
  force_slope = resistance({slow, 1}).force / slow;
  const double same_slope = resistance({slower, 1}).force / slower;

  if (!(pivoting_moment > 0) || !std::isfinite(pivoting_moment)) {
    throw std::domain_error(fmt::format("Law {}: Psi(0) must be positive and finite, got {}", name, pivoting_moment));
  }
  if (!(std::abs(pure_sliding - 1) <= 1e-14)) {
    throw std::domain_error(fmt::format("Law {}: Phi must be 1 in pure sliding, got {}", name, pure_sliding));
  }
  if (!(force_slope > 0) || !(std::abs(same_slope - force_slope) <= 1e-6 * force_slope)) {
    throw std::domain_error(fmt::format(
        "Law {}: Phi must grow in proportion to k for slow sliding, but Phi/k is {} at k = 2^-60 and {} at k = 2^-80",
        name, force_slope, same_slope));
  }
}

}  // namespace contensou::reduction
