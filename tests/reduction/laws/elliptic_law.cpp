// Tests the law whose motions are elementary functions, (R47) of reduction/numerics.md.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <boost/math/quadrature/gauss.hpp>
#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/verification.hpp"

using namespace contensou::reduction;

namespace {

using Real = long double;

/// Returns (R47) divided by w0. Panels integrate over z = -ln y, where y is the fraction of w0 that is left.
Real time_left(Real k0, Real r, Real c) {
  const Real ratio = r * c * c;
  const Real exponent = (1 - ratio) / ratio;
  const Real fades = 45 / (1 + std::min(exponent, Real(0)));
  const Real reach = exponent > 0 ? std::min(fades, (std::max(std::log(k0 / c), Real(0)) + 45) / exponent) : fades;
  const Real width = std::min(Real(0.5), std::abs(Real(0.5) / exponent));
  Real rest = 0;
  for (Real z = 0; z < reach; z += width) {
    rest += boost::math::quadrature::gauss<Real, 20>::integrate(
        [&](Real at) {
          const Real k = k0 * std::exp(-exponent * at);
          return std::exp(-at) * k * (k / (std::hypot(k, c) + c));
        },
        z, z + width);
  }
  return (c + rest) / ratio;
}

}  // namespace

TEST_CASE("an ellipse's motions are powers, wherever k goes", "[laws]") {
  for (double c : {EllipticLaw::hertz_moment, 0.05, 1.0}) {
    for (double r : {1e-4, 0.02, 0.7, 1.0, 2.5, 40.0, 1 / (c * c)}) {
      const ReducedSystem system(EllipticLaw(c), 1, {1, r});
      const Flow flow(system);
      for (double k0 : {1e-6, 0.1, 1.0, 7.0, 1e6}) {
        CAPTURE(c, r, k0);
        const double wanted = static_cast<double>(1.5L * std::numbers::pi_v<Real> * time_left(k0, system.r(), c));
        CHECK(flow.stop_time({1, k0}).tau == Approx(wanted).epsilon(1e-15).margin(0));
        // At half of the stop time, v is proportional to w^(1/(r c^2)).
        const auto half = flow.orbit({1, k0}).at_time(flow.stop_time({1, k0}).tau / 2);
        const double power = 1 / (system.r() * c * c);
        CHECK(half.ln_v == Approx(std::log(k0) + power * std::log(half.u)).margin(1e-11 * (1 + power)));
      }
    }
  }
}

TEST_CASE("an annulus is a disc less a disc", "[laws]") {
  for (double k : {0.01, 0.5, 2.0, 100.0}) {
    CAPTURE(k);
    const auto [force, moment] = (*find_law("annulus:0.65"))({k, 1});
    // An annulus is the outer disc minus the inner disc. The inner disc has the load eta^2 and the ratio k/eta.
    const double eta = 0.65;
    const auto outer = PressureLaw::uniform()({k, 1}), inner = PressureLaw::uniform()({k / eta, 1});
    const double load = 1 - eta * eta;
    CHECK(force == Approx((outer.force - eta * eta * inner.force) / load).epsilon(1e-14));
    CHECK(moment == Approx((outer.moment - eta * eta * eta * inner.moment) / load).epsilon(1e-14));
  }
}

TEST_CASE("a soft finger's pressure is the table's that stands for it", "[laws]") {
  for (double exponent : {1.0, 2.0, 4.0, 12.0, 50.0}) {
    CAPTURE(exponent);
    const Law law = *find_law(fmt::format("soft:{}", exponent));
    const ContactPatch patch([=](double rest) {
      return std::pow(-std::expm1(std::log1p(-rest) * exponent / 2), 1 / exponent);  // with rest = 1 - rho^2
    });
    const auto gamma = [=](double times) { return std::tgamma(times / exponent); };
    CHECK(law.pivoting_moment() == Approx(0.75 * gamma(3) * gamma(3) / (gamma(2) * gamma(4))).epsilon(4e-7));
    for (double k : {0.1, 0.7, 1.0, 1.5, 20.0}) {
      CAPTURE(k);
      const auto [force, moment] = law({k, 1});
      const auto [expected_force, expected_moment] = patch.over_chords(k);
      CHECK(force == Approx(expected_force).epsilon(4e-7));
      CHECK(moment == Approx(expected_moment).epsilon(4e-7));
    }
  }
}
