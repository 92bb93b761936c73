#include "similarity/curves.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using std::numbers::pi;

namespace {

constexpr double patch_ratios[] = {1e-6, 1e-4, 0.01, 0.05, 0.1, 0.3, 0.7, 1.0};
constexpr double starts[] = {1e-6, 1e-2, 0.3, 1.0, 4.0, 50.0, 1e4, 1e6};

double r_of_ball(double mu) { return 5 * mu * mu / 7; }

/// The orbit of the ball as printed and the remaining integral for the time, in the letters of the paper.
struct PrintedBall {
  double mu;
  double A = 8 * (14 - 5 * mu * mu);
  double B = 15 * pi * (7 - mu * mu);
  double a = 5 * mu * mu / (14 - 5 * mu * mu);
  double b = 21 * mu * mu / ((14 - 5 * mu * mu) * (7 - mu * mu));

  /// Returns u/u0 on the orbit through k0.
  double u(double k, double k0) const { return std::pow(k / k0, a) * std::pow((A + B * k0) / (A + B * k), b); }
};

}  // namespace

TEST_CASE("the closed orbit is the printed one", "[pade_curve][route]") {
  WorstCase orbit("u on the orbit");
  for (double mu : patch_ratios) {
    const PrintedBall ball{mu};
    const PadeCurve curve(r_of_ball(mu));
    CHECK(curve.a() == Approx(ball.a).epsilon(1e-14));
    CHECK(curve.b() == Approx(ball.b).epsilon(1e-14));
    CHECK(curve.A() * 7 == Approx(ball.A).epsilon(1e-14));
    CHECK(curve.B() * 7 == Approx(ball.B).epsilon(1e-14));
    for (double k0 : starts) {
      for (double share : {0.999, 0.5, 1e-3, 1e-9}) {
        const double k = share * k0;
        const double u = std::exp(curve.ln_w(std::log(k)) - curve.ln_w(std::log(k0)));
        orbit.add(ball.u(k, k0), u, fmt::format("mu = {}, k0 = {}, k = {}", mu, k0, k));
      }
    }
  }
  CHECK_WITHIN_EPS(orbit, 64);
}

TEST_CASE("far out the logarithm of the rim speed has its slopes and m its limits", "[pade_curve][limit]") {
  for (double r : {1e-8, 0.1, PadeCurve::max_r}) {
    const PadeCurve curve(r);
    CHECK((curve.ln_w(-800) - curve.ln_w(-1200)) / 400 == Approx(curve.a()).epsilon(1e-13));
    CHECK((curve.ln_w(1200) - curve.ln_w(800)) / 400 == Approx(curve.e()).epsilon(1e-13));
    CHECK(std::isfinite(curve.ln_w(-1e300)));
    CHECK(curve.sliding_coefficient(-1e300) == Approx(2.5).epsilon(1e-15));
    CHECK(curve.sliding_coefficient(1e6) == 1);
  }
}

TEST_CASE("the two series of the regularised time meet at x = 1/2", "[pade_curve][limit]") {
  WorstCase age("b");
  for (double r : {1e-20, 1e-10, 1e-5, 1e-2, 0.2, 0.5, 5.0 / 7, PadeCurve::max_r}) {
    const PadeCurve curve(r);
    const double ln_k = std::log(curve.A() / curve.B());
    age.add(curve.beta_coefficient(ln_k - 1e-15), curve.beta_coefficient(ln_k + 1e-15), fmt::format("r = {}", r));
  }
  CHECK_WITHIN_EPS(age, 24);
}

TEST_CASE("the closed form has a domain", "[pade_curve][domain]") {
  for (double bad : {0.0, -1.0, 1.0000001, 3.0, infinity, static_cast<double>(NAN)}) {
    CHECK_THROWS_AS(PadeCurve(bad), std::domain_error);
  }
  CHECK_THROWS_WITH(PadeCurve(1.5), Catch::Matchers::Contains("PadeCurve") && Catch::Matchers::Contains("1.5"));
  CHECK_NOTHROW(PadeCurve(PadeCurve::max_r));
  CHECK(PadeCurve(0.25).r() == 0.25);
}
