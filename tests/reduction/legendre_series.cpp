#include "numerics/legendre_series.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace contensou::reduction;
using Samples = LegendreSeries::Samples;

namespace {}

TEST_CASE("Gauss points are the roots of the Legendre polynomial, in order", "[legendre_series]") {
  const Samples& points = LegendreSeries::points();
  for (int i = 0; i < LegendreSeries::order; ++i) {
    CHECK(std::abs(std::legendre(LegendreSeries::order, points[i])) < 1e-13);
    CHECK(points[i] == -points[LegendreSeries::order - 1 - i]);
    if (i > 0) CHECK(points[i] > points[i - 1]);
  }
}

TEST_CASE("a series through samples is exact up to its degree", "[legendre_series]") {
  for (int degree = 0; degree < LegendreSeries::order; ++degree) {
    CAPTURE(degree);
    const LegendreSeries series = LegendreSeries::through(LegendreSeries::points().pow(degree));
    for (double t : {-1.0, -0.83, -0.1, 0.0, 0.4, 0.97, 1.0}) {
      CHECK(series(t) == Approx(std::pow(t, degree)).margin(2e-14));
    }
    CHECK((series.samples() - LegendreSeries::points().pow(degree)).abs().maxCoeff() < 1e-14);
  }
}

TEST_CASE("the antiderivative vanishes at -1 and is exact one degree below", "[legendre_series]") {
  for (int degree = 0; degree + 1 < LegendreSeries::order; ++degree) {
    CAPTURE(degree);
    const LegendreSeries integral = LegendreSeries::through(LegendreSeries::points().pow(degree)).antiderivative();
    CHECK(std::abs(integral(-1)) < 1e-14);
    for (double t : {-0.5, 0.0, 0.3, 1.0}) {
      CHECK(integral(t) == Approx((std::pow(t, degree + 1) - std::pow(-1, degree + 1)) / (degree + 1)).margin(1e-14));
    }
  }
}

TEST_CASE("a smooth function is resolved and a kink is seen in the tail", "[legendre_series]") {
  const LegendreSeries wave = LegendreSeries::through((3 * LegendreSeries::points()).cos());
  CHECK(wave.tail() < 1e-11);
  CHECK(wave.antiderivative()(1) == Approx(2 * std::sin(3.0) / 3).epsilon(1e-14));
  CHECK(LegendreSeries::through((LegendreSeries::points() - 0.3).abs()).tail() > 1e-4);
}

TEST_CASE("a series is scaled and shifted", "[legendre_series]") {
  LegendreSeries series = LegendreSeries::through(LegendreSeries::points().exp());
  series *= 2;
  series += -1;
  CHECK(series(0.25) == Approx(2 * std::exp(0.25) - 1).epsilon(1e-14));
}
