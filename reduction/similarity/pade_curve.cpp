// Notation (numerics.md (R45), (R54), (R55)), with p = lambda and q = Q:
//   G = 1/(1 + X), X = a_1/(b_1 + a_2/(b_2 + ...)), b_n = 1 + n p                    (R54)
//   eta = 1/(p + T), y = p eta, d = q - 1                                             (R55)
// Notation (numerics.md (R40) to (R43)):
//   A = 8 (2 - r), B = 3 pi (5 - r), a = r/(2 - r), e = r/(5 - r), b = a - e
//   x = B k/(A + B k), y = 1 - x = A/(A + B k), z = ln(x/y) = ln k + ln(B/A)
#include "similarity/curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "similarity/regular_solution.hpp"

namespace contensou::reduction {

/// A function of the ratio k under the Pade law that is a hypergeometric function: m of theory.md (R4) or o of (R8).
///
///   value = end + (begin - end) G,   G = 2F1(1, q; 1 + 1/p; -T/p)
struct PadeRelaxation {
  double begin;       ///< value at T = 0
  double end;         ///< value at T = infinity
  double p;           ///< lambda > 0
  double q;           ///< Q, 1 to 3/2
  double excess;      ///< 1 - p q >= 0, accurate to its own last digit
  double T;           ///< p zeta >= 0, with zeta of (R45)
  double connection;  ///< [lnGamma(P) + lnGamma(1 - d) - lnGamma(P - d)]/d - ln P of (R55),  P = 1/p, d = q - 1
};

/// Returns the value.
///
/// Source    numerics.md (R54), (R55).
/// Accuracy  5 ulp.
double value(const PadeRelaxation& at);

/// Returns expm1(d t)/d; t at d = 0.
double expm1_over(double d, double t);

namespace {

/// Returns the number of pairs of (R54) by the faster of two rates of convergence. The error of m is then below eps/8.
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

/// Evaluates the continued fraction (R54) from a depth below which the rest is negligible. Only one division is needed,
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

/// Evaluates the series (R55) in y. Two of its terms, which are infinite at Q = 1, are combined.
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

namespace {

using std::numbers::pi;

constexpr int terms = PadeCurve::terms;

/// Returns the number of terms of a series in powers of x <= 1/2 that are above half an eps.
int terms_for(double x) {
  const int exponent = x > 0 ? std::ilogb(x) + 1 : -terms;  // x < 2^exponent
  return exponent < -1 ? 54 / -exponent + 2 : terms;
}

/// Returns 2F1(1, beta; gamma; x) for 0 <= x <= 1/2 and |beta| <= gamma by its Taylor series, the smallest terms first.
double gauss_series(double beta, double gamma, double x) {
  double sum = 1;
  for (int n = terms_for(x) - 1; n >= 0; --n) sum = 1 + sum * x * ((beta + n) / (gamma + n));
  return sum;
}

struct Fractions {
  double x, y;
  double ln_x, ln_y;
};

/// Returns x, y = 1 - x and the logarithms of both without subtractions; z = ln(x/y).
Fractions fractions(double z) {
  const double far = std::exp(-std::abs(z));
  const double near = std::log1p(far);
  if (z > 0) return {1 / (1 + far), far / (1 + far), -near, -z - near};
  return {far / (1 + far), 1 / (1 + far), z - near, -near};
}

/// Returns the sum of a series in powers of t, |t| <= 1. Its last terms must be below 1e-15 of the first.
template <std::size_t size>
double powers_of(const std::array<double, size>& c, double t) {
  double sum = 0;
  for (auto each = c.rbegin(); each != c.rend(); ++each) sum = sum * t + *each;
  return sum;
}

// PadeRelaxation::connection for r from 0 to max_r: the coefficients are those of powers of 2 r/max_r - 1, with an
// error below 1e-16. For m, P = 2/(2 - r) and d = r/(5 - r); for o, P = (2 + r)/(2 - r) and d = 2 r/(5 - r).
constexpr std::array sliding_connection{0.13098133908826342,    0.14712431422470077,    0.017486965431931466,
                                        0.0014499083005106165,  0.0001198768867676149,  1.6625834747415241e-5,
                                        3.130776255969687e-6,   5.3173889915600616e-7,  7.6940519489395121e-8,
                                        1.0257503490097274e-8,  1.4211779491235669e-9,  2.1984997067812908e-10,
                                        3.6505220966190519e-11, 6.0420901922827937e-12, 9.5933282524153756e-13,
                                        1.488034888643292e-13,  2.5955465978654164e-14, 4.1101966992535198e-15};
constexpr std::array angle_connection{0.24892550007796566,    0.26987207903492529,    0.02587130371114608,
                                      0.0058422212535475189,  0.0011461418060080496,  0.00027692027831482632,
                                      6.0321050835561473e-5,  1.4927161439753676e-5,  3.6032802926373734e-6,
                                      9.0123730537378386e-7,  2.2439123720855124e-7,  5.6878330088585043e-8,
                                      1.4511188292045263e-8,  3.7232449571183477e-9,  9.0654855946386795e-10,
                                      2.3253894823493883e-10, 8.7716262566022654e-11, 2.3291591138728139e-11};

}  // namespace

PadeCurve::PadeCurve(double r)
    : SimilarityCurve(r, TerminalChart::to_zero()),
      A_(8 * (2 - r)),
      B_(3 * pi * (5 - r)),
      a_(r / (2 - r)),
      e_(r / (5 - r)),
      log_ratio_(std::log(B_ / A_)),
      sliding_connection_(powers_of(sliding_connection, 2 * (r / max_r) - 1)),
      angle_connection_(powers_of(angle_connection, 2 * (r / max_r) - 1)) {
  if (!(r > 0 && r <= max_r)) {
    throw std::domain_error(fmt::format("PadeCurve: r = gamma mu^2/chi must be in (0, {}], got {}", max_r, r));
  }
}

PadeCurve::BetaIntegral::BetaIntegral(double a, double e)
    : half(std::exp2(a - e) * 0.5 / (e + 1) * gauss_series(1 - a + e, e + 2, 0.5)) {
  double coefficient = -e;
  double half_power = 0.5 * std::exp2(a);
  for (int n = 2; n < PadeCurve::terms; ++n) {
    coefficient *= (n - 1 - e) / n;
    half_power *= 0.5;
    terms[n] = coefficient / (n - a);
    far += terms[n] * half_power;
  }
}

double PadeCurve::linear_below() const { return min_ln_k; }

double PadeCurve::ln_w(double ln_k) const {
  const auto at = fractions(ln_k + log_ratio_);
  return a_ * at.ln_x - e_ * at.ln_y;
}

double PadeCurve::sliding_coefficient(double ln_k) const {
  const double d = 5 - r();
  const double T = d * (3 * pi / 8 * std::exp(ln_k)) / 2;
  return value({2.5, 1, (2 - r()) / 2, 5 / d, 1.5 * r() / d, T, sliding_connection_});
}

double PadeCurve::slip_length_coefficient(double ln_k) const {
  return 8 / (3 * pi) * (1 - r() / 5 * angle_coefficient(ln_k));
}

double PadeCurve::angle_coefficient(double ln_k) const {
  const double c = 2 + r();
  const double d = 5 - r();
  const double T = d * (3 * pi / 8 * std::exp(ln_k)) / c;
  return 5 / (5 + r()) * value({1 + 3 / c, 1, (2 - r()) / c, (5 + r()) / d, 6 * r() / (c * d), T, angle_connection_});
}

double PadeCurve::beta_coefficient(double ln_k) const {
  const auto at = fractions(ln_k + log_ratio_);
  // y (1 + k), computed with k or 1/k, whichever is at most 1.
  const double bounded =
      ln_k > 0 ? A_ * (1 + std::exp(-ln_k)) / (B_ + A_ * std::exp(-ln_k)) : at.y * (1 + std::exp(ln_k));
  if (at.y <= 0.5) return bounded / (3 * pi * A_ * (e_ + 1)) * gauss_series(1 - b(), e_ + 2, at.y);

  // (R43): x^a times the integral of t^(-a-1) (1-t)^e, from x to 1/2 term by term, then from 1/2 to 1. The integrals of
  // the terms t^-a and (for r near 1) t^(1-a) are powers that can come close to a logarithm.
  const double to_half = -std::numbers::ln2 - at.ln_x;
  const double x_to_a = std::exp(a_ * at.ln_x);
  const double s = 1 - a_;
  const double first = s * to_half < 1 ? at.x * expm1_over(s, to_half) : (x_to_a * std::exp2(-s) - at.x) / s;
  const BetaIntegral& integral = beta_integral_.made([this] { return BetaIntegral(a_, e_); });
  double rest = 0;
  for (int n = terms_for(at.x) - 1; n >= 2; --n) rest = rest * at.x + integral.terms[n];
  const double sum = expm1_over(-a_, to_half) - e_ * first - at.x * at.x * rest;
  const double unit = (1 + std::exp(ln_k)) / (3 * pi * A_);
  return unit * std::exp(-e_ * at.ln_y) * (sum + x_to_a * (integral.far + integral.half));
}

double PadeCurve::time_rate(double ln_k) const {
  // k/((1 + k) D), D = Phi - r k Psi, computed with k or 1/k, whichever is at most 1.
  const double far = std::exp(-std::abs(ln_k));
  if (ln_k > 0) return (8 * far + 3 * pi) * (16 * far + 15 * pi) / (3 * pi * (1 + far) * (A_ * far + B_));
  return (8 + 3 * pi * far) * (16 + 15 * pi * far) / (3 * pi * (1 + far) * (A_ + B_ * far));
}

}  // namespace contensou::reduction
