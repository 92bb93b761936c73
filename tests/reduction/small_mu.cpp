#include "contensou/reduction/small_mu.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>

#include <boost/math/special_functions/lambert_w.hpp>
#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "user_laws.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using std::numbers::pi;

namespace {

std::map<std::string, double> estimates(const ReducedSystem& system, State start) {
  std::map<std::string, double> all;
  for (const StopEstimate& estimate : small_mu_estimates(system, start)) all[std::string(estimate.name)] = estimate.tau;
  return all;
}

/// Returns the largest relative error of one estimate over some k0.
double worst_error(const Law& law, const std::string& name, double mu, const std::vector<double>& ratios,
                   const Inertia& body = {}) {
  const ReducedSystem system(law, mu, body);
  double worst = 0;
  for (double k0 : ratios) {
    const State start{1, mu * k0};
    worst = std::max(worst, std::abs(estimates(system, start).at(name) / Flow(system).stop_time(start).tau - 1));
  }
  return worst;
}

/// Returns d ln(error)/d ln(mu), computed from the errors at mu and mu/2.
double observed_order(const Law& law, const std::string& name, double mu, const std::vector<double>& ratios,
                      const Inertia& body = {}) {
  return std::log2(worst_error(law, name, mu, ratios, body) / worst_error(law, name, mu / 2, ratios, body));
}

struct MotionErrors {
  double u = 0;     ///< relative error
  double ln_v = 0;  ///< absolute error
};

/// Returns the largest errors of SmallMuMotion over twentieths of a time.
MotionErrors motion_errors(const ReducedSystem& system, State start, double time, int twentieths) {
  const Orbit exact = Flow(system).orbit(start);
  const SmallMuMotion estimate(system, start);
  MotionErrors worst;
  for (int i = 1; i <= twentieths; ++i) {
    const double tau = time * i / 20;
    const OrbitPoint point = exact.at_time(tau);
    const auto speeds = estimate.at_time(tau);
    worst.u = std::max(worst.u, std::abs(speeds.u / point.u - 1));
    worst.ln_v = std::max(worst.ln_v, std::abs(speeds.ln_v - point.ln_v));
  }
  return worst;
}

/// Returns the largest errors from the start to 19/20 of the stop time.
MotionErrors motion_errors(const ReducedSystem& system, State start) {
  return motion_errors(system, start, Flow(system).stop_time(start).tau, 19);
}

}  // namespace

TEST_CASE("E1 and E2 are of the orders 4 and 6 in mu at any one k0", "[small_mu][limit]") {
  for (const Law& law : named_laws()) {
    for (double k0 : {0.1, 1.0, 10.0}) {
      CAPTURE(law.name(), k0);
      // The largest mu is 0.05: above it the next order matters. At mu = 0.0125 E2 is as accurate as the stop time.
      CHECK(observed_order(law, "E1", 0.025, {k0}) == Approx(4).margin(0.04));
      CHECK(observed_order(law, "E2", 0.05, {k0}) == Approx(6).margin(0.15));
    }
  }
}

TEST_CASE("E1 and E2 are of these orders uniformly in k0, less their logarithms", "[small_mu][limit]") {
  std::vector<double> ratios;
  for (double ln_k = -5; ln_k <= 20; ln_k += 0.25) ratios.push_back(std::exp(ln_k));
  for (const Law& law : paper_laws()) {
    CAPTURE(law.name());
    double last1 = infinity;
    double last2 = infinity;
    for (double mu : {0.2, 0.1, 0.05, 0.025}) {
      // Errors are proportional to mu^4 ln^2 mu and mu^6 ln^3 mu; the worst k0 is near 1/mu^2. The factors fall.
      const double factor1 = worst_error(law, "E1", mu, ratios) / (std::pow(mu, 4) * std::pow(std::log(mu), 2));
      const double factor2 = worst_error(law, "E2", mu, ratios) / (std::pow(mu, 6) * std::pow(-std::log(mu), 3));
      CAPTURE(mu, factor1, factor2);
      CHECK(factor1 < last1);
      CHECK(factor2 < last2);
      CHECK(factor1 < 0.065);
      CHECK(factor2 < 0.0135);
      last1 = factor1;
      last2 = factor2;
    }
    CHECK(last1 > 0.02);
    CHECK(last2 > 0.002);
  }
}

TEST_CASE("E1 and E2 of the Pade ball are those of the textbook formula", "[small_mu][table]") {
  const double mu = 0.1;
  const double x = std::log1p(15 * pi / (16 * mu));
  const auto got = estimates({PadeLaw{}, mu}, {1, 1});
  CHECK(got.at("E1") == Approx(16 / (5 * mu) + 3 * pi / 7 + 24.0 / 35 * mu * x).epsilon(1e-15));
  const double exact = Flow(PadeLaw{}, mu).stop_time({1, 1}).tau;
  CHECK(got.at("E1") - exact == Approx(4.6e-4).epsilon(0.02));
  CHECK(std::abs(got.at("E2") - exact) == Approx(2.5e-7).epsilon(0.02));
  CHECK(got.count("log") == 0);
}

TEST_CASE("the first order of the Pade law is elementary", "[small_mu][route]") {
  for (double k : {1e-20, 1e-6, 0.02, 0.9, 1.0, 4.0, 1e3, 1e9, 1e25}) {
    CAPTURE(k);
    const double z = 15 * pi / 16 * k;
    CHECK(coefficient_expansion(PadeLaw{}, std::log(k)).first == Approx(1 + 1.5 * std::log1p(z) / z).epsilon(1e-13));
  }
}

TEST_CASE("the first order of the exact law is elementary inside k = 1", "[small_mu][route]") {
  for (double k : {1e-6, 1e-3, 0.1, 0.5, 0.99, 1.0}) {
    const double closed = 16 / (3 * pi) * (3 * k * k / 8 + std::log1p(-k * k / 4) / 2) / k;
    CAPTURE(k);
    CHECK(coefficient_expansion(HertzLaw{}, std::log(k)).first == Approx(closed).epsilon(1e-13));
  }
}

TEST_CASE("the logarithm of the exact law, and the wrong sign of that of the Pade law", "[small_mu][limit]") {
  const auto far = far_coefficient(HertzLaw{});
  REQUIRE(far);
  CHECK(far->logarithm == Approx(16 / (15 * pi)).epsilon(1e-13));
  CHECK(far->constant == Approx(0.533332074046791).margin(1e-9));
  CHECK_FALSE(far_coefficient(PadeLaw{}));

  // The slope d (k m0 - k)/d ln k, from a decade of k, is -16/(15 pi) for the exact law and 8/(5 pi) for the Pade law.
  const auto logarithm = [](const Law& law) {
    const auto excess = [&](double k) { return k * coefficient_expansion(law, std::log(k)).first - k; };
    return (excess(1e5) - excess(1e4)) / std::log(10.0);
  };
  CHECK(logarithm(HertzLaw{}) == Approx(-16 / (15 * pi)).epsilon(1e-3));
  CHECK(logarithm(PadeLaw{}) == Approx(8 / (5 * pi)).epsilon(1e-3));

  for (const Law& law : named_laws()) {
    const auto tail = far_coefficient(law);
    if (!tail) continue;
    // The omitted terms of the expansion fall like 1/k.
    const auto rest = [&](double k) {
      return k * coefficient_expansion(law, std::log(k)).first - k + tail->logarithm * std::log(k) + tail->constant;
    };
    CAPTURE(law.name());
    CHECK(std::abs(rest(1e3)) < 1e-3);
    CHECK(rest(2e2) / rest(1e3) == Approx(5).epsilon(0.05));
  }
}

TEST_CASE("estimates on the axes are exact, and no ratio of speeds is too large", "[small_mu][limit]") {
  for (const Law& law : named_laws()) {
    const ReducedSystem system(law, 0.01);
    for (const auto& [name, tau] : estimates(system, {0, 3})) {
      CAPTURE(law.name(), name);
      CHECK(tau == system.sliding_limit(3));
    }
    for (const auto& [name, tau] : estimates(system, {-3, 0})) CHECK(tau == system.pivoting_limit(3));
    CHECK(estimates(system, {3, 0}).size() == 2);
    CHECK(estimates(system, {0, 0}).at("E2") == 0);
    for (const State start : {State{1, 1e-300}, State{1e-300, 1}, State{1e-300, 1e300}, State{1e300, 1e-300},
                              State{1e-300, 1e-300}, State{-1e305, 1e305}, State{5e-324, 1}}) {
      const double exact = Flow(system).stop_time(start).tau;
      for (const auto& [name, tau] : estimates(system, start)) {
        CAPTURE(law.name(), start.u, start.v, name);
        CHECK(tau == Approx(exact).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("what is not small has no estimate", "[small_mu][domain]") {
  CHECK_THROWS_WITH(small_mu_estimates({HertzLaw{}, 1, {1, 2}}, {1, 1}), Catch::Matchers::Contains("r << 2"));
  CHECK_THROWS_AS(small_mu_estimates({PadeLaw{}, 0.1}, {1, -1}), std::domain_error);
  CHECK_THROWS_AS(coefficient_expansion(PadeLaw{}, infinity), std::domain_error);
}

TEST_CASE("the motion for small mu is of the orders 4 in u and 2 in ln v at any one k0", "[small_mu][limit]") {
  for (const Law& law : named_laws()) {
    for (double k0 : {0.1, 1.0, 10.0}) {
      CAPTURE(law.name(), k0);
      const double mu = 0.025;
      const ReducedSystem system(law, mu, homogeneous_ball), half(law, mu / 2, homogeneous_ball);
      const State start{1, mu * k0}, half_start{1, mu / 2 * k0};
      const MotionErrors whole = motion_errors(system, start), whole_of_half = motion_errors(half, half_start);
      CHECK(std::log2(whole.u / whole_of_half.u) == Approx(4).margin(0.05));
      CHECK(std::log2(whole.ln_v / whole_of_half.ln_v) == Approx(2).margin(0.05));
      // Times up to 3 sliding times. For k0 = 10 the leading error of ln v is small, so that the next order matters.
      const MotionErrors layer = motion_errors(system, start, system.sliding_limit(start.v), 60);
      const MotionErrors layer_of_half = motion_errors(half, half_start, half.sliding_limit(half_start.v), 60);
      CHECK(std::log2(layer.u / layer_of_half.u) == Approx(4).margin(0.06));
      CHECK(std::log2(layer.ln_v / layer_of_half.ln_v) == Approx(2).margin(0.2));
    }
  }
}

TEST_CASE("the motion for small mu is of these orders uniformly in k0, less their logarithms", "[small_mu][limit]") {
  for (const Law& law : paper_laws()) {
    CAPTURE(law.name());
    MotionErrors last{infinity, infinity};
    for (double mu : {0.1, 0.05, 0.025, 0.0125}) {
      MotionErrors factor;
      for (double ln_k = -5; ln_k <= 20; ln_k += 0.25) {
        const MotionErrors errors = motion_errors({law, mu}, {1, mu * std::exp(ln_k)});
        factor.u = std::max(factor.u, errors.u / std::pow(mu * mu * std::log(mu), 2));
        factor.ln_v = std::max(factor.ln_v, errors.ln_v / std::pow(mu * std::log(mu), 2));
      }
      CAPTURE(mu, factor.u, factor.ln_v);
      CHECK(factor.u < last.u);
      CHECK(factor.ln_v < last.ln_v);
      CHECK(factor.u < 1.1);
      CHECK(factor.ln_v < 3.1);
      last = factor;
    }
    CHECK(last.u > 0.6);
    CHECK(last.ln_v > 1.8);
  }
}

TEST_CASE("the layer of the Pade ball is Lambert's W", "[small_mu][route]") {
  using boost::math::lambert_w0;
  const double mu = 0.01, u0 = -2;
  for (double k0 : {1e-3, 0.3, 4.0, 150.0}) {
    const State start{u0, mu * 2 * k0};
    const double scale = 8 * mu * 2 / (3 * pi);
    const double z = 3 * pi * k0 / 8;
    const SmallMuMotion motion({PadeLaw{}, mu}, start);
    for (double fraction : {0.0, 0.2, 0.7, 0.95}) {
      CAPTURE(k0, fraction);
      const double tau = fraction * 3 * pi / 7 * start.v;
      CHECK(motion.at_time(tau).v == Approx(scale * lambert_w0(z * std::exp(z - 7 * tau / (16 * mu)))).epsilon(1e-12));
    }
  }
}

TEST_CASE("the motion for small mu begins at the start, slows down, and stops at E1", "[small_mu][limit]") {
  for (const Law& law : named_laws()) {
    for (double mu : {1e-8, 0.01, 0.3, 1.0, 1.6, 2.0, 3.0}) {
      const ReducedSystem system(law, mu, homogeneous_ball);
      for (const State start : {State{1, 1}, State{-1, 1e-9}, State{1, 1e-300}, State{1e-300, 1}, State{-1e-300, 1e300},
                                State{1e290, 1e-300}, State{5e-324, 1}, State{0, 3}, State{-3, 0}}) {
        const SmallMuMotion motion(system, start);
        CAPTURE(law.name(), mu, start.u, start.v, motion.stop_time());
        if (mu < 0.5) CHECK(motion.stop_time() == Approx(estimates(system, start).at("E1")).epsilon(1e-12));
        SmallMuMotion::Speeds last = motion.at_time(0);
        CHECK(last.u == start.u);
        CHECK(last.v == start.v);
        CHECK(last.ln_v == std::log(start.v));
        for (double fraction : {1e-12, 1e-4, 0.01, 0.3, 0.5, 0.7, 0.99, 1 - 1e-12}) {
          const auto speeds = motion.at_time(fraction * motion.stop_time());
          CHECK(speeds.v >= 0);
          CHECK(speeds.ln_v <= last.ln_v);
          CHECK(speeds.u * start.u >= 0);
          if (mu < 0.5) CHECK(std::abs(speeds.u) <= std::abs(last.u) * (1 + 1e-14));
          CHECK(std::isfinite(speeds.u));
          last = speeds;
        }
        for (double factor : {1.0, 2.0, infinity}) {
          const auto rest = motion.at_time(factor * motion.stop_time());
          CHECK(rest.u == 0);
          CHECK(rest.v == 0);
          CHECK(rest.ln_v == -infinity);
        }
      }
    }
  }
  CHECK(SmallMuMotion({PadeLaw{}, 0.1}, {0, 0}).at_time(0).v == 0);
  for (const State start : {State{2, 0}, State{0, 2}}) {
    const SmallMuMotion motion({PadeLaw{}, 0.1}, start);
    const Orbit exact = Flow(PadeLaw{}, 0.1).orbit(start);
    for (double tau : {0.5, 1.5, 2.6}) {
      CHECK(motion.at_time(tau).u == Approx(exact.at_time(tau).u).epsilon(1e-14));
      CHECK(motion.at_time(tau).v == Approx(exact.at_time(tau).v).epsilon(1e-14));
    }
  }
  CHECK_THROWS_AS(SmallMuMotion({PadeLaw{}, 0.1}, {1, -1}), std::domain_error);
  CHECK_THROWS_AS(SmallMuMotion({PadeLaw{}, 0.1}, {1, 1}).at_time(-1), std::domain_error);
}
