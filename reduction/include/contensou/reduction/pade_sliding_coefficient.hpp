#pragma once

namespace contensou::reduction {

/// m(k) of README (R4) for the Pade law and every r: the time left is  P + m S, S that of pure sliding, P that of pure
/// pivoting. 5/2 at k = 0, 1 at k = infinity.
///
/// One smooth function through r = 2 and r = 5, where the exponents of the orbit are infinite, and through the ratio
/// k* = -A/B, where its formulas change over. No allocation, no table.
///
/// @param r  gamma mu^2/chi, > 0 and finite; not checked
/// @param k  v/(mu |u|), 0 to infinity; not checked
///
/// Source    README (R27) to (R30).
/// Accuracy  5 ulp for the r and k given while r <= 10 (a ball: mu <= 3.7), 7 ulp up to r = 1e4 (tests/certify).
double pade_sliding_coefficient(double r, double k);

}  // namespace contensou::reduction
