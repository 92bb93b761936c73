#include "contensou/reduction/contact_patch.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pressure_law.hpp"

using namespace contensou::reduction;
using std::numbers::pi;

namespace {

constexpr double ratios[] = {0.05, 0.3, 0.7, 0.99, 1.0, 1.01, 1.5, 4.0, 20.0};

ContactPatch patch(double p) {
  return ContactPatch([p](double rest) { return std::pow(rest, p); });
}

template <class Function>
double integral(Function function, double left, double right) {
  return boost::math::quadrature::tanh_sinh<double>(12).integrate(function, left, right, 1e-10);
}

}  // namespace

TEST_CASE("pressure laws by integration over the disc and over its chords", "[contact_patch][route]") {
  for (double p : {-0.5, -0.3, 0.0, 0.5, 1.7, 5.0}) {
    const ContactPatch by_definition = patch(p);
    const PressureLaw law(p);
    for (double k : ratios) {
      CAPTURE(p, k);
      const auto [force, moment] = law({k, 1});
      const Resistance disc = by_definition.over_disc({k, 1});
      CHECK(disc.force == Approx(force).epsilon(0).margin(1e-12));
      CHECK(disc.moment == Approx(moment).epsilon(0).margin(1e-12));
      const Resistance chords = by_definition.over_chords(k);
      CHECK(chords.force == Approx(force).epsilon(0).margin(1e-12));
      CHECK(chords.moment == Approx(moment).epsilon(0).margin(1e-12 * std::max(1.0, k)));  // a difference, M^h - k F
    }
  }
}

TEST_CASE("the exact law by integration over the disc and over its chords", "[contact_patch][route]") {
  const ContactPatch hertz = patch(0.5);
  for (double k : ratios) {
    CAPTURE(k);
    const auto [force, moment] = HertzLaw{}({k, 1});
    for (const Resistance& found : {hertz.over_disc({k, 1}), hertz.over_chords(k)}) {
      CHECK(found.force == Approx(force).epsilon(0).margin(1e-12));
      CHECK(found.moment == Approx(moment).epsilon(0).margin(1e-12 * std::max(1.0, k)));
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

TEST_CASE("slip of the paper: (1.2) without cos(theta) is N f outside and 0 inside", "[contact_patch][limit]") {
  const ContactPatch hertz = patch(0.5);
  for (double k : ratios) {
    CAPTURE(k);
    // As printed: (3 N f/pi) Int_0^theta* Q_1 for k > 1, (3 N f/(2 pi)) Int_0^pi Q_1 for k <= 1; Q_1 of the print is
    // (2 pi/3) times the one relative to the load.
    const auto q1 = [&](double theta) { return hertz.chord_moment(1, theta, k); };
    const double printed =
        k > 1 ? 2 * integral(q1, 0, std::asin(1 / k)) : integral(q1, 0, pi / 2) + integral(q1, pi / 2, pi);
    CHECK(printed == Approx(k > 1 ? 1 : 0).margin(1e-9));
    CHECK(std::abs(printed - HertzLaw{}({k, 1}).force) > 2e-4);
  }
}

TEST_CASE("slip of the paper: M^h from 0 to 2 pi counts every chord twice", "[contact_patch][limit]") {
  const ContactPatch hertz = patch(0.5);
  constexpr double faint = 1e-9;
  const auto q2 = [&](double theta) { return hertz.chord_moment(2, theta, faint); };
  CHECK(integral(q2, 0, 2 * pi) == Approx(3 * pi / 8).epsilon(1e-8));
  CHECK(integral(q2, 0, pi) == Approx(HertzLaw{}({0, 1}).moment).epsilon(1e-8));
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
