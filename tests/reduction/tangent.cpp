// The slopes of laws are compared with differences of the values of the laws.
#include "contensou/reduction/detail/tangent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "user_laws.hpp"

using namespace contensou::reduction;
namespace kernel = contensou::kernel;
using std::numbers::pi;

namespace {

/// Returns slopes by Richardson's extrapolation of central differences in the ratio of the speeds, to about 1e-11.
kernel::Friction<double> extrapolated(const Law& law, Slip slip) {
  const bool pivots = slip.sliding <= slip.pivoting;
  const double ratio = pivots ? slip.sliding / slip.pivoting : slip.pivoting / slip.sliding;
  const auto at = [&](double x) { return law(pivots ? Slip{x, 1} : Slip{1, x}); };
  const auto slope = [&](auto part) {
    const auto central = [&](double h) { return (part(at(ratio + h)) - part(at(ratio - h))) / (2 * h); };
    const double h = std::min(2e-3, ratio / 8);
    return (64 * central(h / 4) - 20 * central(h / 2) + central(h)) / 45;
  };
  const double sign = pivots ? 1 : -1;
  return {0, 0, sign * slope([](Resistance r) { return r.force; }),
          -sign * slope([](Resistance r) { return r.moment; })};
}

}  // namespace

TEST_CASE("the tangent of every law is that of its curve", "[laws]") {
  std::vector<Law> laws = named_laws();
  for (const char* name : {"elliptic:0.6", "annulus:0.65", "pressure:3"}) laws.push_back(*find_law(name));
  laws.push_back(contensou::tests::RootLaw{});
  for (const Law& law : laws) {
    const auto tangent = tangent_of(law);
    for (double k : {1e-3, 0.1, 0.4, 0.55, 0.9, 1.1, 1.2, 1.4, 2.0, 5.0, 7.9, 8.1, 40.0, 900.0}) {
      CAPTURE(law.name(), k);
      const Slip slip = slip_of_ratio(k);
      const auto [force, moment, force_slope, moment_slope] = tangent({7 * slip.sliding, 7 * slip.pivoting});
      const kernel::Friction<double> expected = extrapolated(law, slip);
      CHECK(force * std::min(1.0, k) == Approx(law(slip).force).epsilon(1e-15));
      CHECK(moment * std::min(1.0, 1 / k) == Approx(law(slip).moment).epsilon(1e-15));
      CHECK(force_slope == Approx(expected.force_slope).epsilon(0).margin(3e-9));
      CHECK(moment_slope == Approx(expected.moment_slope).epsilon(0).margin(3e-9));
      CHECK(force_slope >= -1e-9);
      if (law.name() != "pade")  // Pade is the only law without a potential
        CHECK(slip.sliding * force_slope == Approx(slip.pivoting * moment_slope).epsilon(0).margin(1e-9));
    }
  }
}

TEST_CASE("slopes at both ends and at k = 1 in closed form", "[laws][limit]") {
  constexpr double largest = std::numeric_limits<double>::max();
  for (double speed : {5e-324, 1.0, largest}) {
    CHECK(tangent_of(HertzLaw{})({0, speed}).force_slope == Approx(3 * pi / 8).epsilon(1e-15));
    CHECK(tangent_of(HertzLaw{})({speed, 0}).moment_slope == Approx(0.2).epsilon(1e-15));
    CHECK(tangent_of(HertzLaw{})({speed, speed}).force_slope == Approx(3 * pi / 32).epsilon(1e-15));
    CHECK(tangent_of(EllipticLaw{0.5})({0, speed}).force_slope == Approx(2).epsilon(1e-15));
    CHECK(tangent_of(EllipticLaw{0.5})({speed, 0}).moment_slope == Approx(0.25).epsilon(1e-15));
  }
  for (const Law& law : named_laws()) {
    for (double ratio : {0.0, 1e-12, 3e-6, 1e-5}) {
      CAPTURE(law.name(), ratio);
      CHECK(tangent_of(law)({ratio, 1}).force_slope == Approx(law.force_slope()).epsilon(1e-4));
      if (law.name() == "pade") continue;  // here Phi and Psi of Pade are not smooth
      CHECK(tangent_of(law)({1, ratio}).force_slope == Approx(0).epsilon(0).margin(1e-5));
      CHECK(tangent_of(law)({ratio, 1}).moment_slope == Approx(ratio * law.force_slope()).epsilon(0).margin(1e-9));
    }
  }
  // Two formulas give moment_slope of the exact law: they must agree at k = 8, where one replaces the other.
  const double below = tangent_of(HertzLaw{})({std::nextafter(8, 0), 1}).moment_slope;
  CHECK(tangent_of(HertzLaw{})({8, 1}).moment_slope == Approx(below).epsilon(1e-11));
  CHECK(tangent_of(HertzLaw{})({std::nextafter(1, 2), 1}).moment_slope == Approx(3 * pi / 32).epsilon(1e-12));
}
