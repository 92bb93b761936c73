#include "contensou/reduction/pressure_law.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/special_functions/ellint_d.hpp>
#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "law_checks.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using Catch::Matchers::Contains;
using std::numbers::pi;

namespace {

struct Member {
  PressureLaw law;
  std::string column;
  double pure_pivoting;
  long double steepest;  ///< logarithmic slope next to k = 1: a logarithm for the ring and next to it
};

std::vector<Member> members() {
  return {{PressureLaw::uniform(), "uniform", 2.0 / 3, 1.5L},
          {PressureLaw::punch(), "punch", pi / 4, 2},
          {PressureLaw::ring(), "ring", 1, 16},
          {PressureLaw(-0.3), "pressure:-0.3", 0.7308570430993646509, 2},
          {PressureLaw(1.7), "pressure:1.7", 0.47651048690711417352, 2},
          {PressureLaw(25), "pressure:25", 0.1713458405552413235, 3}};
}

}  // namespace

TEST_CASE("pressure laws keep 4 eps for every k", "[pressure_law][table]") {
  for (const auto& [law, column, pure_pivoting, steepest] : members()) {
    CAPTURE(column);
    check_table(law, column, "laws_pressure", steepest);
    const auto first = reference_table("laws_pressure").front();
    check_moment_deficit(law, column, "laws_pressure", first.result("psi_" + column));
  }
}

TEST_CASE("pressure laws have both limits exactly", "[pressure_law][limit]") {
  for (const auto& [law, column, pure_pivoting, steepest] : members()) {
    CAPTURE(column);
    check_limits(law, pure_pivoting);
    for (double k : {1e-9, 1e-100}) {
      const double p = law.p();
      CHECK(law({k, 1}).force == Approx(pure_pivoting * (p + 1.5) * k).epsilon(1e-15));
      CHECK(law.moment_deficit({k, 1}) == Approx((p + 1.5) / 2 * (k * k)).epsilon(1e-14));
      CHECK(law({1, k}).moment == Approx(k / (2 * (p + 2))).epsilon(1e-15));
    }
  }
}

TEST_CASE("pressure laws are of degree 0, bit for bit", "[pressure_law][symmetry]") {
  for (const Member& member : members()) check_scaling(member.law);
}

TEST_CASE("pressure laws are continuous where their form changes", "[pressure_law][limit]") {
  for (const Member& member : members()) {
    CAPTURE(member.column);
    for (double k : {std::sqrt(0.5), std::sqrt(0.75), std::sqrt(2.0), 0.25, std::sqrt(0.125)}) {
      check_continuity(member.law, k);
    }
    // At k = 1 the ring has infinite slopes: a step of one ulp changes it by 36 of them.
    if (member.law.p() > -0.4) check_continuity(member.law, 1);
  }
}

TEST_CASE("pressure forces rise and pressure moments fall", "[pressure_law][invariant]") {
  for (const Member& member : members()) check_monotone(member.law);
}

TEST_CASE("pressure laws have a dissipation potential", "[pressure_law][invariant]") {
  for (const Member& member : members()) {
    CAPTURE(member.column);
    check_potential(member.law);
  }
}

TEST_CASE("the curve (Phi, Psi) of every pressure is convex", "[pressure_law][invariant]") {
  for (const Member& member : members()) {
    CAPTURE(member.column);
    check_convex(member.law);
  }
}

TEST_CASE("pressure laws reject what is no slip and no exponent", "[pressure_law][domain]") {
  check_domain(PressureLaw(1), "PressureLaw");
  for (double bad : {-1.0, -7.0, std::nextafter(PressureLaw::max_p, 100.0), std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(PressureLaw(bad), std::domain_error);
  }
  CHECK_THROWS_WITH(PressureLaw(-1.5), Contains("PressureLaw") && Contains("-1.5"));
  CHECK(PressureLaw(std::nextafter(-1.0, 0.0))({1, 1}).force == Approx(2 / pi).epsilon(1e-14));
}

TEST_CASE("pressure laws carry their names", "[pressure_law]") {
  CHECK(Law(PressureLaw::uniform()).name() == "uniform");
  CHECK(Law(PressureLaw::punch()).name() == "punch");
  CHECK(Law(PressureLaw::ring()).name() == "ring");
  CHECK(Law(PressureLaw(0.1)).name() == "pressure:0.1");
  CHECK(PressureLaw(0.1).p() == 0.1);
}

TEST_CASE("p = 1/2 is the exact law", "[pressure_law][route]") {
  WorstCase worst("pressure:0.5 against exact");
  for (double k : ratios_of_slip()) {
    const auto exact = HertzLaw{}({k, 1});
    const auto [force, moment] = PressureLaw(0.5)({k, 1});
    worst.add(exact.force, force, fmt::format("k = {}", k));
    worst.add(exact.moment, moment, fmt::format("k = {}", k));
  }
  CHECK_WITHIN_EPS(worst, 6);
}

TEST_CASE("uniform disc and ring by complete elliptic integrals", "[pressure_law][route]") {
  WorstCase uniform("uniform"), ring("ring");
  for (int i = -240; i <= 240; ++i) {
    const long double k = std::exp2(static_cast<long double>(i) / 32);
    const long double modulus = std::min(k, 1 / k);
    if (modulus == 1) continue;
    const long double m = modulus * modulus;
    const long double d = boost::math::ellint_d(modulus);
    const long double b = boost::math::ellint_1(modulus) - d;
    const long double e = boost::math::ellint_2(modulus);
    const long double inverse_pi = std::numbers::inv_pi_v<long double>;
    const std::string where = fmt::format("k = 2^({}/32)", i);
    const auto here = [&](const PressureLaw& law) { return law({static_cast<double>(k), 1}); };
    // k is rounded to a double for the law.
    uniform.add(4 * inverse_pi / 3 * std::min(k, 1.0L) * (2 * b + (1 - m) * d), here(PressureLaw::uniform()).force,
                where);
    if (k < 1) {
      uniform.add(4 * inverse_pi / 9 * ((3 - m) * b + (1 - m) * (3 - 2 * m) * d), here(PressureLaw::uniform()).moment,
                  where);
      ring.add(2 * inverse_pi * k * b, here(PressureLaw::ring()).force, where);
      ring.add(2 * inverse_pi * e, here(PressureLaw::ring()).moment, where);
    } else {
      if (m > 0.25L) {
        uniform.add(4 * inverse_pi / 9 * k * ((1 - m) * d - (1 - 3 * m) * b), here(PressureLaw::uniform()).moment,
                    where);
      }
      ring.add(2 * inverse_pi * e, here(PressureLaw::ring()).force, where);
      ring.add(2 * inverse_pi / k * b, here(PressureLaw::ring()).moment, where);
    }
  }
  CHECK_WITHIN_EPS(uniform, 6);
  CHECK_WITHIN_EPS(ring, 6);
}

TEST_CASE("the flat punch is elementary", "[pressure_law][route]") {
  WorstCase worst("punch");
  for (double k : ratios_of_slip()) {
    const std::string where = fmt::format("k = {}", k);
    const auto [force, moment] = PressureLaw::punch()({k, 1});
    if (k <= 1) {
      worst.add(std::numbers::pi_v<long double> / 4 * k, force, where);
      worst.add(std::numbers::pi_v<long double> / 8 * (2 - static_cast<long double>(k) * k), moment, where);
    } else if (k < 100) {  // both forms cancel beyond
      const long double root = std::sqrt((k - 1.0L) * (k + 1.0L));
      const long double angle = std::atan2(1.0L, root);
      worst.add((k * angle + root / k) / 2, force, where);
      worst.add(((2 - static_cast<long double>(k) * k) * angle + root) / 4, moment, where);
    }
  }
  CHECK_WITHIN_EPS(worst, 6);
}

TEST_CASE("the ring is its own dual: Phi(k) = Psi(1/k)", "[pressure_law][symmetry]") {
  for (double k : {0x1p-300, 0.125, 0.5, 2.0, 64.0}) {
    CAPTURE(k);
    const PressureLaw ring = PressureLaw::ring();
    CHECK(ring({k, 1}).force == Approx(ring({1, k}).moment).epsilon(1e-15));
  }
}

TEST_CASE("the uniform disc turns and slides at k = 0.653 for ever", "[pressure_law][limit]") {
  // chi = 1, gamma = 2: the published terminal ratio of Phi = 2 k Psi.
  const double k = 0.653001789205597639;
  const auto [force, moment] = PressureLaw::uniform()({k, 1});
  CHECK(force == Approx(2 * k * moment).epsilon(1e-15));
}
