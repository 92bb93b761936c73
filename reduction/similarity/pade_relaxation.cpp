// Notation (README (R28) to (R30)): with p = lambda, q = Q and T
//   G = 1/(1 + X), X = a_1/(b_1 + a_2/(b_2 + ...)), b_n = 1 + n p                    (R29)
//   eta = 1/(p + T), y = p eta, N = max(1, round(q)), d = q - N                      (R30)
#include "similarity/pade_relaxation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <boost/math/special_functions/gamma.hpp>

namespace contensou::reduction {

namespace {

/// Pairs of (R29), by the slower of its two rates of convergence. What they leave out of m is less than eps/8 but where p
/// is next to 0, that is r next to 2 or 5: there it is 10 times as much at worst (T = 0.8), still within m's 5 ulp.
int pairs_of_fraction(double p, double T) {
  // The first rate for t up to a bound, the binary exponents of t in mind.
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

/// By the continued fraction (R29) from a depth at which the rest no longer counts, its divisions taken together:
/// what is left from a depth n on is N_n/N_(n+1). All terms are positive: nothing is lost.
double by_fraction(const PadeRelaxation& at) {
  const int pairs = pairs_of_fraction(at.p, at.T);
  // All b_n times this, all a_n times its square: the same fraction, and no N_n overflows.
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
  // From the nearer end: what is added to it alone carries rounding.
  return second < first ? at.begin + (at.end - at.begin) * (second / (first + second))
                        : at.end + (at.begin - at.end) * (first / (first + second));
}

/// lnGamma(1 - d)/d for d < 1.
double log_gamma_slope(double d) { return d == 0 ? std::numbers::egamma : std::log1p(boost::math::tgamma1pm1(-d)) / d; }

/// log1p(d t)/d, also at d = 0.
long double log1p_over(long double d, long double t) { return d * t == 0 ? t : std::log1p(d * t) / d; }

/// [lnGamma(P) - lnGamma(P - d)]/d - ln P for P = 1/p: by Stirling's series, once P is raised to 14 or more. In long
/// double, because what is raised comes off again.
double log_gamma_quotient(long double p, long double d) {
  long double raised = 0;  // [product of (1 - d/(P + i)) - 1]/d
  long double shift = 0;
  if (p > 1.0L / 14) {
    const long double P = 1 / p;
    const int steps = 1 + static_cast<int>(14 - P);
    for (int i = 0; i < steps; ++i) raised -= (1 + d * raised) / (P + i);
    shift = std::log1p(steps * p) + log1p_over(d, raised);
    p = 1 / (P + steps);
  }
  // lnGamma(x) = (x - 1/2) ln x - x + 1/(12 x) - 1/(360 x^3) + ... at P and at P - d = 1/s.
  const long double s = p / (1 - d * p);
  const long double leading = (1 - (d + 0.5L) * p) * log1p_over(-d * p, 1.0L) - 1;
  constexpr std::array<long double, 6> stirling{1.0L / 12,    -1.0L / 360, 1.0L / 1260,
                                                -1.0L / 1680, 1.0L / 1188, -691.0L / 360360};
  long double tail = 0;
  long double bracket = 1;  // p^(n-1) + p^(n-2) s + ... + s^(n-1) = -(p^n - s^n)/(d p s), n = 1, 3, 5, ...
  long double power = p;
  for (long double coefficient : stirling) {
    tail -= coefficient * p * s * bracket;
    bracket = s * s * bracket + power * (p + s);
    power *= p * p;
  }
  return static_cast<double>(leading + tail + shift);
}

/// By the series (R30) in y, its two infinities at integer q taken together.
/// @param connection  of d, which is called for only where it counts
template <class Connection>
double by_series(const PadeRelaxation& at, Connection connection) {
  const auto& [begin, end, p, q, excess, T] = at;
  const double eta = 1 / (p + T);
  if (eta == 0) return end;
  const double y = p * eta;
  const double nearest = q < 1.5 ? 1 : std::round(q);
  const double d = q - nearest;
  // The sum below is at most of the size of eta^d, d >= -1/2 where there is a first sum.
  const double negligible = 1e-18 * std::sqrt(eta);
  double G = 0;
  double factor = eta;
  for (double n = 1; n < nearest; ++n) {
    G += factor / (q - n);
    factor *= (excess * eta + n * y) / (n - q);
    if (std::abs(factor) < negligible) return end + (begin - end) * G;
  }
  const double constant = connection(d);
  const double L = std::log(eta) + constant;
  // Where d L is not small, the power itself keeps a digit that the logarithm has lost, and q one that d has.
  const auto power = [&, q = q] {
    return (nearest == 1 ? std::pow(eta, q) / eta : std::pow(eta, d)) * std::exp(d * constant);
  };
  const double W = std::abs(d * L) < 0.5 ? expm1_over(d, L) : (power() - 1) / d;
  double sum = 0;
  double D = 0;
  double e = 1;
  for (int j = 0; std::abs(D) + e * (1 + std::abs(W)) > 1e-18 * std::abs(sum); ++j) {
    sum += D - e * W;
    const double inverse = 1 / ((1 - d + j) * (1 + j));
    D = (D * (eta + (j - d) * y) * (1 + j) + e * (eta - y)) * inverse;
    e *= (eta + j * y) / (1 + j);
  }
  return end + (begin - end) * (G + factor * sum);
}

template <class Connection>
double value_by(const PadeRelaxation& at, Connection connection) {
  if (at.T == 0) return at.begin;
  return at.T < 3 * at.p || at.p + at.T < 1.5 ? by_fraction(at) : by_series(at, connection);
}

}  // namespace

double expm1_over(double d, double t) { return std::abs(d * t) < 1e-17 ? t : std::expm1(d * t) / d; }

double value(const PadeRelaxation& at) {
  return value_by(at, [&](double d) { return log_gamma_quotient(at.p, d) + log_gamma_slope(d); });
}

double value(const PadeRelaxation& at, double connection) {
  return value_by(at, [&](double) { return connection; });
}

}  // namespace contensou::reduction
