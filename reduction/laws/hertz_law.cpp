// Notation and closed forms of V. F. Zhuravlev, 1998 (Zh98), section 1:
//   k = sliding/pivoting,  Phi = F/(N f),  Psi = M/(N f eps),  theta* = asin(1/k),  eps: patch radius
//
//   k <= 1:  Phi = (3 pi/32) k (4 - k^2)
//            Psi = (3 pi/128) (8 - 8 k^2 + 3 k^4)
//   k >= 1:  Phi = (3/(16 k)) [k^2 (4 - k^2) theta* + (k^2 + 2) sqrt(k^2 - 1)]              (1.3)
//            Psi = (3/64) [(8 - 8 k^2 + 3 k^4) theta* + 3 (2 - k^2) sqrt(k^2 - 1)]          (1.5)
//          = 2F1(-1/2, 1/2; 5/2; k^-2)  and  2F1(1/2, 1/2; 7/2; k^-2)/(5 k)
#include "contensou/reduction/laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace contensou::reduction {

namespace {

using std::numbers::pi;

/// Below this k the printed form is accurate to 7e-16. At this k the series needs 56 terms, at larger k fewer terms.
constexpr double series_from = 1.25;
constexpr std::size_t hertz_series_terms = 64;

/// Returns the Taylor coefficients of 2F1(a, b; c; x); each coefficient is rounded once.
constexpr std::array<double, hertz_series_terms> gauss_coefficients(long double a, long double b, long double c) {
  std::array<double, hertz_series_terms> coefficients{};
  long double coefficient = 1;
  for (std::size_t n = 0; n < hertz_series_terms; ++n) {
    coefficients[n] = static_cast<double>(coefficient);
    const auto i = static_cast<long double>(n);
    coefficient *= (a + i) * (b + i) / ((c + i) * (1 + i));
  }
  return coefficients;
}

constexpr auto force_series = gauss_coefficients(-0.5, 0.5, 2.5);
constexpr auto moment_series = gauss_coefficients(0.5, 0.5, 3.5);

/// Returns the number of terms of a series that are not negligible at x.
std::size_t terms_at(double x) {
  std::size_t terms = 1;
  for (double power = x; power > 1e-18 && terms < hertz_series_terms; power *= x) ++terms;
  return terms;
}

Resistance fast_sliding(double inverse_k) {
  const double x = inverse_k * inverse_k;
  const std::size_t terms = terms_at(x);
  double force = 0;
  double moment = 0;
  for (std::size_t n = terms; n-- > 0;) {  // sum the smallest terms first, for the least rounding
    force = force * x + force_series[n];
    moment = moment * x + moment_series[n];
  }
  return {force, moment * inverse_k / 5};
}

Resistance just_outside(double k) {
  const double s = k * k;
  const double root = std::sqrt((k - 1) * (k + 1));
  const double angle = std::atan2(1, root);  // asin(1/k) would lose 4e-14 at k = 1
  return {3 / (16 * k) * (s * (4 - s) * angle + (s + 2) * root),
          3.0 / 64 * ((8 - 8 * s + 3 * s * s) * angle + 3 * (2 - s) * root)};
}

Resistance inside(double k) {
  const double s = k * k;
  return {3 * pi / 32 * k * (4 - s), 3 * pi / 128 * (8 * (1 - s) + 3 * s * s)};
}

}  // namespace

Resistance HertzLaw::operator()(Slip slip) const {
  require_slip("HertzLaw", slip);
  if (slip.sliding <= slip.pivoting) return inside(slip.sliding / slip.pivoting);
  if (slip.sliding < series_from * slip.pivoting) return just_outside(slip.sliding / slip.pivoting);
  return fast_sliding(slip.pivoting / slip.sliding);
}

double HertzLaw::moment_deficit(Slip slip) const {
  if (slip.sliding <= slip.pivoting) {
    const double k = slip.sliding / slip.pivoting;
    const double s = k * k;
    return s * (1 - 0.375 * s);
  }
  return 1 - (*this)(slip).moment / (3 * pi / 16);
}

double HertzLaw::force_deficit(Slip slip) const {
  if (!(slip.sliding >= series_from * slip.pivoting)) return 1 - (*this)(slip).force;
  require_slip("HertzLaw", slip);
  const double inverse_k = slip.pivoting / slip.sliding, x = inverse_k * inverse_k;
  double sum = 0;
  for (std::size_t n = std::min(terms_at(x) + 1, hertz_series_terms); n-- > 1;) sum = sum * x - force_series[n];
  return sum * x;
}

}  // namespace contensou::reduction
