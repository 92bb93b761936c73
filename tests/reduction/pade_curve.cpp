#include "contensou/reduction/pade_curve.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <boost/math/quadrature/exp_sinh.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using std::numbers::pi;

namespace {

constexpr double patch_ratios[] = {1e-6, 1e-4, 0.01, 0.05, 0.1, 0.3, 0.7, 1.0};
constexpr double starts[] = {1e-6, 1e-2, 0.3, 1.0, 4.0, 50.0, 1e4, 1e6};

double r_of_ball(double mu) { return 5 * mu * mu / 7; }

/// The printed orbit of the ball and the integral that is left of the time, all in the paper's letters.
struct PrintedBall {
  double mu;
  double A = 8 * (14 - 5 * mu * mu);
  double B = 15 * pi * (7 - mu * mu);
  double a = 5 * mu * mu / (14 - 5 * mu * mu);
  double b = 21 * mu * mu / ((14 - 5 * mu * mu) * (7 - mu * mu));

  /// u/u0 on the orbit through k0.
  double u(double k, double k0) const { return std::pow(k / k0, a) * std::pow((A + B * k0) / (A + B * k), b); }

  /// d(tau* - P)/dk for u0 = 1: the limit k -> 0 is taken off, so that only k^a is left of the singularity.
  double rest_rate(double k, double k0) const { return 15 * pi * mu * u(k, k0) * (8 + 3 * pi * k) / (A + B * k); }
};

/// tau* - P - S for u0 = 1, by the curve and by the expansions of small mu.
double third_term(double mu, double k0) {
  const PadeCurve curve(r_of_ball(mu));
  return 3 * pi / 7 * mu * k0 * (curve.sliding_coefficient(std::log(k0)) - 1);
}

double dilogarithm_of_minus(double z) {
  boost::math::quadrature::tanh_sinh<double> rule;
  return -rule.integrate([z](double t) { return t == 0 ? z : std::log1p(z * t) / t; }, 0.0, 1.0);
}

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

TEST_CASE("the closed stop time is the separated quadrature", "[pade_curve][route]") {
  boost::math::quadrature::tanh_sinh<double> finite;
  boost::math::quadrature::exp_sinh<double> infinite;
  WorstCase by_k("integral over k"), by_log("integral over ln(k0/k)");
  for (double mu : patch_ratios) {
    const PrintedBall ball{mu};
    const PadeCurve curve(r_of_ball(mu));
    for (double k0 : starts) {
      const std::string where = fmt::format("mu = {}, k0 = {}", mu, k0);
      const double pivoting = 16 / (5 * mu);
      const double closed = pivoting + 3 * pi / 7 * mu * k0 * curve.sliding_coefficient(std::log(k0));
      const double over_k =
          finite.integrate([&](double k) { return k == 0 ? 0 : ball.rest_rate(k, k0); }, 0.0, k0, 1e-15);
      by_k.add(pivoting + over_k, closed, where);
      // Where k underflows nothing is left.
      const double over_log = infinite.integrate(
          [&](double x) {
            const double k = k0 * std::exp(-x);
            return k == 0 ? 0 : k * ball.rest_rate(k, k0);
          },
          0.0, infinity, 1e-15);
      by_log.add(pivoting + over_log, closed, where);
      // The share itself, not hidden behind P.
      by_k.add(over_k / (3 * pi / 7 * mu * k0), curve.sliding_coefficient(std::log(k0)), where + " (m)");
    }
  }
  CHECK_WITHIN_EPS(by_k, 200);
  CHECK_WITHIN_EPS(by_log, 200);
}

TEST_CASE("for small mu the closed form follows E1 and E2 with their orders", "[pade_curve][limit]") {
  for (double k0 : {0.5, 10.0, 400.0}) {
    double first_before = 0;
    double second_before = 0;
    for (double mu : {0.1, 0.05, 0.025, 0.0125}) {
      const PrintedBall ball{mu};
      const double e1 = 24.0 / 35 * mu * std::log1p(15 * pi / 16 * k0);
      const double z = ball.B * k0 / ball.A;
      const double ln_z = std::log1p(z);
      const double e2 = 24 * mu / (5 * (7 - mu * mu)) *
                        (ln_z + 5 * mu * mu / 14 * dilogarithm_of_minus(z) + 3 * mu * mu / 28 * ln_z * ln_z);
      const double first = std::abs(third_term(mu, k0) - e1);
      const double second = std::abs(third_term(mu, k0) - e2);
      CAPTURE(k0, mu, first, second);
      CHECK(second < first / 50);
      if (first_before > 0) {
        CHECK(first_before / first == Approx(8).epsilon(0.1));
        CHECK(second_before / second == Approx(32).epsilon(0.25));
      }
      first_before = first;
      second_before = second;
    }
  }
  // The error that theory states for mu = 0.1, u0 = v0 = 1.
  CHECK(third_term(0.1, 10) - 24.0 / 350 * std::log1p(150 * pi / 16) == Approx(-4.6e-4).epsilon(0.02));
}

TEST_CASE("the sliding coefficient runs from 5/2 to 1", "[pade_curve][limit]") {
  for (double r : {1e-20, 1e-6, 0.1, 5.0 / 7, 1.0}) {
    const PadeCurve curve(r);
    CAPTURE(r);
    CHECK(curve.sliding_coefficient(-700) == Approx(2.5).epsilon(1e-15));
    CHECK(curve.sliding_coefficient(1e6) == 1);
    CHECK(curve.sliding_coefficient(-1e300) == Approx(2.5).epsilon(1e-15));
    double before = 2.5 * (1 + 4e-16);
    for (double ln_k = -45; ln_k < 60; ln_k += 0.5) {
      const double here = curve.sliding_coefficient(ln_k);
      CAPTURE(ln_k);
      CHECK(here <= before * (1 + 1e-15));
      CHECK(here >= 1);
      before = here;
    }
  }
}

TEST_CASE("the logarithm of the rim speed has slope a at 0 and e at infinity", "[pade_curve][limit]") {
  for (double r : {1e-8, 0.1, 1.0}) {
    const PadeCurve curve(r);
    CHECK((curve.ln_w(-800) - curve.ln_w(-1200)) / 400 == Approx(curve.a()).epsilon(1e-13));
    CHECK((curve.ln_w(1200) - curve.ln_w(800)) / 400 == Approx(curve.e()).epsilon(1e-13));
    CHECK(std::isfinite(curve.ln_w(-1e300)));
  }
}

TEST_CASE("the two series of the regularised time meet at x = 1/2", "[pade_curve][limit]") {
  WorstCase age("b");
  for (double r : {1e-20, 1e-10, 1e-5, 1e-2, 0.2, 0.5, 5.0 / 7, 1.0}) {
    const PadeCurve curve(r);
    const double ln_k = std::log(curve.A() / curve.B());
    age.add(curve.beta_coefficient(ln_k - 1e-15), curve.beta_coefficient(ln_k + 1e-15), fmt::format("r = {}", r));
  }
  CHECK_WITHIN_EPS(age, 24);
}

TEST_CASE("the regularised time is the integral of dtau over the weight", "[pade_curve][route]") {
  boost::math::quadrature::exp_sinh<double> rule;
  WorstCase age("b");
  for (double r : {1e-8, 1e-3, 0.1, 5.0 / 7, 1.0}) {
    const PadeCurve curve(r);
    for (double ln_k : {-9.0, -3.0, -0.5, 0.0, 0.7, 3.0, 12.0}) {
      const double rim = curve.ln_w(ln_k);
      const auto rate = [&](double x) {
        const double k = std::exp(ln_k + x);
        if (!std::isfinite(k * k)) return 0.0;
        const auto [force, moment] = PadeLaw{}({k, 1});
        return k * std::exp(rim - curve.ln_w(ln_k + x)) /
               ((force - r * k * moment) * (16 + 15 * pi * k) * (8 + 3 * pi * k));
      };
      age.add((1 + std::exp(ln_k)) * rule.integrate(rate, 0.0, infinity), curve.beta_coefficient(ln_k),
              fmt::format("r = {}, ln k = {}", r, ln_k));
    }
  }
  CHECK_WITHIN_EPS(age, 200);
}

TEST_CASE("the closed form has a domain", "[pade_curve][domain]") {
  for (double bad : {0.0, -1.0, 1.0000001, 3.0, infinity, static_cast<double>(NAN)}) {
    CHECK_THROWS_AS(PadeCurve(bad), std::domain_error);
  }
  CHECK_THROWS_WITH(PadeCurve(1.5), Catch::Matchers::Contains("PadeCurve") && Catch::Matchers::Contains("1.5"));
  CHECK_NOTHROW(PadeCurve(PadeCurve::max_r));
  CHECK(PadeCurve(0.25).r() == 0.25);
}
