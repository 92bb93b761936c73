#pragma once

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// Canonical coordinates of the similarity group (u, v) -> (c u, c v): it moves p alone, p -> p + ln c.
struct Canonical {
  double q;  ///< v/u = mu k; carries the sign of u
  double p;  ///< ln v
};

/// @throws std::domain_error  if u = 0 or v <= 0: the axes are invariant and have no canonical coordinates
Canonical to_canonical(State state);

/// @throws std::domain_error  if q = 0 or a coordinate is not finite
State from_canonical(Canonical point);

/// dp/dq = Phi/(q D) of the separated equation (README (R2)): p is absent, so it is solved by one quadrature.
/// Pade, ball: 7 (16 mu + 15 pi q)/(q (mu A + B q)), A = 8 (14 - 5 mu^2), B = 15 pi (7 - mu^2).
/// @throws std::domain_error  if q = 0 or not finite
double separated_slope(const ReducedSystem& system, double q);

}  // namespace contensou::reduction
