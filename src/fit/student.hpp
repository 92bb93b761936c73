#pragma once

#include <cmath>
#include <numbers>

namespace contensou::fit {

/// 95 % of a normal distribution lie within this many standard deviations.
inline constexpr double normal_quantile = 1.959963984540054;

/// Returns the share of Student's distribution between -t and t, by its finite series (M. Abramowitz, I. Stegun, 26.7.3
/// and 26.7.4).
/// @param n  degrees of freedom, a whole number >= 1
inline double student_share(double t, double n) {
  const double angle = std::atan2(t, std::sqrt(n)), sine = std::sin(angle);
  double sum = 1;  // this form of sum = 1 + (k - 1)/k cos^2 sum keeps its digits for a cosine near 1
  for (double k = n - 2; k > 1; k -= 2) sum += 1 - sum * ((1 + (k - 1) * sine * sine) / k);
  if (std::fmod(n, 2) == 0) return sine * sum;
  return 2 / std::numbers::pi * (angle + (n > 1 ? sine * std::cos(angle) * sum : 0));
}

/// Returns t such that 95 % of Student's distribution lie between -t and t, to 1e-12. A test compares t with Boost's
/// distribution, which would make up a twentieth of the page of `contensou explore`.
/// @param n  degrees of freedom, a whole number >= 1
inline double student_quantile(double n) {
  const double peak = std::exp(std::lgamma((n + 1) / 2) - std::lgamma(n / 2)) / std::sqrt(n * std::numbers::pi);
  // Newton's method from below: the share is concave, and the normal quantile is smaller than t.
  double t = normal_quantile;
  for (double step = t; step > 1e-13 * t; t += step) {
    step = (0.95 - student_share(t, n)) / (2 * peak * std::pow(1 + t * t / n, -(n + 1) / 2));
  }
  return t;
}

}  // namespace contensou::fit
