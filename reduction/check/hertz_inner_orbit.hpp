#pragma once

namespace contensou::reduction {

/// ln w along an orbit of the exact (Hertz) law where it is elementary, 0 < k <= 1, up to a constant: README (R12).
///
/// An independent spelling of SimilarityCurve::ln_w: differences between two k agree with it.
///
/// @param r  gamma mu^2/chi, 0 < r < 2
/// @param k  v/(mu |u|), 0 < k <= 1
/// @throws std::domain_error  outside these ranges
///
/// Accuracy  4 eps (|ln w| + r); the roots are taken in the form that keeps its digits as r -> 0.
double hertz_inner_ln_w(double r, double k);

}  // namespace contensou::reduction
