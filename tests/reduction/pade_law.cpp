#include "contensou/reduction/pade_law.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "law_checks.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

TEST_CASE("the Pade law keeps 4 eps for every k", "[pade_law][table]") {
  check_table(PadeLaw{}, "pade");
  check_moment_deficit(PadeLaw{}, "pade");
}

TEST_CASE("the Pade law has both limits exactly", "[pade_law][limit]") { check_limits(PadeLaw{}); }

TEST_CASE("the Pade law is of degree 0, bit for bit", "[pade_law][symmetry]") { check_scaling(PadeLaw{}); }

TEST_CASE("the Pade law is continuous where its form changes", "[pade_law][limit]") {
  check_continuity(PadeLaw{}, 1);
  check_continuity(PadeLaw{}, 1.25);
}

TEST_CASE("the Pade force rises and the Pade moment falls", "[pade_law][invariant]") { check_monotone(PadeLaw{}); }

TEST_CASE("the Pade law has no dissipation potential", "[pade_law][invariant]") {
  CHECK(potential_defect(PadeLaw{}, 1) > 0.5);
  CHECK(potential_defect(PadeLaw{}, 0.1) > 0.1);
}

TEST_CASE("the Pade law lies on the other side: Phi + Psi/Psi(0) <= 1", "[pade_law][invariant]") {
  for (double k : ratios_of_slip()) {
    CAPTURE(k);
    CHECK(PadeLaw{}({k, 1}).force <= PadeLaw{}.moment_deficit({k, 1}) * (1 + 4e-16));
  }
}

TEST_CASE("the Pade law misses the exact one by as much as its header says", "[pade_law][route]") {
  double force = 0;
  double moment = 0;
  for (double k = 0.3; k < 1.5; k += 1e-4) {
    const auto exact = HertzLaw{}({k, 1});
    const auto pade = PadeLaw{}({k, 1});
    force = std::max(force, 1 - pade.force / exact.force);
    moment = std::max(moment, 1 - pade.moment / exact.moment);
  }
  CHECK(force == Approx(0.3914).margin(5e-5));
  CHECK(moment == Approx(0.4785).margin(5e-5));
}

TEST_CASE("the Pade law rejects what is no slip", "[pade_law][domain]") { check_domain(PadeLaw{}, "PadeLaw"); }
