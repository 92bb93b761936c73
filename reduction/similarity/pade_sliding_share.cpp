// Notation (README (R27) to (R30)): z = (3 pi/8) k, and with the regime's p, q, T of (R28)
//   G = 1/(1 + X), X = a_1/(b_1 + a_2/(b_2 + ...)), b_n = 1 + n p      (R29)
//   eta = 1/(p + T), y = p eta, N = max(1, round(q)), d = q - N        (R30)
#include "contensou/reduction/pade_sliding_share.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <boost/math/special_functions/gamma.hpp>

#include "similarity/pade_slow_rim.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;

/// m = m_end + (m_begin - m_end) G(p, q; T), (R28).
struct Relaxation {
  double begin;   ///< m at the ratio that every motion tends to, T = 0
  double end;     ///< m at T = infinity
  double p;       ///< 1/P
  double q;       ///< Q
  double excess;  ///< 1 - p q, >= 0
  double T;
};

Relaxation relaxation(double r, double z) {
  const double a = 2 - r;
  const double b = 5 - r;
  if (a >= 0) return {2.5, 1, a / 2, 5 / b, 1.5 * r / b, b * z / 2};
  if (b <= 0) return {1, 2.5, (r - 5) / 5, 2 / -a, 0.6 * r / -a, -a / (5 * z)};
  const double beyond = b * z + a;  // of the sign of k - k*
  const double p = -a * b / (3 * r);
  if (beyond >= 0) return {5 / r, 1, p, 5 / b, 2 * b / (3 * r), beyond * b / (3 * r)};
  return {5 / r, 2.5, p, 2 / -a, -5 * a / (3 * r), beyond * a / (3 * r * z)};
}

/// m for G = 1/(1 + X): the term that G shares out is added to the nearer end, so that it alone carries rounding.
double between(double begin, double end, double X) {
  return X < 1 ? begin + (end - begin) * (X / (1 + X)) : end + (begin - end) / (1 + X);
}

/// m by the continued fraction (R29), evaluated from a depth at which the rest no longer counts. All terms are
/// positive: nothing is lost.
double by_fraction(const Relaxation& at, int pairs) {
  const auto& [begin, end, p, q, excess, T] = at;
  double rest = 1 + (2 * pairs + 2) * p;
  for (int j = pairs; j > 0; --j) {
    rest = 1 + (2 * j + 1) * p + (j + 1) * (excess + (j + 1) * p) * T / rest;
    rest = 1 + 2 * j * p + (q + j) * (1 + j * p) * T / rest;
  }
  rest = 1 + p + (excess + p) * T / rest;
  return between(begin, end, q * T / rest);
}

/// Pairs of (R29) that leave out less than eps/8: by the slower of its two rates of convergence.
int pairs_of_fraction(const Relaxation& at) {
  const double by_distance = 18.4 / std::asinh(std::sqrt(at.p / at.T));
  const double by_scale = 12 + 172 * at.T;
  return 1 + static_cast<int>(std::min(by_distance, by_scale) / 2);
}

/// (expm1(d t))/d, also at d = 0.
double expm1_over(double d, double t) { return std::abs(d * t) < 1e-17 ? t : std::expm1(d * t) / d; }

/// lnGamma(1 - d)/d for d < 1.
double log_gamma_slope(double d) { return d == 0 ? std::numbers::egamma : std::log1p(boost::math::tgamma1pm1(-d)) / d; }

/// log1p(d t)/d, also at d = 0.
template <class Real>
Real log1p_over(Real d, Real t) {
  return d * t == 0 ? t : std::log1p(d * t) / d;
}

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

/// m by the series (R30) in y, its two infinities at integer q taken together.
double by_series(const Relaxation& at) {
  const auto& [begin, end, p, q, excess, T] = at;
  const double eta = 1 / (p + T);
  if (eta == 0) return end;
  const double y = p * eta;
  const double nearest = std::max(1.0, std::round(q));
  const double d = q - nearest;
  double G = 0;
  double factor = eta;
  for (double n = 1; n < nearest; ++n) {
    G += factor / (q - n);
    factor *= (excess * eta + n * y) / (n - q);
    if (std::abs(factor) < 1e-18) return end + (begin - end) * G;  // what is left is y^q, smaller still
  }
  const double constant = log_gamma_quotient(p, d) + log_gamma_slope(d);
  const double L = std::log(eta) + constant;
  // Where d L is not small, the power itself keeps a digit that the logarithm has lost.
  const double W = std::abs(d * L) < 0.5 ? expm1_over(d, L) : (std::pow(eta, d) * std::exp(d * constant) - 1) / d;
  double sum = 0;
  double D = 0;
  double e = 1;
  for (int j = 0; std::abs(D) + e * (1 + std::abs(W)) > 1e-18 * std::abs(sum); ++j) {
    sum += D - e * W;
    D = D * (eta + (j - d) * y) / (1 - d + j) + e * (eta - y) / ((1 - d + j) * (1 + j));
    e *= (eta + j * y) / (1 + j);
  }
  return end + (begin - end) * (G + factor * sum);
}

}  // namespace

double pade_sliding_share(double r, double k) {
  const double z = 3 * pi / 8 * k;
  if (r <= slow_rim::largest_r) return slow_rim::sliding_share(r, z);
  const Relaxation at = relaxation(r, z);
  if (at.T == 0) return at.begin;
  return at.T < 3 * at.p || at.p + at.T < 1.5 ? by_fraction(at, pairs_of_fraction(at)) : by_series(at);
}

}  // namespace contensou::reduction
