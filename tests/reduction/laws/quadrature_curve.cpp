#include "similarity/curves.hpp"

#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/laws.hpp"
#include "user_laws.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

namespace {

/// A law with noise of about 1e-9, more than the quadrature allows. Equal arguments give equal noise.
struct NoisyLaw {
  Resistance operator()(Slip slip) const {
    const auto [force, moment] = RootLaw{}(slip);
    if (slip.sliding < 1e-9 * slip.pivoting || slip.pivoting == 0) return {force, moment};
    const double noise = 1e-9 * std::sin(1e12 * std::log(slip.sliding / slip.pivoting));
    return {force * (1 + noise), moment * (1 - noise)};
  }
};

}  // namespace

TEST_CASE("the quadrature of the Pade law is its closed form", "[quadrature_curve][route]") {
  WorstCase rim("ln w"), share("m"), age("b"), rate("c"), slip("n");
  for (double r : {1e-20, 1e-8, 1e-4, 0.01, 0.1, 0.4, 5.0 / 7, PadeCurve::max_r}) {
    const QuadratureCurve curve(PadeLaw{}, r);
    const PadeCurve closed(r);
    CHECK(curve.truncation() < 1e-14);
    const double constant = curve.ln_w(0) - closed.ln_w(0);
    for (double ln_k :
         {-1e6, -700.0, -45.0, -40.0, -39.9, -20.0, -3.3, -0.2, 0.0, 0.5, 4.0, 21.7, 43.9, 44.0, 50.0, 700.0}) {
      const std::string where = fmt::format("r = {}, ln k = {}", r, ln_k);
      rim.add(closed.ln_w(ln_k) + constant, curve.ln_w(ln_k), std::abs(closed.ln_w(ln_k)) + r, where);
      share.add(closed.sliding_coefficient(ln_k), curve.sliding_coefficient(ln_k), where);
      age.add(closed.beta_coefficient(ln_k), curve.beta_coefficient(ln_k), where);
      rate.add(closed.time_rate(ln_k), curve.time_rate(ln_k), where);
      // The slip length contains n as v w (n + k/2), so the error of n is relative to n + k/2.
      const double n = closed.slip_length_coefficient(ln_k);
      if (ln_k < 50) slip.add(n, curve.slip_length_coefficient(ln_k), n + std::exp(ln_k) / 2, where);
    }
  }
  CHECK_WITHIN_EPS(rim, 64);
  CHECK_WITHIN_EPS(share, 8);
  CHECK_WITHIN_EPS(age, 64);
  CHECK_WITHIN_EPS(rate, 64);
  CHECK_WITHIN_EPS(slip, 100);
}

TEST_CASE("the exact law's share runs from 0 to 1", "[quadrature_curve][limit]") {
  for (double r : {1e-10, 0.1, 1.0, 1.9}) {
    const QuadratureCurve curve(HertzLaw{}, r);
    CAPTURE(r);
    CHECK(std::abs(curve.sliding_coefficient(-1000)) < 1e-15);
    CHECK(curve.sliding_coefficient(1000) == 1);
    CHECK(curve.sliding_coefficient(44) == Approx(1).epsilon(1e-13));
    for (double ln_k = -40; ln_k <= 44; ln_k += 0.37) {
      CAPTURE(ln_k);
      CHECK(curve.sliding_coefficient(ln_k) >= 0);
      CHECK(curve.sliding_coefficient(ln_k) <= 1 + 1e-14);
      CHECK(curve.beta_coefficient(ln_k) > 0);
    }
  }
}

TEST_CASE("panels join without a step", "[quadrature_curve][limit]") {
  WorstCase share("m"), age("b"), rim("ln w");
  for (const Law& law : {Law(PadeLaw{}), Law(HertzLaw{})}) {
    const QuadratureCurve curve(law, 0.3);
    for (int edge = -40; edge <= 44; ++edge) {
      const double below = std::nextafter(static_cast<double>(edge), -infinity);
      const std::string where = fmt::format("{}, ln k = {}", law.name(), edge);
      const double ln_k = edge;
      share.add(curve.sliding_coefficient(below), curve.sliding_coefficient(ln_k), 1, where);
      age.add(curve.beta_coefficient(below), curve.beta_coefficient(ln_k), where);
      rim.add(curve.ln_w(below), curve.ln_w(ln_k), 1 + std::abs(curve.ln_w(ln_k)), where);
    }
  }
  CHECK_WITHIN_EPS(share, 8);
  CHECK_WITHIN_EPS(age, 16);
  CHECK_WITHIN_EPS(rim, 16);
}

// RootLaw once failed at mu = 1e-4. Below k = 1e-5 the difference 1 - Psi/Psi(0) was only rounding, and the quadrature
// halved panels to depth 40 everywhere.
TEST_CASE("no law costs more than another by much", "[quadrature_curve]") {
  for (double r : {1e-8, 1e-4, 0.06, 0.7}) {
    CAPTURE(r);
    CHECK(QuadratureCurve(RootLaw{}, r).evaluations() < 10'000);
    CHECK(QuadratureCurve(CallOnly<HertzLaw>{}, r).evaluations() < 10'000);
    CHECK(QuadratureCurve(CallOnly<PadeLaw>{}, r).evaluations() < 10'000);
  }
  CHECK(QuadratureCurve(HertzLaw{}, 0.1).evaluations() < 10'000);
  // These laws have a logarithm at k = 1.
  for (const char* name : {"uniform", "punch", "ring"}) {
    for (double r : {1e-6, 0.01, 0.4}) {
      const QuadratureCurve curve(*find_law(name), r);
      CAPTURE(name, r, curve.evaluations());
      CHECK(curve.truncation() < 1e-14);
      CHECK(curve.evaluations() < 20'000);
    }
  }
}

TEST_CASE("a law with noise ends, and says so", "[quadrature_curve]") {
  const QuadratureCurve noisy(NoisyLaw{}, 0.1);
  const QuadratureCurve smooth(RootLaw{}, 0.1);
  CHECK(noisy.evaluations() < 5'000'000);
  CHECK(noisy.truncation() > 1e-13);
  CHECK(noisy.sliding_coefficient(0) == Approx(smooth.sliding_coefficient(0)).epsilon(1e-7));
}

TEST_CASE("the curve is that of one side, and says what is not", "[quadrature_curve][domain]") {
  for (double bad : {0.0, -1.0, infinity, static_cast<double>(NAN)}) {
    CHECK_THROWS_AS(QuadratureCurve(PadeLaw{}, bad), std::domain_error);
  }
  // Under both laws rays exist for r from 2 to 5.
  const TerminalChart to_infinity(TerminalChart::Side::below, infinity);
  for (const Law& law : {Law(PadeLaw{}), Law(HertzLaw{})}) {
    CAPTURE(law.name());
    CHECK_NOTHROW(QuadratureCurve(law, 1.9));
    CHECK_NOTHROW(QuadratureCurve(law, 5.1, to_infinity));
    CHECK_THROWS_WITH(
        QuadratureCurve(law, 2.1),
        Catch::Matchers::Contains("Phi > r k Psi must hold for every k between the terminal ratio 0 and inf") &&
            Catch::Matchers::Contains(law.name()) && Catch::Matchers::Contains("r = 2.1"));
    CHECK_THROWS_WITH(QuadratureCurve(law, 3, to_infinity), Catch::Matchers::Contains("Phi < r k Psi"));
    CHECK_THROWS_AS(QuadratureCurve(law, 6), std::domain_error);
  }
}
