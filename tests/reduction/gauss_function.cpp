#include "numerics/gauss_function.hpp"

#include <cmath>
#include <numbers>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <catch2/catch.hpp>

#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

namespace {

/// 0 < x < 1 with 1 - x, spread towards both ends.
std::vector<std::pair<double, double>> points() {
  std::vector<std::pair<double, double>> points{{0, 1}, {1, 0}};
  for (int i = 2; i <= 52; ++i) {
    for (double m : {1.0, 1.25, 1.5, 1.9375}) {
      const double small = std::ldexp(m, -i);
      points.push_back({small, 1 - small});
      points.push_back({1 - small, 1 - (1 - small)});
    }
  }
  return points;
}

}  // namespace

TEST_CASE("2F1 where it is elementary", "[gauss_function][table]") {
  const GaussFunction arcsine(0.5L, 0.5L, 1.5L);  // asin(q)/q, x = q^2; c - a - b = 1/2 is too little for x = 1
  const GaussFunction power(-2.5L, 1.5L, 1.5L);   // (1 - x)^(5/2)
  const GaussFunction polynomial(-2, 3, 1);       // 1 - 6 x + 6 x^2
  WorstCase worst("elementary 2F1");
  for (const auto& [x, y] : points()) {
    const std::string where = fmt::format("x = {}", x);
    const long double q = std::sqrt(static_cast<long double>(x));
    const long double cosine = std::sqrt(static_cast<long double>(y));
    if (x > 0 && x < 1) worst.add(std::atan2(q, cosine) / q, arcsine(x, y), where);
    worst.add(std::pow(static_cast<long double>(y), 2.5L), power(x, y), 1, where);
    worst.add(1 - 6.0L * x * y, polynomial(x, y), 1, where);
    if (x == 1 || (x > 1e-9 && x < 1e-2)) continue;  // wanted loses digits
    const long double deficit = x < 1e-6 ? -1 / 6.0L - 3 * x / 40 : (1 - std::atan2(q, cosine) / q) / x;
    worst.add(deficit, arcsine.deficit(x, y), where);
  }
  CHECK_WITHIN_EPS(worst, 4);
}

TEST_CASE("2F1 with a logarithm at x = 1: complete elliptic integrals", "[gauss_function][route]") {
  const GaussFunction second(-0.5L, 0.5L, 1);
  WorstCase worst("E");
  for (const auto& [x, y] : points()) {
    if (x == 1 || x < 1e-14) continue;  // Boost takes the modulus, a root of x
    const long double e = boost::math::ellint_2(std::sqrt(static_cast<long double>(x)));
    worst.add(2 * e / std::numbers::pi_v<long double>, second(x, y), fmt::format("x = {}", x));
  }
  CHECK_WITHIN_EPS(worst, 4);
  CHECK(second(1, 0) == 2 / std::numbers::pi);
}

TEST_CASE("2F1 with large parameters", "[gauss_function][limit]") {
  // Kummer's second relation between neighbours in c: c F(c) - c F(c, b + 1) + a x F(a + 1, b + 1, c + 1) = 0.
  for (long double b : {-1.5L, -5.25L, -12.0L, -26.5L}) {
    const GaussFunction f(0.5L, b, 2), g(0.5L, b + 1, 2), h(1.5L, b + 1, 3);
    for (double x : {0.01, 0.04, 0.1, 0.3, 0.6, 0.9, 0.999}) {
      CAPTURE(static_cast<double>(b), x);
      CHECK(2 * f(x, 1 - x) - 2 * g(x, 1 - x) + 0.5 * x * h(x, 1 - x) == Approx(0).margin(4e-15));
    }
  }
}
