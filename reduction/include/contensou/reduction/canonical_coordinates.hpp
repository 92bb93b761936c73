#pragma once

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// Returns dp/dq = Phi/(q D), the right side of the separated equation (README (R2)) in the canonical coordinates
/// q = v/u = mu k and p = ln v. The group (u, v) -> (c u, c v) keeps q and moves p by ln c. It does not contain p, so
/// one quadrature solves the equation. For a ball under the Pade law it is 7 (16 mu + 15 pi q)/(q (mu A + B q)) with A
/// = 8 (14 - 5 mu^2), B = 15 pi (7 - mu^2).
/// @throws std::domain_error  if q = 0 or not finite
double separated_slope(const ReducedSystem& system, double q);

}  // namespace contensou::reduction
