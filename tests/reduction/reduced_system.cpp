#include "contensou/reduction/reduced_system.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/laws.hpp"
#include "user_laws.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using Catch::Matchers::Contains;
using std::numbers::pi;

TEST_CASE("the field is the law times the body's ratios", "[reduced_system]") {
  const Inertia body{1.5, 4};
  const double mu = 0.25;
  const ReducedSystem system(HertzLaw{}, mu, body);
  CHECK(system.r() == 4 * mu * mu / 1.5);
  CHECK(system.inertia().chi == 1.5);
  CHECK(system.mu() == mu);
  WorstCase rate("field");
  for (double u : {-3.0, -1e-3, 1e-3, 2.0}) {
    for (double v : {0.0, 1e-6, 0.5, 40.0}) {
      const auto [force, moment] = HertzLaw{}({v, mu * std::abs(u)});
      const Rate got = system.field({u, v});
      const std::string where = fmt::format("u = {}, v = {}", u, v);
      rate.add(-2 * 1.5 / (3 * pi) * force, got.v, where);
      rate.add(-std::copysign(2 * 4 * mu / (3 * pi) * moment, u), got.u, where);
      const double weight = (16 * mu * std::abs(u) + 15 * pi * v) * (8 * mu * std::abs(u) + 3 * pi * v);
      rate.add(weight, system.regularising_weight({u, v}), where);
      rate.add(weight * got.u, system.regularised_field({u, v}).u, where);
      rate.add(weight * got.v, system.regularised_field({u, v}).v, where);
      rate.add(got.v / got.u, system.slope({u, v}), where);
    }
  }
  CHECK_WITHIN_EPS(rate, 4);
}

TEST_CASE("the axes are invariant and the plane is symmetric", "[reduced_system][limit]") {
  for (const Law& law : paper_laws()) {
    const ReducedSystem system(law, 0.1);
    CHECK(system.field({0, 2}).u == 0);
    CHECK(system.field({0, 2}).v == -7 / (3 * pi));
    CHECK(system.field({2, 0}).v == 0);
    CHECK(system.field({2, 0}).u == Approx(-5 * 0.1 / 16).epsilon(1e-15));
    CHECK(system.regularised_field({0, 0}).u == 0);
    CHECK(system.regularised_field({0, 0}).v == 0);
    CHECK(system.slope({2, 0}) == 0);
    // The field is symmetric under u -> -u.
    const State right{1.5, 0.7}, left{-1.5, 0.7};
    CHECK(system.field(left).u == -system.field(right).u);
    CHECK(system.field(left).v == system.field(right).v);
    CHECK(system.slope(left) == -system.slope(right));
    CHECK(system.stop_time_bounds(left).upper == system.stop_time_bounds(right).upper);
  }
}

TEST_CASE("the limits of the ball are 3 pi v/7 and 16 u/(5 mu)", "[reduced_system][limit]") {
  for (const Law& law : paper_laws()) {
    const ReducedSystem system(law, 0.01);
    CHECK(system.sliding_limit(2) == Approx(6 * pi / 7).epsilon(1e-15));
    CHECK(system.pivoting_limit(-2) == Approx(32 / 0.05).epsilon(1e-15));
  }
  const ReducedSystem puck(RootLaw{}, 0.5, {1, 2});
  CHECK(puck.sliding_limit(1) == Approx(3 * pi / 2).epsilon(1e-15));
  CHECK(puck.pivoting_limit(1) == Approx(3 * pi / (2 * 2 * 0.5 * 0.8)).epsilon(1e-15));
}

TEST_CASE("the bounds are those of theory: S + P and (15 pi/14) v0, or max(S, P) and S + P", "[reduced_system]") {
  const State start{0.5, 2};
  const ReducedSystem pade(PadeLaw{}, 0.1);
  const double sliding = 3 * pi * 2 / 7;
  const double pivoting = 16 * 0.5 / 0.5;
  CHECK(pade.stop_time_bounds(start).lower == Approx(sliding + pivoting).epsilon(4e-15));
  CHECK(pade.stop_time_bounds(start).upper == Approx(pivoting + 15 * pi / 14 * 2).epsilon(4e-15));
  const ReducedSystem exact(HertzLaw{}, 0.1);
  CHECK(exact.stop_time_bounds(start).lower == Approx(pivoting).epsilon(4e-15));
  CHECK(exact.stop_time_bounds(start).upper == Approx(sliding + pivoting).epsilon(4e-15));
  CHECK(exact.stop_time_bounds({0, 2}).lower == Approx(sliding).epsilon(4e-15));
  CHECK(exact.stop_time_bounds({0, 0}).upper == 0);
}

TEST_CASE("a system is made of positive finite numbers", "[reduced_system][domain]") {
  for (double bad : {0.0, -1.0, infinity, not_a_number}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(ReducedSystem(PadeLaw{}, bad), std::domain_error);
    CHECK_THROWS_AS(ReducedSystem(PadeLaw{}, 0.1, {bad, 1}), std::domain_error);
    CHECK_THROWS_AS(ReducedSystem(PadeLaw{}, 0.1, {1, bad}), std::domain_error);
  }
  CHECK_THROWS_WITH(ReducedSystem(PadeLaw{}, -0.5), Contains("ReducedSystem: mu") && Contains("-0.5"));
  CHECK_THROWS_WITH(ReducedSystem(PadeLaw{}, 0.5, {-2, 1}), Contains("chi") && Contains("-2"));
  CHECK_THROWS_WITH(ReducedSystem(PadeLaw{}, 0.5, {1, -3}), Contains("gamma") && Contains("-3"));
}

TEST_CASE("a state is finite with v >= 0; at rest (2.6) has no value", "[reduced_system][domain]") {
  const ReducedSystem system(PadeLaw{}, 0.1);
  for (const State bad :
       {State{1, -1}, State{not_a_number, 1}, State{1, not_a_number}, State{infinity, 1}, State{1, infinity}}) {
    CAPTURE(bad.u, bad.v);
    CHECK_THROWS_AS(system.field(bad), std::domain_error);
    CHECK_THROWS_AS(system.regularised_field(bad), std::domain_error);
    CHECK_THROWS_AS(system.slope(bad), std::domain_error);
    CHECK_THROWS_AS(system.stop_time_bounds(bad), std::domain_error);
  }
  CHECK_THROWS_WITH(system.field({1, -0.25}), Contains("ReducedSystem::field") && Contains("-0.25"));
  CHECK_THROWS_WITH(system.field({0, 0}), Contains("both 0"));
  CHECK_THROWS_WITH(system.slope({0, 1}), Contains("u = 0"));
  CHECK_THROWS_AS(system.slope({0, 0}), std::domain_error);
}

TEST_CASE("mu of a ball is at most 1; a body of other numbers may have any", "[errors]") {
  for (double mu : {1.7, std::nextafter(1.0, 2.0), 0.0, -1.0, std::nan("")}) {
    CHECK_THROWS_WITH(ReducedSystem(HertzLaw{}, mu), Catch::Matchers::Contains("of a ball 0 < mu <= 1 is required"));
  }
  CHECK_NOTHROW(ReducedSystem(HertzLaw{}, 1));
  CHECK_NOTHROW(ReducedSystem(HertzLaw{}, 1.7, {.chi = 1, .gamma = 2}));
}
