#include "contensou/reduction/stop_times_of_mu.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "reference_table.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

TEST_CASE("stop times of any mu, against 40 digits", "[stop_times_of_mu][table]") {
  const StopTimesOfMu stop_time(*find_law("exact"), homogeneous_ball);
  CHECK(stop_time.refused() == 0);
  WorstCase cases("tau*");
  for (const ReferenceRow& row : reference_table("stop_hertz")) {
    cases.add(row.result("tau_stop"), stop_time(row.input("mu"), {row.input("u0"), row.input("v0")}), row.where());
  }
  CHECK_WITHIN_EPS(cases, 6);
}

TEST_CASE("stop times of any mu are those of its flow", "[stop_times_of_mu][route]") {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (const char* name : {"exact", "pade", "uniform", "paraboloid", "ring"}) {
    const Law law = *find_law(name);
    for (const Inertia body : {homogeneous_ball, Inertia{.chi = 1, .gamma = 2}}) {
      const StopTimesOfMu stop_time(law, body);
      CHECK(stop_time.refused() < (name == std::string("ring") ? 1 : 0.01));
      WorstCase cases(fmt::format("{}, chi = {}", name, body.chi));
      for (int i = 0; i < 60; ++i) {
        const double mu = i % 2 == 0 ? share(generator) : std::pow(10, -9 * share(generator));
        const State start{-1.3, 1.3 * mu * std::pow(10, -10 + 20 * share(generator))};
        cases.add(Flow({law, mu, body}).stop_time(start).tau, stop_time(mu, start),
                  fmt::format("mu = {}, v0 = {}", mu, start.v));
      }
      CHECK_WITHIN_EPS(cases, 8);
    }
  }
}

TEST_CASE("what no table answers is computed by a flow, and no number is refused", "[stop_times_of_mu][limit]") {
  const Law law = *find_law("exact");
  const StopTimesOfMu stop_time(law, homogeneous_ball);
  for (double mu : {1e-300, 0.3, 1.0, 1.01, 5.0}) {
    for (const State start : {State{0, 0}, State{1, 0}, State{0, 1}, State{1e300, 1e-300}, State{5e-324, 1},
                              State{1e-310, 1e-310}, State{1e308, 1e308}}) {
      CAPTURE(mu, start.u, start.v);
      CHECK(stop_time(mu, start) == Approx(Flow({law, mu, homogeneous_ball}).stop_time(start).tau).epsilon(2e-15));
    }
  }
  for (double bad : {0.0, -0.1, infinity, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_AS(stop_time(bad, {1, 1}), std::domain_error);
  }
  CHECK_THROWS_AS(stop_time(0.1, {1, -1}), std::domain_error);
  CHECK_THROWS_AS(stop_time(0.1, {infinity, 1}), std::domain_error);
  CHECK_THROWS_AS(StopTimesOfMu(law, {.chi = -1, .gamma = 1}), std::domain_error);
}

TEST_CASE("stop times of any mu scale bit for bit", "[stop_times_of_mu][symmetry]") {
  const StopTimesOfMu stop_time(*find_law("exact"), homogeneous_ball);
  for (int power : {-200, -1, 3, 200}) {
    CHECK(stop_time(0.1, {std::ldexp(-1.1, power), std::ldexp(0.3, power)}) ==
          std::ldexp(stop_time(0.1, {1.1, 0.3}), power));
  }
}
