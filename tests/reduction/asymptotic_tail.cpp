#include "steppers/asymptotic_tail.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pade_law.hpp"

using namespace contensou::reduction;

namespace {}

TEST_CASE("the limit holds only where one friction is all there is", "[asymptotic_tail]") {
  for (const Law& law : paper_laws()) {
    const ReducedSystem system(law, 0.3);
    CHECK_FALSE(AsymptoticTail::at(system, {0, 0, 0, 0}));
    CHECK_FALSE(AsymptoticTail::at(system, {0, std::log(1e-16), 0, 0}));
    CHECK(AsymptoticTail::at(system, {0, std::log(1e-18), 0, 0}));
    CHECK_FALSE(AsymptoticTail::at(system, {std::log(1e-16), 0, 0, 0}));
    CHECK(AsymptoticTail::at(system, {std::log(1e-22), 0, 0, 0}));
    // Next to nothing is left.
    CHECK(AsymptoticTail::at(system, {-50, -50, 1, 0}));
    CHECK_FALSE(AsymptoticTail::at(system, {-50, -50, 0, 0}));
  }
}

TEST_CASE("in the limit the speeds fall with their powers of the time left", "[asymptotic_tail][limit]") {
  const ReducedSystem system(PadeLaw{}, 0.5);
  const double rate = system.r() * system.law().pivoting_moment();
  const auto pivoting = AsymptoticTail::at(system, {0, -60, 2, 7});
  REQUIRE(pivoting);
  CHECK(pivoting->stop() == Approx(2 + 1 / rate).epsilon(1e-15));
  const LogState half = pivoting->at_time(2 + 0.5 / rate);
  CHECK(half.ln_w == Approx(std::log(0.5)).epsilon(1e-14));
  CHECK(half.ln_v == Approx(-60 + 14 / (5 * 0.25) * std::log(0.5)).epsilon(1e-14));  // theory: 14/(5 mu^2)
  CHECK(half.s == Approx(2 + 0.5 / rate).epsilon(1e-15));
  CHECK(half.beta == Approx(7 + 1 / (128 * rate)).epsilon(1e-14));

  const auto sliding = AsymptoticTail::at(system, {-infinity, 0, 0, 0});
  REQUIRE(sliding);
  CHECK(sliding->stop() == 1);
  CHECK(sliding->at_time(0.75).ln_v == Approx(std::log(0.25)).epsilon(1e-15));
  CHECK(sliding->at_time(0.75).ln_w == -infinity);
}
