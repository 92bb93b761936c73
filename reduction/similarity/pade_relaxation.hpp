#pragma once

namespace contensou::reduction {

/// A function of the ratio k under the Pade law that is a hypergeometric function: m of README (R4) or o of (R31).
///
///   value = end + (begin - end) G,   G = 2F1(1, q; 1 + 1/p; -T/p)
struct PadeRelaxation {
  double begin;       ///< value at T = 0
  double end;         ///< value at T = infinity
  double p;           ///< lambda > 0
  double q;           ///< Q, 1 to 3/2
  double excess;      ///< 1 - p q >= 0, accurate to its own last digit
  double T;           ///< p zeta >= 0, with zeta of (R28)
  double connection;  ///< [lnGamma(P) + lnGamma(1 - d) - lnGamma(P - d)]/d - ln P of (R30),  P = 1/p, d = q - 1
};

/// Returns the value.
///
/// Source    README (R29) to (R30).
/// Accuracy  5 ulp.
double value(const PadeRelaxation& at);

/// Returns expm1(d t)/d; t at d = 0.
double expm1_over(double d, double t);

}  // namespace contensou::reduction
