#include "contensou/reduction/detail/similarity_solution.hpp"

#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "constants.hpp"

using namespace contensou::reduction;
using Side = TerminalChart::Side;

TEST_CASE("towards 0 xi is ln k, towards infinity -ln k", "[chart][limit]") {
  const TerminalChart zero = TerminalChart::to_zero();
  const TerminalChart far(Side::below, infinity);
  for (double ln_k : {-1e20, -700.0, -0.3, 0.0, 2.5, 800.0}) {
    CHECK(zero.coordinate(ln_k) == ln_k);
    CHECK(zero.log_ratio(ln_k) == ln_k);
    CHECK(zero.log_ratio_rate(ln_k) == 1);
    CHECK(far.coordinate(ln_k) == -ln_k);
    CHECK(far.log_ratio(-ln_k) == ln_k);
    CHECK(far.log_ratio_rate(-ln_k) == -1);
    CHECK((zero.reaches(ln_k) && far.reaches(ln_k)));
  }
}

TEST_CASE("xi is the logarithm of the distance to k*", "[chart]") {
  for (double k_star : {1e-9, 0.6, 1.0, 40.0}) {
    const TerminalChart above(Side::above, std::log(k_star));
    const TerminalChart below(Side::below, std::log(k_star));
    CHECK(above.log_terminal_ratio() == std::log(k_star));
    CHECK(below.log_terminal_ratio() == std::log(k_star));
    for (double times : {1.001, 1.5, 3.0, 1e6}) {
      CAPTURE(k_star, times);
      const double k = k_star * times;
      CHECK(above.coordinate(std::log(k)) == Approx(std::log(k - k_star)).epsilon(1e-12));
      CHECK(above.log_ratio(std::log(k - k_star)) == Approx(std::log(k)).margin(1e-12));
      CHECK(above.log_ratio_rate(std::log(k - k_star)) == Approx(1 - k_star / k).epsilon(1e-12));
      const double nearness = std::log(times / k_star - 1 / k_star);
      CHECK(below.coordinate(std::log(k_star / times)) == Approx(nearness).epsilon(1e-12));
      CHECK(below.log_ratio(nearness) == Approx(std::log(k_star / times)).margin(1e-12));
      CHECK(below.log_ratio_rate(nearness) == Approx(-(1 - 1 / times)).epsilon(1e-12));
      CHECK((above.reaches(std::log(k)) && !below.reaches(std::log(k))));
      CHECK((below.reaches(std::log(k_star / times)) && !above.reaches(std::log(k_star / times))));
    }
  }
}

TEST_CASE("on the ray xi is as low as any", "[chart][limit]") {
  for (Side side : {Side::above, Side::below}) {
    const TerminalChart chart(side, 1.5);
    const double nearest = chart.coordinate(1.5);
    CHECK(std::isfinite(nearest));
    CHECK(chart.log_ratio(nearest) == 1.5);
    CHECK(chart.reaches(1.5));
    CHECK(chart.coordinate(side == Side::above ? 1.4 : 1.6) == nearest);
  }
}

TEST_CASE("nothing is above infinity or below 0", "[chart][domain]") {
  CHECK_THROWS_AS(TerminalChart(Side::above, infinity), std::domain_error);
  CHECK_THROWS_AS(TerminalChart(Side::below, -infinity), std::domain_error);
  CHECK_THROWS_AS(TerminalChart(Side::above, std::nan("")), std::domain_error);
}
