#include "contensou/reduction/small_mu.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pade_law.hpp"
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

/// Relative error of one estimate, at worst over some k0.
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

/// d ln(error)/d ln(mu), from mu and mu/2.
double observed_order(const Law& law, const std::string& name, double mu, const std::vector<double>& ratios,
                      const Inertia& body = {}) {
  return std::log2(worst_error(law, name, mu, ratios, body) / worst_error(law, name, mu / 2, ratios, body));
}

}  // namespace

TEST_CASE("E1 and E2 are of the orders 4 and 6 in mu at any one k0", "[small_mu][limit]") {
  for (const Law& law : named_laws()) {
    for (double k0 : {0.1, 1.0, 10.0}) {
      CAPTURE(law.name(), k0);
      // From mu = 0.05 on: before, the next order is seen; at 0.0125 E2 is as good as the stop time.
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
      // mu^4 ln^2 and mu^6 ln^3: the worst k0 is near 1/mu^2. The factor falls and stays.
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
  const double exact = Flow({PadeLaw{}, mu}).stop_time({1, 1}).tau;
  CHECK(got.at("E1") - exact == Approx(4.6e-4).epsilon(0.02));
  CHECK(std::abs(got.at("E2") - exact) == Approx(1.3e-6).epsilon(0.02));
  CHECK(got.count("log") == 0);
}

TEST_CASE("the general expansion is that of the Pade law", "[small_mu][route]") {
  for (double k : {1e-20, 1e-6, 0.02, 0.9, 1.0, 4.0, 1e3, 1e9, 1e25}) {
    const double ln_k = std::log(k);
    const CoefficientExpansion general = coefficient_expansion(PadeLaw{}, ln_k);
    CAPTURE(k);
    CHECK(general.first == Approx(coefficient_estimates(PadeLaw{}, 0, ln_k).first).epsilon(1e-13));
    // The two differ by their third order.
    const auto difference = [&](double r) {
      return coefficient_estimates(PadeLaw{}, r, ln_k).second - general.first - r * general.second;
    };
    CHECK(std::abs(difference(1e-3)) < 2e-7);
    if (k > 0.01 && k < 1e4) CHECK(difference(2e-2) / difference(1e-2) == Approx(4).epsilon(0.05));
  }
  CHECK(estimates({CallOnly<PadeLaw>{}, 0.1}, {1, 1}).at("E2") ==
        Approx(estimates({PadeLaw{}, 0.1}, {1, 1}).at("E2")).epsilon(1e-6));
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

  // d (k m0 - k)/d ln k, per decade: -16/(15 pi) against 8/(5 pi).
  const auto logarithm = [](const Law& law) {
    const auto excess = [&](double k) { return k * coefficient_expansion(law, std::log(k)).first - k; };
    return (excess(1e5) - excess(1e4)) / std::log(10.0);
  };
  CHECK(logarithm(HertzLaw{}) == Approx(-16 / (15 * pi)).epsilon(1e-3));
  CHECK(logarithm(PadeLaw{}) == Approx(8 / (5 * pi)).epsilon(1e-3));

  for (const Law& law : named_laws()) {
    const auto tail = far_coefficient(law);
    if (!tail) continue;
    // What is left falls like 1/k.
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
