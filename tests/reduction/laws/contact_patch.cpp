#include "contensou/reduction/verification.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"

using namespace contensou::reduction;
using std::numbers::pi;

namespace {

constexpr double ratios[] = {0.05, 0.3, 0.7, 0.99, 1.0, 1.01, 1.5, 4.0, 20.0};

ContactPatch patch(double p) {
  return ContactPatch([p](double rest) { return std::pow(rest, p); });
}

}  // namespace

TEST_CASE("laws by integration over the disc and over its chords", "[contact_patch][route]") {
  for (double p : {-0.5, -0.3, 0.0, 0.5, 1.7, 5.0}) {
    const ContactPatch by_definition = patch(p);
    const Law law = p == 0.5 ? Law(HertzLaw{}) : PressureLaw(p);
    for (double k : ratios) {
      CAPTURE(p, k);
      const auto [force, moment] = law({k, 1});
      for (const Resistance& found : {by_definition.over_disc({k, 1}), by_definition.over_chords(k)}) {
        CHECK(found.force == Approx(force).epsilon(0).margin(1e-12));
        CHECK(found.moment == Approx(moment).epsilon(0).margin(1e-12 * std::max(1.0, k)));
      }
    }
  }
}

TEST_CASE("a patch that only pivots or only slides", "[contact_patch][limit]") {
  const ContactPatch hertz = patch(0.5);
  CHECK(hertz.over_disc({0, 3}).force == Approx(0).margin(1e-13));
  CHECK(hertz.over_disc({0, 3}).moment == Approx(3 * pi / 16).epsilon(1e-13));
  CHECK(hertz.over_disc({3, 0}).force == Approx(1).epsilon(1e-13));
  CHECK(hertz.over_disc({3, 0}).moment == Approx(0).margin(1e-13));
}

TEST_CASE("a patch rejects what is no load and no slip", "[contact_patch][domain]") {
  CHECK_THROWS_AS(ContactPatch([](double) { return 0.0; }), std::domain_error);
  CHECK_THROWS_AS(ContactPatch([](double) { return -1.0; }), std::domain_error);
  const ContactPatch hertz = patch(0.5);
  CHECK_THROWS_AS(hertz.over_disc({0, 0}), std::domain_error);
  CHECK_THROWS_AS(hertz.over_disc({-1, 1}), std::domain_error);
  for (double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    CHECK_THROWS_AS(hertz.over_chords(bad), std::domain_error);
  }
  CHECK(hertz.chord_moment(1, pi / 2, 2) == 0);
}
