#include "numerics/linear_ode.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using Samples = LegendreSeries::Samples;

TEST_CASE("a constant rate forgets the start exponentially", "[relaxation][limit]") {
  WorstCase worst("y");
  for (double h : {0.0, 0.1, 0.7, 1.4, 2.0, 4.0}) {
    const LegendreSeries y = solve_linear_ode(Samples::Ones(), Samples::Constant(h), Samples::Constant(3 * h), 2);
    for (double t : {-1.0, -0.6, 0.2, 1.0}) {
      worst.add(3 - std::exp(-h * (t + 1)), y(t), fmt::format("h = {}, t = {}", h, t));
    }
  }
  CHECK_WITHIN_EPS(worst, 16);
}

TEST_CASE("however fast it relaxes, a solution that starts on g/h stays with it", "[relaxation][limit]") {
  // y = exp(t/2) solves y' + h y = g with g = (h + 1/2) y.
  const Samples t = LegendreSeries::points();
  WorstCase worst("y");
  for (double largest : {0.3, 2.0, 10.0, 1e3, 1e8, 1e15}) {
    const Samples rate = largest * (-2 * (t + 1)).exp();
    const LegendreSeries y = solve_linear_ode(Samples::Ones(), rate, (rate + 0.5) * (t / 2).exp(), std::exp(-0.5));
    for (double at : {-0.9, 0.0, 0.7, 1.0}) worst.add(std::exp(at / 2), y(at), fmt::format("{}, t = {}", largest, at));
  }
  CHECK_WITHIN_EPS(worst, 16);
}

TEST_CASE("a noise that rate and source share is not in the solution", "[relaxation][invariant]") {
  Samples noise;
  for (int i = 0; i < LegendreSeries::order; ++i) noise[i] = 1 + 0.1 * std::sin(97.0 * i * i);
  for (double h : {0.3, 1.2, 40.0}) {
    const LegendreSeries y = solve_linear_ode(Samples::Ones(), h * noise, 0.7 * h * noise, 0.7);
    CAPTURE(h);
    for (double t : {-1.0, -0.3, 0.4, 1.0}) CHECK(y(t) == Approx(0.7).epsilon(1e-15));
  }
}
