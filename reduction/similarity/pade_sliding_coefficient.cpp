#include "contensou/reduction/pade_sliding_coefficient.hpp"

#include <array>
#include <numbers>

#include "similarity/pade_relaxation.hpp"

namespace contensou::reduction {

namespace {

/// Every ball with mu <= 1 has r <= 5/7.
constexpr double slow_r = 0.72;

/// [lnGamma(P) + lnGamma(1 - d) - lnGamma(P - d)]/d - ln P of (R30), P = 1/lambda = 2/(2 - r), d = r/(5 - r), for
/// r <= slow_r: its Chebyshev series up to degree 15, in powers of t; within 1e-18.
double slow_connection(double r) {
  constexpr std::array c{
      0.13098133908826343,    0.14712431422470076,    0.017486965431931567,   0.0014499083005106678,
      0.00011987688676548574, 1.6625834746698766e-05, 3.1307762730029616e-06, 5.317389036595615e-07,
      7.69404525729594e-08,   1.0257488478246049e-08, 1.4213207041864494e-09, 2.198783567240833e-10,
      3.633651043732927e-11,  6.011520604332095e-12,  1.0631546891561542e-12, 1.6627182483615667e-13};
  const double t = r * (2 / slow_r) - 1;
  const double t2 = t * t;
  double even = c[14];
  double odd = c[15];
  for (int i = 12; i >= 0; i -= 2) {
    even = even * t2 + c[i];
    odd = odd * t2 + c[i + 1];
  }
  return even + odd * t;
}

/// (R28).
PadeRelaxation relaxation(double r, double z) {
  const double a = 2 - r;
  const double b = 5 - r;
  if (a >= 0) return {2.5, 1, a / 2, 5 / b, 1.5 * r / b, b * z / 2};
  if (b <= 0) return {1, 2.5, (r - 5) / 5, 2 / -a, 0.6 * r / -a, -a / (5 * z)};
  const double beyond = b * z + a;  // of the sign of k - k*
  const double p = -a * b / (3 * r);
  if (beyond >= 0) return {5 / r, 1, p, 5 / b, 2 * b / (3 * r), beyond * b / (3 * r)};
  return {5 / r, 2.5, p, 2 / -a, -5 * a / (3 * r), beyond * a / (3 * r * z)};
}

}  // namespace

double pade_sliding_coefficient(double r, double k) {
  const PadeRelaxation at = relaxation(r, 3 * std::numbers::pi / 8 * k);
  return r <= slow_r ? value(at, slow_connection(r)) : value(at);
}

}  // namespace contensou::reduction
