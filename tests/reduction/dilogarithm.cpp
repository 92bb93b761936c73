#include "numerics/dilogarithm.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "reference_table.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using std::numbers::pi;

TEST_CASE("the dilogarithm over its table", "[dilogarithm][table]") {
  WorstCase li2("Li2(-exp(x))");
  for (const ReferenceRow& row : reference_table("dilogarithm")) {
    li2.add(row.result("li2"), dilogarithm_of_minus_exp(row.input("x")), row.where());
  }
  CHECK_WITHIN_EPS(li2, 4);
}

TEST_CASE("the dilogarithm by Landen's transformation and the series of Li2", "[dilogarithm][invariant]") {
  // Li2(-z) = -Li2(z/(1 + z)) - ln(1 + z)^2/2.
  for (double z : {1e-3, 0.1, 0.4, 0.9}) {
    const double t = z / (1 + z);
    double series = 0;
    for (int n = 400; n >= 1; --n) series += std::pow(t, n) / n / n;
    CAPTURE(z);
    CHECK(dilogarithm_of_minus_exp(std::log(z)) == Approx(-series - std::log1p(z) * std::log1p(z) / 2).epsilon(1e-14));
  }
}

TEST_CASE("the dilogarithm at its ends", "[dilogarithm][limit]") {
  CHECK(dilogarithm_of_minus_exp(-std::numeric_limits<double>::infinity()) == 0);
  CHECK(dilogarithm_of_minus_exp(0) == Approx(-pi * pi / 12).epsilon(1e-15));
  CHECK(dilogarithm_of_minus_exp(1e5) == Approx(-0.5e10).epsilon(1e-9));
}
