#pragma once

namespace contensou::reduction {

/// A quantity of the Pade law that is one hypergeometric function of the ratio k: m of README (R4), n of (R13).
///
///   value = end + (begin - end) G,   G = 2F1(1, q; 1 + 1/p; -T/p)
struct PadeRelaxation {
  double begin;   ///< value at T = 0
  double end;     ///< value at T = infinity
  double p;       ///< lambda >= 0; 0 is a limit like any other
  double q;       ///< Q > 0
  double excess;  ///< 1 - p q >= 0, to its own last digit
  double T;       ///< p zeta >= 0, with zeta of (R28)
};

/// Its value.
///
/// Source    README (R29) to (R30).
/// Accuracy  that of pade_sliding_coefficient.
double value(const PadeRelaxation& at);

/// The same where the caller knows the constant of the logarithm in (R30), which value() takes some 200 ns to find.
/// @param connection  [lnGamma(P) + lnGamma(1 - d) - lnGamma(P - d)]/d - ln P,  d = q - 1; needs q <= 3/2
double value(const PadeRelaxation& at, double connection);

/// expm1(d t)/d, also at d = 0.
double expm1_over(double d, double t);

}  // namespace contensou::reduction
