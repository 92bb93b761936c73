// Notation (README (R28) to (R30)): z = (3 pi/8) k, p = 1 - r/2, T = (5 - r) z/2, t = T/p; d = r/(5 - r), N = 1.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

/// m of the Pade law while the rim slows down much more slowly than the sliding: r <= 0.72, every ball with mu <= 1.
/// For one number or for a vector of them (GCC's vector extension): Real is double, or such a vector.
namespace contensou::reduction::slow_rim {

/// A ball has r <= 5/7 for mu <= 1.
inline constexpr double largest_r = 0.72;

/// t up to which the continued fraction serves; the series beyond.
inline constexpr double fraction_t = 3;

/// y below which m is 1.
inline constexpr double least_y = 1e-19;

/// Pairs of (R29) that leave out less than eps/8 for t up to a bound, the binary exponents of t in mind.
constexpr int fraction_pairs(double t) {
  if (t < 0.015625) return 4;
  if (t < 0.125) return 6;
  if (t < 0.5) return 8;
  if (t < 1) return 11;
  if (t < 2) return 14;
  return 17;
}

/// m by (R29), its divisions taken together: R_n = N_n/N_(n+1).
template <class Real>
Real by_fraction(Real r, Real T, int pairs) {
  const Real p = 1 - 0.5 * r;
  const Real b = 5 - r;
  const Real q = 5 / b;
  const Real excess_T = 1.5 * r / b * T;
  const Real p_T = p * T;
  Real above = 1 - 0 * p;               // N_(n+1)
  Real here = 1 + (2 * pairs + 2) * p;  // N_n
  for (double j = pairs; j > 0; --j) {
    const Real odd = (1 + (2 * j + 1) * p) * here + (j + 1) * (excess_T + (j + 1) * p_T) * above;
    here = (1 + 2 * j * p) * odd + (q + j) * (T + j * p_T) * here;
    above = odd;
  }
  const Real first = (1 + p) * here + (excess_T + p_T) * above;
  const Real second = q * T * here;
  const Real sum = first + second;
  return second < first ? 2.5 - 1.5 * (second / sum) : 1 + 1.5 * (first / sum);
}

/// [lnGamma(P) + lnGamma(1 - d) - lnGamma(P - d)]/d of (R30): a fit within 3e-17.
template <class Real>
Real connection(Real r) {
  constexpr std::array<double, 17> c{0.32943227781210166,    0.3666365093466519,     0.041579767335560236,
                                     0.0049756841888522136,  0.0007003399903362681,  0.00011856081870923766,
                                     2.1777419661924692e-05, 4.040167077963286e-06,  7.508154503983105e-07,
                                     1.4174362967505162e-07, 2.739769293454437e-08,  5.406781815119233e-09,
                                     1.0802295625113718e-09, 2.1413826835534245e-10, 4.3371196819529005e-11,
                                     1.0775126456159872e-11, 2.211978230573671e-12};
  const Real t = r * (2 / largest_r) - 1;
  const Real t2 = t * t;
  Real even = c[16] * t2 + c[14];
  Real odd = c[15] * t2 + c[13];
  for (std::size_t i = 12; i > 0; i -= 2) {
    even = even * t2 + c[i];
    odd = odd * t2 + c[i - 1];
  }
  return even * t2 + c[0] + odd * t;
}

/// Terms of (R30) for y < 2^(1 - bits): until 2^-56, and two more for their slow growth.
constexpr int series_terms(int bits) { return 56 / (bits - 1) + 2; }

/// expm1(d L)/d.
inline double weight(double d, double L) { return std::abs(d * L) < 1e-17 ? L : std::expm1(d * L) / d; }

/// m by (R30), summed from its small end: the recurrence of D and e acts backwards on the weights of their sum.
template <class Real>
Real by_series(Real r, Real eta, Real y, Real W, int terms) {
  const Real d = r / (5 - r);
  const Real gain = r * y / (2 - r);  // (P - 1) y
  Real of_D = 0 * r;
  Real of_e = 0 * r;
  for (double j = terms; j >= 0; --j) {
    const Real to = 1 - d + j;
    const Real share = 1 / (to * (1 + j));
    of_e = ((eta + j * y) * to * of_e + gain * of_D) * share - W;
    of_D = (eta + (j - d) * y) * (1 + j) * share * of_D + 1;
  }
  return 1 + 1.5 * eta * of_e;
}

inline double sliding_share(double r, double z) {
  const double p = 1 - 0.5 * r;
  const double T = (5 - r) * z / 2;
  if (T < fraction_t * p) return by_fraction(r, T, fraction_pairs(T / p));
  const double eta = 1 / (p + T);
  const double y = p * eta;
  if (y < least_y) return 1;
  const double W = weight(r / (5 - r), std::log(y) + connection(r));
  return by_series(r, eta, y, W, series_terms(-std::ilogb(y)));
}

}  // namespace contensou::reduction::slow_rim
