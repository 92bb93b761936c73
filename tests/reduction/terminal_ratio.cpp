#include "contensou/reduction/reduced_system.hpp"

#include <cmath>
#include <random>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/tabulated_pressure_law.hpp"
#include "octic_law.hpp"

using namespace contensou::reduction;

namespace {

/// Returns the only end of a law for this r.
TerminalRatio end_of(const Law& law, double r) {
  const TerminalRatios ratios = terminal_ratios(law, r);
  REQUIRE(ratios.ends.size() == 1);
  return ratios.ends.front();
}

}  // namespace

TEST_CASE("published and closed terminal ratios", "[terminal_ratio][table]") {
  const auto ratio = [](const char* law, double r) { return end_of(*find_law(law), r).k; };
  // Reference for a flat uniform disc: Farkas, Bartels, Unger, Wolf, Phys. Rev. Lett. 90, 248302 (2003).
  CHECK(ratio("uniform", 2) == Approx(0.653001789205597639).epsilon(1e-14));
  CHECK(ratio("uniform", 3) == Approx(1).epsilon(1e-14));
  CHECK(ratio("ring", 1) == Approx(1).epsilon(1e-14));
  CHECK(ratio("exact", 2.5) == Approx(std::sqrt((32 - std::sqrt(544.0)) / 30)).epsilon(1e-14));
  // Under the Pade law the ray satisfies A + B k = 0 with A = 8 (2 - r), B = 3 pi (5 - r).
  CHECK(ratio("pade", 3) == Approx(8 / (3 * std::acos(-1.0) * 2)).epsilon(1e-14));
}

TEST_CASE("the ray exists between p + 3/2 and 2 (p + 2)", "[terminal_ratio][limit]") {
  const auto bounds = [](const char* law, double low, double high) {
    for (double r : {0.9 * low, (low + high) / 2, 1.1 * high}) {
      const TerminalRatios ratios = terminal_ratios(*find_law(law), r);
      const TerminalRatio ratio = end_of(*find_law(law), r);
      CAPTURE(law, r);
      CHECK(ratios.low == Approx(low).epsilon(1e-14));
      CHECK(ratios.high == Approx(high).epsilon(1e-14));
      const auto wanted = r < low ? TerminalRegime::zero : r < high ? TerminalRegime::ray : TerminalRegime::infinity;
      CHECK(ratio.regime == wanted);
      CHECK((ratio.k == 0) == (wanted == TerminalRegime::zero));
      CHECK(std::isinf(ratio.k) == (wanted == TerminalRegime::infinity));
    }
  };
  bounds("pade", 2, 5);
  bounds("exact", 2, 5);
  bounds("uniform", 1.5, 4);
  bounds("punch", 1, 3);
  bounds("ring", 0.5, 2);
}

TEST_CASE("what is no r is rejected", "[terminal_ratio][domain]") {
  for (double r : {0.0, -1.0, std::nan(""), double{INFINITY}})
    CHECK_THROWS_AS(terminal_ratios(PadeLaw{}, r), std::domain_error);
}

TEST_CASE("Phi/(k Psi) need not grow: every ray is found", "[terminal_ratio]") {
  const Law law = contensou::tests::OcticLaw{};
  CHECK(terminal_ratios(law, 1.99).rays.empty());
  const TerminalRatios disc = terminal_ratios(law, 2);
  REQUIRE(disc.rays.size() == 1);
  REQUIRE(disc.ends.size() == 1);
  CHECK(disc.rays[0].k == Approx(0.2081).epsilon(1e-3));
  CHECK((disc.ends[0].regime == TerminalRegime::ray && disc.ends[0].from == 0 && std::isinf(disc.ends[0].to)));
  for (double r : {1.991, 1.995, 1.9999}) {
    CAPTURE(r);
    const TerminalRatios two = terminal_ratios(law, r);
    REQUIRE(two.rays.size() == 2);
    REQUIRE(two.ends.size() == 2);
    for (const InvariantRay& ray : two.rays) {
      const auto [force, moment] = law({ray.k, 1});
      CHECK(force / (r * ray.k * moment) == Approx(1).epsilon(1e-14));
    }
    CHECK((!two.rays[0].attracts_above && !two.rays[0].attracts_below));
    CHECK(two.rays[1].attracts());
    CHECK(two.end_of(0.5 * two.rays[0].k).regime == TerminalRegime::zero);
    CHECK(two.end_of(two.rays[0].k).k == two.rays[0].k);
    CHECK(two.end_of(1.01 * two.rays[0].k).k == two.rays[1].k);
    CHECK(two.end_of(1e9).k == two.rays[1].k);
  }
}

// Tests (R33) of reduction/numerics.md.
TEST_CASE("no pressure on a disc has a ray for r <= 1/2, and some have one just above", "[terminal_ratio][limit]") {
  std::mt19937 random(40);
  std::uniform_real_distribution<double> share(0, 1);
  for (int table = 0; table < 20; ++table) {
    // Pressures have steps at random radii; most of them are narrow peaks. Every fourth table is a ring at the rim.
    Eigen::ArrayXd rho(6), pressure(6);
    for (double& each : rho) each = share(random);
    if (table % 4 == 0) rho.tail(2) << 1 - 1e-3 * share(random), 1;
    std::sort(rho.begin(), rho.end());
    rho[0] = 0;
    rho[5] = 1;
    for (double& each : pressure) each = table % 4 == 0 ? 0 : std::pow(share(random), 8);
    pressure.tail(2) = 1;
    const Law law = TabulatedPressureLaw("random", rho, pressure);
    INFO("rho " << rho.transpose() << "  pressure " << pressure.transpose());
    const TerminalRatios ratios = terminal_ratios(law, 0.5);
    CHECK(ratios.rays.empty());
    CHECK(ratios.ends.front().regime == TerminalRegime::zero);
    CHECK(ratios.low >= 0.5);
    CHECK(ratios.high >= 2);
    for (double k = 1e-3; k < 1e3; k *= 1.5) {
      const auto [force, moment] = law({k, 1});
      CHECK(force > k * moment / 2);
    }
  }
  CHECK(terminal_ratios(*find_law("ring"), 0.5).rays.empty());
  CHECK(terminal_ratios(*find_law("ring"), 0.501).rays.size() == 1);
}

TEST_CASE("a ray that Phi/(k Psi) only touches attracts from one side", "[terminal_ratio][limit]") {
  const Law law = contensou::tests::OcticLaw{};
  // Find the minimum of Phi/(k Psi) over k by golden section.
  const auto ratio = [&](double k) { return law({k, 1}).force / (k * law({k, 1}).moment); };
  double low = 0.1, high = 0.2;
  for (int i = 0; i < 80; ++i) {
    const double a = high - 0.618 * (high - low), b = low + 0.618 * (high - low);
    (ratio(a) < ratio(b) ? high : low) = ratio(a) < ratio(b) ? b : a;
  }
  const TerminalRatios touching = terminal_ratios(law, ratio(low));
  REQUIRE(touching.rays.size() == 1);
  CHECK((touching.rays[0].attracts_above && !touching.rays[0].attracts_below));
  CHECK(touching.rays[0].k == Approx(low).epsilon(touching.rays[0].accuracy));
  REQUIRE(touching.ends.size() == 2);
  CHECK(touching.ends[1].from == touching.rays[0].k);
}

TEST_CASE("a ray next to an axis is as accurate as it says", "[terminal_ratio][limit]") {
  for (double gap : {1e-3, 1e-6, 1e-9}) {
    const double r = 2 * (1 + gap), far_r = 5 * (1 - gap);
    const InvariantRay ray = terminal_ratios(HertzLaw{}, r).rays.at(0);
    // k* solves 4 (4 - s) = r (8 - 8 s + 3 s^2), s = k^2. The smaller root needs no subtraction; r - 2 = 2 gap.
    const double b = 8 * r - 4, c = 8 * (r - 2);
    const double s = 2 * c / (b + std::sqrt(b * b - 12 * r * c));
    CAPTURE(gap, ray.accuracy);
    CHECK(std::abs(ray.k / std::sqrt(s) - 1) <= ray.accuracy);
    CHECK(ray.accuracy < 1e-14 / gap);
    // Under the Pade law k* solves A + B k = 0, (R40).
    for (double r_pade : {r, far_r}) {
      const InvariantRay pade = terminal_ratios(PadeLaw{}, r_pade).rays.at(0);
      CHECK(std::abs(pade.k / (8 * (r_pade - 2) / (3 * std::acos(-1.0) * (5 - r_pade))) - 1) <= pade.accuracy);
      CHECK(pade.accuracy < 1e-14 / gap);
    }
  }
}
