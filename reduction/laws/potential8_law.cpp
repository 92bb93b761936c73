// Notation: x = k^2, R0 = 3 pi/16, c = R0^8;  P = (R/R0)^8 = 1 + 8 x + g2 x^2 + g3 x^3 + g4 x^4 for k <= 1.
//   Psi/R0 = N/P^(7/8),  N = 1 + 6 x + n2 x^2 + n3 x^3;   with d = P^(1/8) - 1
//   1 - Psi/R0 = [(7/8)(P - 1) - (N - 1) - d^2 (7/2 + 14 d + ... + 7/8 d^6)]/(1 + d)^7
// where d^2 (...) is (7/8)[(1 + d)^8 - 1] - [(1 + d)^7 - 1] expanded: its term of first order cancels.
#include "contensou/reduction/potential8_law.hpp"

#include <cmath>
#include <numbers>

#include "contensou/reduction/tangent.hpp"

namespace contensou::reduction {

namespace {

using std::numbers::pi;

constexpr double power8(double x) { return (x * x) * (x * x) * ((x * x) * (x * x)); }
constexpr double pivoting_moment = 3 * pi / 16;
constexpr double c = power8(pivoting_moment);
constexpr double sixth = 0.8;
constexpr double fourth = 0.321466;

double eighth_root(double x) { return std::sqrt(std::sqrt(std::sqrt(x))); }

}  // namespace

Tangent tangent(const Potential8Law& /*law*/, Slip slip) {
  require_slip("Potential8Law", slip);
  // With P = R^8, and ' along the smaller speed:  R'' = (R/P) [P''/8 - 7 P (P'/(8 P))^2]
  if (slip.sliding <= slip.pivoting) {
    const double k = slip.sliding / slip.pivoting;
    const double x = k * k;
    const double octic = c + x * (8 * c + x * (fourth + x * (sixth + x)));
    const double slope = eighth_root(octic) / octic;
    const double inner = 2 * c + x * (fourth / 2 + x * (0.75 * sixth + x));
    const double curvature = 2 * c + x * (1.5 * fourth + x * (3.75 * sixth + x * 7)) - 7 * x * inner * (inner / octic);
    return Tangent::of_potential({k * inner * slope, (c + x * (6 * c + x * (fourth / 2 + x * (sixth / 4)))) * slope},
                                 slip, curvature * slope);
  }
  const double inverse_k = slip.pivoting / slip.sliding;
  const double x = inverse_k * inverse_k;
  const double octic = 1 + x * (sixth + x * (fourth + x * (8 * c + x * c)));
  const double slope = eighth_root(octic) / octic;
  const double inner = sixth / 4 + x * (fourth / 2 + x * (6 * c + x * c));
  const double curvature =
      sixth / 4 + x * (1.5 * fourth + x * (30 * c + x * (7 * c))) - 7 * x * inner * (inner / octic);
  return Tangent::of_potential(
      {(1 + x * (0.75 * sixth + x * (fourth / 2 + x * (2 * c)))) * slope, inverse_k * inner * slope}, slip,
      curvature * slope);
}

Resistance Potential8Law::operator()(Slip slip) const { return tangent(*this, slip).resistance; }

double Potential8Law::moment_deficit(Slip slip) const {
  if (slip.sliding > slip.pivoting / 2) return 1 - (*this)(slip).moment / pivoting_moment;
  const double k = slip.sliding / slip.pivoting;
  const double x = k * k;
  constexpr double g2 = fourth / c;
  constexpr double g3 = sixth / c;
  constexpr double g4 = 1 / c;
  const double d = std::expm1(std::log1p(x * (8 + x * (g2 + x * (g3 + x * g4)))) / 8);
  const double first = x * (1 + x * (0.375 * g2 + x * (0.625 * g3 + x * (0.875 * g4))));
  const double second = d * d * (3.5 + d * (14 + d * (26.25 + d * (28 + d * (17.5 + d * (6 + d * 0.875))))));
  const double square = (1 + d) * (1 + d);
  return (first - second) / (square * square * square * (1 + d));
}

}  // namespace contensou::reduction
