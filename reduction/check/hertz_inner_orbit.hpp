#pragma once

namespace contensou::reduction {

/// Returns ln w along an orbit of the exact law for 0 < k <= 1, up to a constant, by elementary functions,
/// numerics.md (R46).
///
/// The formula is independent of SimilarityCurve::ln_w. The constants differ, so compare differences between two k.
///
/// @param r  gamma mu^2/chi, 0 < r < 2
/// @param k  v/(mu |u|), 0 < k <= 1
/// @throws std::domain_error  if r or k is outside its range
///
/// Accuracy  4 eps (|ln w| + r). The zeros of Phi - r k Psi in the formula keep their digits as r -> 0.
double hertz_inner_ln_w(double r, double k);

}  // namespace contensou::reduction
