#include "contensou/reduction/potential8_law.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "law_checks.hpp"
#include "user_laws.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

TEST_CASE("the octic law keeps 4 eps for every k", "[potential8_law][table]") {
  check_table(Potential8Law{}, "potential8", "laws_pressure");
  check_moment_deficit(Potential8Law{}, "potential8", "laws_pressure");
}

TEST_CASE("the octic law has both limits exactly", "[potential8_law][limit]") {
  check_limits(Potential8Law{});
  for (double k : {1e-8, 1e-20, 1e-100}) {
    CHECK(Potential8Law{}.moment_deficit({k, 1}) == Approx(k * k).epsilon(1e-14));
    CHECK(Potential8Law{}({1, k}).moment == Approx(k / 5).epsilon(1e-15));
  }
}

TEST_CASE("the octic law is of degree 0, bit for bit", "[potential8_law][symmetry]") { check_scaling(Potential8Law{}); }

TEST_CASE("the octic law is continuous where its form changes", "[potential8_law][limit]") {
  check_continuity(Potential8Law{}, 1);
  check_continuity(Potential8Law{}, 0.5);
}

TEST_CASE("the octic force rises and the octic moment falls", "[potential8_law][invariant]") {
  check_monotone(Potential8Law{});
}

TEST_CASE("the octic law is the gradient of its potential", "[potential8_law][invariant]") {
  check_potential(Potential8Law{});
}

TEST_CASE("the octic law as a user would write it", "[potential8_law][route]") {
  for (double k : ratios_of_slip()) {
    CAPTURE(k);
    CHECK(Potential8Law{}({k, 1}).force == Approx(OcticLaw{}({k, 1}).force).epsilon(1e-14));
    CHECK(Potential8Law{}({k, 1}).moment == Approx(OcticLaw{}({k, 1}).moment).epsilon(1e-14));
  }
}

TEST_CASE("the octic law is convex", "[potential8_law][invariant]") { check_convex(Potential8Law{}); }

TEST_CASE("the octic law stays within 3.41 % of the exact law, and reaches it", "[potential8_law][limit]") {
  double worst = 0;
  for (double k : ratios_of_slip()) {
    const auto [force, moment] = Potential8Law{}({k, 1});
    const auto exact = HertzLaw{}({k, 1});
    worst = std::max({worst, std::abs(force / exact.force - 1), std::abs(moment / exact.moment - 1)});
  }
  CHECK(worst < 0.0341);
  CHECK(worst > 0.033);
}

TEST_CASE("the octic law rejects what is no slip", "[potential8_law][domain]") {
  check_domain(Potential8Law{}, "Potential8Law");
}
