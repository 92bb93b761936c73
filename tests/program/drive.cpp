#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "run_program.hpp"

using Catch::Matchers::Contains;

TEST_CASE("stop with a drive: by every route one time, within its bounds", "[cli]") {
  const std::string start = "stop --mu 0.1 --u0 1 --v0 1 --drive 0.05 --format json";
  const auto best = json_of(start);
  const double tau = best.at("tau_stop").get<double>();
  CHECK(best.at("drive") == 0.05);
  CHECK(best.at("route") == "quadrature");
  for (const std::string route : {"regularised", "direct"})
    CHECK(json_of(start + " --route " + route).at("tau_stop").get<double>() == Approx(tau).epsilon(1e-10));
  CHECK(best.at("bounds")[0].get<double>() <= tau);
  CHECK(tau <= best.at("bounds")[1].get<double>());
  // It takes longer than without, and without says nothing of a drive.
  const auto free = json_of("stop --mu 0.1 --u0 1 --v0 1 --format json");
  CHECK(tau > free.at("tau_stop").get<double>());
  CHECK_FALSE(free.contains("drive"));
  CHECK(json_of("stop --mu 0.1 --u0 1 --v0 1 --drive 0 --format json") == free);
  // Without spin it is (3 pi/7) v0/(1 - rho).
  CHECK(json_of("stop --mu 0.1 --u0 0 --v0 1 --drive 0.05 --format json").at("tau_stop").get<double>() ==
        Approx(3 * M_PI / 7 / 0.95).epsilon(1e-14));
  CHECK_THAT(run_program("stop --mu 0.1 --u0 1 --v0 1 --drive 0.05").out,
             Contains("drive 0.05 of f N") && Contains("creeps while it spins"));
}

TEST_CASE("orbit, terminal and check take a drive", "[cli]") {
  const auto ends = json_of("terminal --mu 0.1 --drive 0.05 --format json");
  CHECK(ends.at("limit") == "ray");
  CHECK(ends.at("drive") == 0.05);
  const double k = ends.at("k_star").get<double>();
  CHECK(json_of("terminal --mu 0.1 --drive 0.9999 --format json").at("limit") == "infinity");
  // What only spins creeps, to that ratio.
  const auto rows = rows_of(run_program("orbit --mu 0.1 --u0 1 --v0 0 --drive 0.05 --samples 20").out);
  REQUIRE(rows.size() == 21);
  CHECK(std::stod(rows[1][4]) == 0);
  CHECK(std::stod(rows[15][4]) == Approx(k).epsilon(1e-9));
  const Run check = run_program("check --mu 0.1 --u0 1 --v0 1 --drive 0.05");
  CHECK(check.status == 0);
  CHECK_THAT(check.out, Contains("start of creeping"));
}

TEST_CASE("what is no drive is refused", "[cli][errors]") {
  check_rejected("stop --mu 0.1 --u0 1 --v0 1 --drive 1", "--drive 1: friction is at most 1 in this unit");
  check_rejected("stop --mu 0.1 --u0 1 --v0 1 --drive -0.1", "against the slip");
  check_rejected("stop --mu 0.1 --u0 1 --v0 1 --drive 1e-200", "0, or 1e-100 or more");
  check_rejected("stop --ball pool --drive 0.1", "exclude each other");
  check_rejected("stop --mu 0.1 --u0 1 --v0 1 --drive 0.1 --estimate", "no estimate with a drive");
  check_rejected("stop --mu 0.1 --u0 1 --v0 1 --drive 0.1 --route closed", "does not have this route");
}
