// Elementary orbit of the exact law for k <= 1, numerics.md (R46). s = k^2; s+ > 1 and s- < 0 are zeros of Phi - r k
// Psi:
//   Phi - r k Psi = (3 pi k/128) [4 (4 - s) - r (8 - 8 s + 3 s^2)] = (3 pi k/128) 3 r (s+ - s)(s - s-)
//   w = const s^(a/2) (1 - s/s+)^(e+) (1 - s/s-)^(e-),   a = r/(2 - r),   e+, e-: exponents by partial fractions
#include "check/hertz_inner_orbit.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::reduction {

double hertz_inner_ln_w(double r, double k) {
  if (!(r > 0 && r < 2 && k > 0 && k <= 1)) {
    throw std::domain_error(
        fmt::format("hertz_inner_ln_w: 0 < r < 2 and 0 < k <= 1 required, got r = {}, k = {}", r, k));
  }
  const double root = std::sqrt(1 + r * (8 - 2 * r));
  // The printed formulas for s+ and s- cancel for small r. s+ follows from s+ s-, and s- from a sum of equal signs.
  const double outer = 4 * (2 - r) / (1 - 2 * r + root);      // s+ > 1
  const double negative = -2 * (1 - 2 * r + root) / (3 * r);  // s-
  const double distance = 4 * root / (3 * r);                 // s+ - s-
  // The numerator 4 - s+ of e+ cancels, because s+ -> 4 as r -> 0. It is replaced by r (8 - 8 s + 3 s^2)/4 at s = s+.
  const double outer_exponent = -(8 - 8 * outer + 3 * outer * outer) / (6 * outer * distance);
  const double negative_exponent = 2 * (4 - negative) / (3 * r * negative * distance);

  const double s = k * k;
  return r / (2 - r) * std::log(k) + outer_exponent * std::log1p(-s / outer) +
         negative_exponent * std::log1p(-s / negative);
}

}  // namespace contensou::reduction
