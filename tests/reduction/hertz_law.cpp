#include "contensou/reduction/hertz_law.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "law_checks.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

TEST_CASE("the exact law keeps 4 eps for every k", "[hertz_law][table]") {
  check_table(HertzLaw{}, "hertz");
  check_moment_deficit(HertzLaw{}, "hertz");
}

TEST_CASE("the exact law has both limits exactly", "[hertz_law][limit]") { check_limits(HertzLaw{}); }

TEST_CASE("the exact law near its limits follows its expansions", "[hertz_law][limit]") {
  using std::numbers::pi;
  WorstCase slow("k << 1"), fast("k >> 1");
  for (double k : {1e-5, 1e-7, 1e-100, 1e-300}) {
    const auto [force, moment] = HertzLaw{}({k, 1});
    const std::string where = fmt::format("k = {}", k);
    slow.add(3 * pi / 8 * k * (1 - k * k / 4), force, where);
    slow.add(k * k, HertzLaw{}.moment_deficit({k, 1}), k * k * (1 + k * k / 2e-16), where);
    const auto [force_fast, moment_fast] = HertzLaw{}({1, k});
    fast.add(1 - k * k / 10, force_fast, where);
    fast.add(k / 5 * (1 + k * k / 14), moment_fast, where);
  }
  CHECK_WITHIN_EPS(slow, 4);
  CHECK_WITHIN_EPS(fast, 4);
}

TEST_CASE("the exact law is of degree 0, bit for bit", "[hertz_law][symmetry]") { check_scaling(HertzLaw{}); }

TEST_CASE("the exact law is continuous where its form changes", "[hertz_law][limit]") {
  check_continuity(HertzLaw{}, 1);
  check_continuity(HertzLaw{}, 1.25);
}

TEST_CASE("the exact force rises and the exact moment falls", "[hertz_law][invariant]") { check_monotone(HertzLaw{}); }

TEST_CASE("Coulomb friction has a dissipation potential: Psi' = -k Phi'", "[hertz_law][invariant]") {
  for (double k : {0.01, 0.1, 0.5, 0.9, 1.1, 1.2, 1.3, 2.0, 10.0, 100.0}) {
    CAPTURE(k);
    // k Phi' is a difference of numbers of order 1 for large k, where Phi is flat.
    CHECK(potential_defect(HertzLaw{}, k) < 1e-9 * std::max(1.0, k * k / 100) + 1e-10 / std::min(1.0, k * k));
  }
}

TEST_CASE("the curve (Phi, Psi) of Coulomb friction is convex: Phi + Psi/Psi(0) >= 1", "[hertz_law][invariant]") {
  for (double k : ratios_of_slip()) {
    CAPTURE(k);
    CHECK(HertzLaw{}({k, 1}).force >= HertzLaw{}.moment_deficit({k, 1}) * (1 - 4e-16));
  }
}

TEST_CASE("the exact law rejects what is no slip", "[hertz_law][domain]") { check_domain(HertzLaw{}, "HertzLaw"); }
