#include "check/hertz_inner_orbit.hpp"

#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/laws.hpp"
#include "reference_table.hpp"
#include "similarity/curves.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

TEST_CASE("inside k = 1 the exact orbit is elementary: table", "[hertz_inner_orbit][table]") {
  WorstCase rim("ln(u/u0)");
  for (const ReferenceRow& row : reference_table("trajectory_hertz")) {
    const double mu = row.input("mu");
    const double u0 = std::abs(row.input("u0"));
    const double k0 = row.input("v0") / (mu * u0);
    const auto k = static_cast<double>(row.result("k"));
    if (!(k0 <= 1) || !(k > 1e-300)) continue;
    const double r = 5 * mu * mu / 7;
    const long double wanted = std::log(std::abs(row.result("u")) / u0);
    const double got = hertz_inner_ln_w(r, k) - hertz_inner_ln_w(r, k0);
    // The allowed error includes the rounding of u/u0 in long double and of r ln k.
    rim.add(wanted, got, 1e-3 + std::abs(wanted) + r * (1 + std::abs(std::log(k))), row.where());
  }
  CHECK_WITHIN_EPS(rim, 16);
}

TEST_CASE("inside k = 1 the exact orbit is elementary: quadrature", "[hertz_inner_orbit][route]") {
  WorstCase rim("ln w");
  for (double r : {1e-20, 1e-12, 1e-6, 1e-3, 0.1, 0.5, 5.0 / 7, 1.0, 1.5, 1.9}) {
    const QuadratureCurve curve(HertzLaw{}, r);
    for (double k : {1e-15, 1e-9, 1e-3, 0.1, 0.5, 0.8, 0.99, 0.9999999}) {
      const double got = hertz_inner_ln_w(r, k) - hertz_inner_ln_w(r, 1);
      const double wanted = curve.ln_w(std::log(k)) - curve.ln_w(0);
      // The difference Phi - r k Psi vanishes as r tends to 2, so the allowed error grows.
      rim.add(wanted, got, (std::abs(wanted) + r) * 2 / (2 - r), fmt::format("r = {}, k = {}", r, k));
    }
  }
  CHECK_WITHIN_EPS(rim, 200);
}

TEST_CASE("for r -> 0 the exponents keep their digits", "[hertz_inner_orbit][limit]") {
  // ln w/r -> (1/4) Int (8 - 8 s + 3 s^2)/(k (4 - s)) dk = (1/8) [2 ln s - 3 s - 6 ln(1 - s/4)], s = k^2.
  for (double r : {1e-300, 1e-20, 1e-14, 1e-10}) {
    for (double k : {1e-8, 0.01, 0.3, 0.7, 1.0}) {
      const double s = k * k;
      const double limit = (2 * std::log(s) - 3 * s - 6 * std::log1p(-s / 4)) / 8;
      CAPTURE(r, k);
      CHECK(hertz_inner_ln_w(r, k) / r == Approx(limit).margin(1e-15 + 20 * r).epsilon(1e-14 + 10 * r));
    }
  }
}

TEST_CASE("the elementary orbit ends at k = 1 and at r = 2", "[hertz_inner_orbit][domain]") {
  for (double bad : {0.0, -0.5, std::nextafter(1.0, 2.0), not_a_number})
    CHECK_THROWS_AS(hertz_inner_ln_w(0.5, bad), std::domain_error);
  for (double bad : {0.0, -0.5, 2.0, not_a_number}) CHECK_THROWS_AS(hertz_inner_ln_w(bad, 0.5), std::domain_error);
  CHECK_THROWS_WITH(hertz_inner_ln_w(2.5, 0.5),
                    Catch::Matchers::Contains("hertz_inner_ln_w") && Catch::Matchers::Contains("2.5"));
  CHECK_NOTHROW(hertz_inner_ln_w(1.999, 1));
}
