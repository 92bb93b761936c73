// Notation (README (R28) to (R30)), with p = lambda and q = Q:
//   G = 1/(1 + X), X = a_1/(b_1 + a_2/(b_2 + ...)), b_n = 1 + n p                    (R29)
//   eta = 1/(p + T), y = p eta, d = q - 1                                             (R30)
#include "similarity/pade_relaxation.hpp"

#include <algorithm>
#include <cmath>

namespace contensou::reduction {

namespace {

/// Returns the number of pairs of (R29) by the faster of two rates of convergence. The error of m is then below eps/8.
int pairs_of_fraction(double p, double T) {
  // The first rate is tabulated for T/p < 3.
  if (T < 0.015625 * p) return 4;
  if (T < 0.125 * p) return 6;
  if (T < 0.5 * p) return 8;
  if (T < p) return 11;
  if (T < 2 * p) return 14;
  if (T < 3 * p) return 17;
  const double by_distance = 18.4 / std::asinh(std::sqrt(p / T));
  const double by_scale = 12 + 172 * T;
  return 1 + static_cast<int>(std::min(by_distance, by_scale) / 2);
}

/// Evaluates the continued fraction (R29) from a depth below which the rest is negligible. Only one division is needed,
/// because the fraction from depth n on is N_n/N_(n+1). All terms are positive, so nothing cancels.
double by_fraction(const PadeRelaxation& at) {
  const int pairs = pairs_of_fraction(at.p, at.T);
  // If all b_n get a factor and all a_n its square, the fraction is the same. The factor keeps N_n from overflowing.
  const double b = 1 + 2 * pairs * at.p;
  const double a = (at.q + pairs) * (1 + pairs * at.p) * at.T;
  const double unit = pairs > 17 || at.p > 1 ? 1 / std::sqrt(b * b + a) : 1;
  const double p = unit * at.p;
  const double T = unit * at.T;
  const double excess = unit * at.excess;
  double above = 1;                          // N_(n+1)
  double here = unit + (2 * pairs + 2) * p;  // N_n
  for (double j = pairs; j > 0; --j) {
    const double odd = (unit + (2 * j + 1) * p) * here + (j + 1) * (excess + (j + 1) * p) * T * above;
    here = (unit + 2 * j * p) * odd + (at.q + j) * (unit + j * p) * T * here;
    above = odd;
  }
  const double first = (unit + p) * here + (excess + p) * T * above;
  const double second = at.q * T * here;
  // Start at the nearer of begin and end, so that only the small correction is rounded.
  return second < first ? at.begin + (at.end - at.begin) * (second / (first + second))
                        : at.end + (at.begin - at.end) * (first / (first + second));
}

/// Evaluates the series (R30) in y. Two of its terms, which are infinite at Q = 1, are combined.
double by_series(const PadeRelaxation& at) {
  const auto& [begin, end, p, q, excess, T, connection] = at;
  const double eta = 1 / (p + T);
  if (eta == 0) return end;
  const double y = p * eta;
  const double d = q - 1;
  const double L = std::log(eta) + connection;
  // If d L is not small, the power is more accurate than the logarithm by a digit, and its exponent q more than d.
  const double W =
      std::abs(d * L) < 0.5 ? expm1_over(d, L) : (std::pow(eta, q) / eta * std::exp(d * connection) - 1) / d;
  double sum = 0;
  double D = 0;
  double e = 1;
  for (int j = 0; std::abs(D) + e * (1 + std::abs(W)) > 1e-18 * std::abs(sum); ++j) {
    sum += D - e * W;
    const double inverse = 1 / ((1 - d + j) * (1 + j));
    D = (D * (eta + (j - d) * y) * (1 + j) + e * (eta - y)) * inverse;
    e *= (eta + j * y) / (1 + j);
  }
  return end + (begin - end) * eta * sum;
}

}  // namespace

double expm1_over(double d, double t) { return std::abs(d * t) < 1e-17 ? t : std::expm1(d * t) / d; }

double value(const PadeRelaxation& at) {
  if (at.T == 0) return at.begin;
  return at.T < 3 * at.p || at.p + at.T < 1.5 ? by_fraction(at) : by_series(at);
}

}  // namespace contensou::reduction
