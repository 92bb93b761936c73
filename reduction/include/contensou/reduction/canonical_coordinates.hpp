#pragma once

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// Canonical coordinates of the similarity group (u, v) -> (c u, c v). The group keeps q and maps p to p + ln c.
struct Canonical {  ///< v/u = mu k; has the sign of u
  double q;         ///< v/u = mu k; carries the sign of u
  double p;         ///< ln v
};

/// Returns the canonical coordinates of a state.
/// @throws std::domain_error  if u = 0 or v <= 0: the axes are invariant and have no canonical coordinates
Canonical to_canonical(State state);

/// Returns the state with these canonical coordinates.
/// @throws std::domain_error  if q = 0 or a coordinate is not finite
State from_canonical(Canonical point);

/// Returns dp/dq = Phi/(q D), the right side of the separated equation (README (R2)). It does not contain p, so one
/// quadrature solves the equation. For a ball under the Pade law it is 7 (16 mu + 15 pi q)/(q (mu A + B q)) with A = 8
/// (14 - 5 mu^2), B = 15 pi (7 - mu^2).
/// @throws std::domain_error  if q = 0 or not finite
double separated_slope(const ReducedSystem& system, double q);

}  // namespace contensou::reduction
