// With y = ln(1 + z):  -Li2(-z) = y + y^2/4 ... is the integral over (0, y) of t e^t/(e^t - 1) = t + t/(e^t - 1):
//   -Li2(-z) = y + y^2/4 + sum of B_2n y^(2n+1)/(2n+1)!,  for z <= 1 with |y| <= ln 2: the terms fall like (y/(2
//   pi))^2n. Li2(-z) + Li2(-1/z) = -pi^2/6 - ln(z)^2/2 beyond.
#include "numerics/dilogarithm.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace contensou::reduction {

namespace {

/// B_2n/(2n + 1)! for n = 1, 2, ...
constexpr std::array bernoulli_over_factorial{
    1.0 / 36,
    -1.0 / 3600,
    1.0 / 211680,
    -1.0 / 10886400,
    5.0 / 66 / 39916800,
    -691.0 / 2730 / 6227020800.0,
    7.0 / 6 / 1307674368000.0,
    -3617.0 / 510 / 355687428096000.0,
};

/// -Li2(-z) for 0 <= z <= 1.
double inner(double z) {
  const double y = std::log1p(z);
  const double square = y * y;
  double sum = 0;
  for (auto term = bernoulli_over_factorial.rbegin(); term != bernoulli_over_factorial.rend(); ++term) {
    sum = (sum + *term) * square;
  }
  return y * (1 + y / 4 + sum);
}

}  // namespace

double dilogarithm_of_minus_exp(double ln_z) {
  constexpr double basel = std::numbers::pi * std::numbers::pi / 6;
  return ln_z <= 0 ? -inner(std::exp(ln_z)) : inner(std::exp(-ln_z)) - basel - ln_z * ln_z / 2;
}

}  // namespace contensou::reduction
