#include "contensou/reduction/pade_stop_time.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "reference_table.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using std::numbers::pi;

namespace {

constexpr double largest = std::numeric_limits<double>::max();

}  // namespace

TEST_CASE("the plain function is the closed route", "[pade_stop_time][table]") {
  WorstCase worst("stop_pade");
  for (const ReferenceRow& row : reference_table("stop_pade")) {
    const State start{row.input("u0"), row.input("v0")};
    const double tau = pade_stop_time(row.input("mu"), start);
    worst.add(row.result("tau_stop"), tau, row.where());
    CHECK(stop_time(ReducedSystem(PadeLaw{}, row.input("mu")), start, Route::closed).tau == tau);
  }
  CHECK_WITHIN_EPS(worst, 1.5);
}

TEST_CASE("the plain function on the axes, at rest and without the sign of u0", "[pade_stop_time][limit]") {
  for (double mu : {1e-10, 0.1, 1.0, 1.6733200530681511, 2.0, 2.6457513110645907, 3.0}) {
    CAPTURE(mu);
    CHECK(pade_stop_time(mu, {0, 7}) == Approx(3 * pi).epsilon(3e-16));
    CHECK(pade_stop_time(mu, {1, 0}) == Approx(3.2 / mu).epsilon(3e-16));
    CHECK(pade_stop_time(mu, {0, 0}) == 0);
    CHECK(pade_stop_time(mu, {-1, 2}) == pade_stop_time(mu, {1, 2}));
  }
  CHECK(pade_stop_time(1, {0, 1}, {.chi = 1, .gamma = 2}) == Approx(1.5 * pi).epsilon(3e-16));
  CHECK(pade_stop_time(1, {1, 0}, {.chi = 1, .gamma = 2}) == Approx(4).epsilon(3e-16));
}

TEST_CASE("the plain function scales bit for bit, also below and above the ordinary", "[pade_stop_time][symmetry]") {
  for (double mu : {1e-3, 0.9, 1.7, 2.5, 2.9}) {
    for (const State start : {State{1, 0.1}, State{-0.3, 5}, State{2, 1e-7}}) {
      const double tau = pade_stop_time(mu, start);
      for (int power : {-900, -301, -299, 1, 299, 301, 900}) {
        const State scaled{std::ldexp(start.u, power), std::ldexp(start.v, power)};
        CHECK(pade_stop_time(mu, scaled) == std::ldexp(tau, power));
      }
    }
  }
}

TEST_CASE("the plain function at the ends of the double range", "[pade_stop_time][limit]") {
  CHECK(pade_stop_time(1e-3, {largest, 1}) == infinity);
  CHECK(pade_stop_time(1e-3, {0, largest}) == infinity);
  CHECK(pade_stop_time(1e-3, {1e304, 1}) == Approx(3.2e307).epsilon(3e-16));
  CHECK(pade_stop_time(1e-10, {5e-324, 1e308}) == Approx(3 * pi / 7 * 1e308).epsilon(3e-16));
  CHECK(pade_stop_time(1, {5e-324, 0}) == 1.5e-323);  // 3.2 units of the smallest double
  CHECK(pade_stop_time(1e-310, {1e-300, 0}) == Approx(3.2e10).epsilon(1e-13));
  CHECK(std::isfinite(pade_stop_time(1e150, {1, 1})));
}

TEST_CASE("the plain function rejects what is no motion", "[pade_stop_time][domain]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double mu : {0.0, -1.0, nan, infinity}) CHECK_THROWS_AS(pade_stop_time(mu, {1, 1}), std::domain_error);
  for (const State bad : {State{1, -1}, State{nan, 1}, State{1, nan}, State{infinity, 1}, State{1, infinity}}) {
    CHECK_THROWS_AS(pade_stop_time(0.1, bad), std::domain_error);
  }
  CHECK_THROWS_AS(pade_stop_time(0.1, {1, 1}, {.chi = 0, .gamma = 1}), std::domain_error);
  CHECK_THROWS_AS(pade_stop_time(0.1, {1, 1}, {.chi = 1, .gamma = nan}), std::domain_error);
  CHECK_THROWS_WITH(pade_stop_time(-1, {1, 1}), Catch::Matchers::Contains("mu") && Catch::Matchers::Contains("-1"));
}
