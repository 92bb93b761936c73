// Notation: v and w are sliding and rim speed, rho is the distance from the centre of the patch, c = sqrt(1 - rho^2).
// psi is the polar angle, counted from the side on which v and w rho are opposite. The slip V at (rho, psi) is
//   |V|^2 = (v - w rho)^2 + 4 v w rho sin^2(psi/2),   V_x = v - w rho cos(psi),   moment arm of V: w rho - v cos(psi)
// Chords: q = k cos(theta) + t, |t| <= l, l^2 = 1 - k^2 sin^2(theta), 1 - rho^2 = l^2 - t^2. For k > 1 the variable b,
// sin(theta) = sin(b)/k, l = cos(b), replaces theta, because l ends like a square root at the last chord.
#include "contensou/reduction/verification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <boost/math/quadrature/tanh_sinh.hpp>

namespace contensou::reduction {

namespace {

using std::numbers::pi;

/// Integrates a function of sin^2(psi/2) over 0 <= psi <= pi by the trapezoidal rule with fixed nodes. It is periodic
/// in psi, so the error is of the order of q^(2n) for n intervals, if the function is analytic for |exp(i psi)| < 1/q.
/// @param q  < 1; for q > 0.92 more intervals are needed than there are, and nothing is returned
template <class Function>
std::optional<double> periodic_integral(Function function, double q) {
  constexpr std::size_t most = 256;
  static const std::vector<double> squares = [] {
    std::vector<double> list;
    for (std::size_t i = 0; i <= most; ++i)
      list.push_back(std::pow(std::sin(pi / 2 * static_cast<double>(i) / most), 2));
    return list;
  }();
  std::size_t n = 8;
  for (double error = std::pow(q, 2 * n); error > 1e-17; error *= error) {
    if ((n *= 2) > most) return std::nullopt;
  }
  double sum = (function(squares.front()) + function(squares.back())) / 2;
  for (std::size_t i = most / n; i < most; i += most / n) sum += function(squares[i]);
  return pi / static_cast<double>(n) * sum;
}

/// Integrates by the tanh-sinh rule, which keeps its accuracy at powers and logarithms at the ends.
template <class Function>
double integral(Function function, double left, double right) {
  static boost::math::quadrature::tanh_sinh<double> rule(12);
  return left < right ? rule.integrate(function, left, right, 1e-10) : 0.0;  // one more level squares the error
}

}  // namespace

ContactPatch::ContactPatch(std::function<double(double)> pressure) : pressure_(std::move(pressure)) {
  load_ = 2 * pi * integral([&](double c) { return c * pressure_at(c * c); }, 0, 1);
  if (!(load_ > 0) || !std::isfinite(load_)) {
    throw std::domain_error(fmt::format(
        "ContactPatch: the load, the integral of the pressure, must be positive and finite, got {}", load_));
  }
}

double ContactPatch::pressure_at(double rest) const {
  return pressure_(std::max(rest, std::numeric_limits<double>::min()));  // the pressure can be infinite at the edge
}

Resistance ContactPatch::over_disc(Slip slip) const {
  require_slip("ContactPatch", slip);
  const double larger = std::max(slip.sliding, slip.pivoting);
  const double v = slip.sliding / larger;
  const double w = slip.pivoting / larger;
  const auto around = [&](double rho, auto part) {
    const double rim = w * rho;
    const auto at = [&](double square) {
      const double speed = std::sqrt((v - rim) * (v - rim) + 4 * v * rim * square);
      return speed > 0 ? part(rim, square) / speed : 0.0;
    };
    const auto found = periodic_integral(at, std::min(v, rim) / std::max(v, rim));
    return 2 * (found ? *found : integral([&](double psi) { return at(std::pow(std::sin(psi / 2), 2)); }, 0, pi));
  };
  const auto over = [&](auto part) {
    const auto ring = [&](double c) {
      const double rho = std::sqrt((1 - c) * (1 + c));
      return c * pressure_at(c * c) * around(rho, [&](double rim, double square) { return part(rho, rim, square); });
    };
    // The integrand has a logarithmic singularity at the ring through the centre of velocity, so split there.
    const double edge = v < w ? std::sqrt((1 - v) * (1 + v)) : 0.0;
    return (integral(ring, 0, edge) + integral(ring, edge, 1)) / load_;
  };
  return {over([&](double, double rim, double square) { return v - rim + 2 * rim * square; }),
          over([&](double rho, double rim, double square) { return rho * (rim - v + 2 * v * square); })};
}

double ContactPatch::chord_moment_of(int n, double centre, double half_length) const {
  return integral(
             [&](double x) {  // t = l (1 - x), because x keeps the digits of the distance from the end of the chord
               const double t = half_length * (1 - x);
               const double rest = half_length * half_length * (x * (2 - x));
               return pressure_at(rest) * (std::pow(centre + t, n) + std::pow(centre - t, n));
             },
             0, 1) *
         half_length / load_;
}

double ContactPatch::chord_moment(int n, double theta, double k) const {
  const double offset = k * std::sin(theta);
  if (!(std::abs(offset) < 1)) return 0;
  return chord_moment_of(n, k * std::cos(theta), std::sqrt((1 - offset) * (1 + offset)));
}

Resistance ContactPatch::over_chords(double k) const {
  if (!(k > 0) || !std::isfinite(k)) {
    throw std::domain_error(fmt::format("ContactPatch::over_chords: k must be positive and finite, got {}", k));
  }
  if (k <= 1) {
    const double force = integral([&](double theta) { return std::cos(theta) * chord_moment(1, theta, k); }, 0, pi / 2);
    const double moment = integral([&](double theta) { return chord_moment(2, theta, k); }, 0, pi / 2);
    return {2 * force, 2 * moment - k * (2 * force)};  // factor 2: theta and pi - theta give one chord
  }
  const auto over = [&](int n, int power) {
    return 2 * integral(
                   [&](double b) {
                     const double cosine = std::sqrt(1 - std::sin(b) / k * (std::sin(b) / k));
                     return std::pow(cosine, power) * chord_moment_of(n, k * cosine, std::cos(b)) * std::cos(b) / k;
                   },
                   0, pi / 2);
  };
  const double force = over(1, 0);
  return {force, over(2, -1) - k * force};
}

}  // namespace contensou::reduction
