#pragma once

#include <cmath>

namespace contensou::tests {

/// A number with its derivatives by u and v, for the exact Jacobian of a formula.
struct Dual {
  double value, by_u = 0, by_v = 0;
  Dual(double number) : value(number) {}  // NOLINT(google-explicit-constructor): formulas have constants
  Dual(double number, double u, double v) : value(number), by_u(u), by_v(v) {}
  Dual chain(double f, double slope) const { return {f, slope * by_u, slope * by_v}; }
};
inline Dual operator+(Dual a, Dual b) { return {a.value + b.value, a.by_u + b.by_u, a.by_v + b.by_v}; }
inline Dual operator-(Dual a) { return {-a.value, -a.by_u, -a.by_v}; }
inline Dual operator-(Dual a, Dual b) { return a + -b; }
inline Dual operator*(Dual a, Dual b) {
  return {a.value * b.value, a.by_u * b.value + a.value * b.by_u, a.by_v * b.value + a.value * b.by_v};
}
inline Dual operator/(Dual a, Dual b) {
  const double q = a.value / b.value;
  return {q, (a.by_u - q * b.by_u) / b.value, (a.by_v - q * b.by_v) / b.value};
}
inline Dual sin(Dual a) { return a.chain(std::sin(a.value), std::cos(a.value)); }
inline Dual cos(Dual a) { return a.chain(std::cos(a.value), -std::sin(a.value)); }
inline Dual sqrt(Dual a) { return a.chain(std::sqrt(a.value), 1 / (2 * std::sqrt(a.value))); }

}  // namespace contensou::tests
