#include "contensou/reduction/terminal_ratio.hpp"

#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/regularised_motion.hpp"

using namespace contensou::reduction;

TEST_CASE("published and closed terminal ratios", "[terminal_ratio][table]") {
  const auto ratio = [](const char* law, double r) { return terminal_ratio(*find_law(law), r).k; };
  // A uniform disc on its own face: Farkas, Bartels, Unger, Wolf, Phys. Rev. Lett. 90, 248302 (2003).
  CHECK(ratio("uniform", 2) == Approx(0.653001789205597639).epsilon(1e-14));
  CHECK(ratio("uniform", 3) == Approx(1).epsilon(1e-14));
  CHECK(ratio("ring", 1) == Approx(1).epsilon(1e-14));
  CHECK(ratio("exact", 2.5) == Approx(std::sqrt((32 - std::sqrt(544.0)) / 30)).epsilon(1e-14));
  // Pade: A + B k = 0, with A = 8 (2 - r), B = 3 pi (5 - r).
  CHECK(ratio("pade", 3) == Approx(8 / (3 * std::acos(-1.0) * 2)).epsilon(1e-14));
}

TEST_CASE("the ray exists between p + 3/2 and 2 (p + 2)", "[terminal_ratio][limit]") {
  const auto bounds = [](const char* law, double low, double high) {
    for (double r : {0.9 * low, (low + high) / 2, 1.1 * high}) {
      const TerminalRatio ratio = terminal_ratio(*find_law(law), r);
      CAPTURE(law, r);
      CHECK(ratio.low == Approx(low).epsilon(1e-14));
      CHECK(ratio.high == Approx(high).epsilon(1e-14));
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

TEST_CASE("a motion ends where the ratio says", "[terminal_ratio][route]") {
  for (const char* law : {"pade", "exact", "uniform", "ring"}) {
    for (double v0 : {0.01, 5.0}) {
      const ReducedSystem disc(*find_law(law), 1, {1, 1.9});
      const double k = terminal_ratio(disc.law(), disc.r()).k;
      const Motion motion = integrate_regularised(disc, {1, v0});
      REQUIRE(motion.outcome.ok());
      double last = 0;
      for (Eigen::Index i = 0; i < motion.points.rows(); ++i) {
        if (motion.points.u[i] > 1e-12) last = motion.points.k[i];
      }
      CAPTURE(law, v0, last);
      if (k == 0) {
        CHECK(last < 0.1);
      } else {
        CHECK(last == Approx(k).epsilon(0.1));  // the approach is a small power of the time left
        CHECK((last < k) == (v0 < k));
      }
    }
  }
}

TEST_CASE("what is no r is rejected", "[terminal_ratio][domain]") {
  for (double r : {0.0, -1.0, std::nan(""), double{INFINITY}})
    CHECK_THROWS_AS(terminal_ratio(PadeLaw{}, r), std::domain_error);
}
