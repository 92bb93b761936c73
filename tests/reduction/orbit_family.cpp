#include "contensou/reduction/orbit_family.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

TEST_CASE("each row of a family is on the orbit of its start", "[orbit_family][route]") {
  // The row's k is read back from its speeds: an error of it counts as much as ln w is steep there.
  WorstCase tau("tau"), u("u"), ln_v("ln v"), beta("beta");
  for (const char* name : {"pade", "exact", "uniform"}) {
    for (double r : {1e-8, 0.05, 0.7, 2.5, 4.5, 6.0}) {
      const ReducedSystem system(*find_law(name), std::sqrt(r), {.chi = 1, .gamma = 1});
      std::vector<State> starts;
      for (double k0 : {1e-6, 0.3, 1.0, 20.0, 1e6}) starts.push_back({-2, 2 * k0 * system.mu()});
      std::vector<State> sampled = starts;
      // So far from the others that their speeds underflow in units of its own.
      if (r == 0.7) sampled.push_back({-2, 2e290 * system.mu()});
      const OrbitFamily family(system, sampled, 80);
      for (const State& start : starts) {
        const Orbit orbit(system, start);
        const OrbitColumns columns = family.orbit(start);
        REQUIRE(columns.rows() > 20);
        CHECK(columns.row(0).u == start.u);
        CHECK(columns.row(0).v == start.v);
        CHECK(columns.row(columns.rows() - 1).tau == orbit.stop_time());
        CHECK(columns.row(columns.rows() - 1).u == 0);
        for (Eigen::Index i = 0; i + 1 < columns.rows(); ++i) {
          const std::string where = fmt::format("{}, r = {}, v0 = {}, row {}", name, r, start.v, i);
          CHECK(columns.tau[i + 1] >= columns.tau[i]);
          if (i == 0) continue;
          // The row's own ln k, on the orbit; what time tells of it is in orbit.cpp.
          const double xi = orbit.approach().coordinate(columns.ln_v[i] - std::log(system.mu() * -columns.u[i]));
          if (!std::isfinite(xi) || xi < orbit.curve().limit() + 1) continue;
          const OrbitPoint point = orbit.at_coordinate(std::min(xi, orbit.start_coordinate()));
          const double digits = (1 + 1 / std::abs(orbit.approach().log_ratio_rate(xi))) * (1 + std::abs(point.ln_v));
          tau.add(point.tau, columns.tau[i], orbit.stop_time() * digits, where);
          u.add(point.u, columns.u[i], std::abs(point.u) * digits, where);
          ln_v.add(point.ln_v, columns.ln_v[i], digits, where);
          beta.add(point.beta, columns.beta[i], digits * (point.beta + 1 / start.v), where);
        }
      }
    }
  }
  CHECK_WITHIN_EPS(tau, 64);
  CHECK_WITHIN_EPS(u, 512);
  CHECK_WITHIN_EPS(ln_v, 512);
  CHECK_WITHIN_EPS(beta, 512);
}

TEST_CASE("after k has come to its limit the rows are evenly spread over the time left", "[orbit_family][limit]") {
  const std::vector<State> starts{{1, 1}};
  const OrbitFamily family(ReducedSystem(PadeLaw{}, 0.1), starts, 40);
  const OrbitColumns columns = family.orbit(starts[0]);
  REQUIRE(columns.rows() == 41);  // the highest instant is the start
  for (Eigen::Index i = 22; i + 1 < columns.rows(); ++i) {
    CHECK(columns.tau[i + 1] - columns.tau[i] == Approx(columns.tau[40] - columns.tau[39]).epsilon(1e-9));
  }
  CHECK(columns.u[30] == Approx(columns.u[20] * 10 / 20).epsilon(0.05));
}

TEST_CASE("on the axes a family has start and stop", "[orbit_family][limit]") {
  const std::vector<State> starts{{1, 0}, {0, 2}, {0, 0}};
  const OrbitFamily family(ReducedSystem(HertzLaw{}, 0.1), starts, 10);
  for (const State& start : starts) {
    const OrbitColumns columns = family.orbit(start);
    REQUIRE(columns.rows() == 2);
    CHECK(columns.u[0] == start.u);
    CHECK(columns.v[0] == start.v);
    CHECK((columns.u[1] == 0 && columns.v[1] == 0));
  }
}

TEST_CASE("what a family cannot be asked", "[orbit_family][domain]") {
  const ReducedSystem system(HertzLaw{}, 0.1);
  const std::vector<State> starts{{1, 1}};
  CHECK_THROWS_AS(OrbitFamily(system, starts, 3), std::domain_error);
  CHECK_THROWS_AS(OrbitFamily(system, std::vector<State>{{1, -1}}, 10), std::domain_error);
  CHECK_THROWS_AS(OrbitFamily(system, starts, 10).orbit({1, -1}), std::domain_error);
  const ReducedSystem puck(HertzLaw{}, 1, {.chi = 1, .gamma = 3});
  CHECK_THROWS_WITH(OrbitFamily(puck, std::vector<State>{{1, 10}}, 10).orbit({1, 1e-3}),
                    Catch::Matchers::Contains("side of the invariant ray"));
}
