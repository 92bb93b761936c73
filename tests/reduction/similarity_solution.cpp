#include "contensou/reduction/detail/similarity_solution.hpp"

#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "octic_law.hpp"
#include "similarity/curves.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

namespace {

/// Returns a flat puck with the mass at its rim: r = mu^2, and mu can be any number.
ReducedSystem puck(const Law& law, double r) { return {law, std::sqrt(r), {.chi = 1, .gamma = 1}}; }

}  // namespace

TEST_CASE("the solution that is used is the closed one where there is one", "[similarity_solution]") {
  const auto used = [](const Law& law, double r) { return Flow(puck(law, r)).solution().through(0); };
  CHECK(dynamic_cast<const PadeCurve*>(used(PadeLaw{}, 0.5).get()));
  CHECK(dynamic_cast<const QuadratureCurve*>(used(PadeLaw{}, 1.5).get()));
  CHECK(dynamic_cast<const QuadratureCurve*>(used(HertzLaw{}, 0.5).get()));
  CHECK(used(HertzLaw{}, 0.25)->r() == 0.25);
  CHECK(closed_solution(PadeLaw{}, 1e-20).through(0)->r() == 1e-20);
  CHECK(closed_solution(PadeLaw{}, PadeCurve::max_r));
  CHECK_FALSE(closed_solution(PadeLaw{}, std::nextafter(PadeCurve::max_r, 1)));
  CHECK_FALSE(closed_solution(HertzLaw{}, 0.1));
}

TEST_CASE("each k has the curve of its side of the ray", "[similarity_solution]") {
  const SimilaritySolution solution = quadrature_solution(HertzLaw{}, 2.5, terminal_ratios(HertzLaw{}, 2.5));
  const double ln_k_star = std::log(std::sqrt((32 - std::sqrt(544.0)) / 30));
  CHECK(solution.through(ln_k_star + 0.1)->chart().side() == TerminalChart::Side::above);
  CHECK(solution.through(ln_k_star - 0.1)->chart().side() == TerminalChart::Side::below);
  for (double ln_k : {-30.0, 30.0}) {
    CHECK(solution.through(ln_k)->chart().log_terminal_ratio() == Approx(ln_k_star).epsilon(1e-14));
  }
  CHECK_THROWS_AS(SimilaritySolution().through(0), std::domain_error);
  CHECK_FALSE(SimilaritySolution());
}

TEST_CASE("the stop time is continuous in r through both edges", "[similarity_solution][limit]") {
  for (const char* name : {"pade", "exact", "uniform", "punch", "ring"}) {
    const Law law = *find_law(name);
    const TerminalRatios edges = terminal_ratios(law, 1e-3);
    for (double edge : {edges.low, edges.high}) {
      for (double k : {1e-9, 1e-3, 0.5, 1.0, 20.0, 1e6}) {
        const auto stop = [&](double r) {
          const ReducedSystem system = puck(law, r);
          return Flow::by_quadrature(system).orbit({1, k * system.mu()}).stop_time();
        };
        CAPTURE(name, edge, k);
        const double here = stop(edge);
        for (double shift : {1e-15, 1e-13, 1e-12, 2e-12, 1e-10, 1e-8}) {
          // The stop time changes with r less than 1/sqrt(r) does.
          CHECK(stop(edge * (1 + shift)) == Approx(here).epsilon(shift + 1e-13));
          CHECK(stop(edge * (1 - shift)) == Approx(here).epsilon(shift + 1e-13));
        }
      }
    }
  }
}

TEST_CASE("a motion is what is left of it, in every regime", "[similarity_solution][invariant]") {
  WorstCase left("tau left");
  for (const char* name : {"pade", "exact", "ring"}) {
    for (double r : {0.1, 1.0, 1.9999999, 2.0, 2.3, 4.5, 5.0, 6.0, 1e3}) {
      const Law law = *find_law(name);
      const ReducedSystem system = puck(law, r);
      const Flow flow = Flow::by_quadrature(system);
      for (double k : {1e-6, 0.4, 1.0, 30.0}) {
        const Orbit orbit = flow.orbit({1, k * system.mu()});
        for (double step : {0.0, 0.01, 0.5, 5.0}) {
          const double xi = orbit.start_coordinate() - step;
          const OrbitPoint there = orbit.at_coordinate(xi);
          const Orbit::Remaining remaining = orbit.remaining_at_coordinate(xi);
          left.add(flow.orbit({there.u, there.v}).stop_time(), remaining.tau_left,
                   fmt::format("{}, r = {}, k = {}, step {}", name, r, k, step));
          CHECK(remaining.u == Approx(there.u).epsilon(1e-13));
          CHECK(remaining.v == Approx(there.v).epsilon(1e-13));
          CHECK(remaining.ln_v == Approx(there.ln_v).epsilon(1e-13).margin(1e-13));
        }
        for (double share : {0.9, 0.5, 0.01, 1e-9}) {
          const OrbitPoint point = orbit.at_time_left(share * orbit.stop_time());
          if (!std::isnormal(point.u) || !std::isnormal(point.v)) continue;
          left.add(share * orbit.stop_time(), flow.orbit({point.u, point.v}).stop_time(),
                   fmt::format("{}, r = {}, k = {}, {}", name, r, k, share));
        }
      }
    }
  }
  CHECK_WITHIN_EPS(left, 1000);
}

TEST_CASE("a start on a ray stays on it", "[similarity_solution][invariant]") {
  // The first ray is tested. The octic law has two rays, of which the first repels.
  for (const auto& [law, r] :
       {std::pair{Law(HertzLaw{}), 2.2}, {HertzLaw{}, 2.5}, {HertzLaw{}, 4.0}, {OcticLaw{}, 1.995}}) {
    const ReducedSystem system = puck(law, r);
    const double k = terminal_ratios(system.law(), system.r()).rays.front().k;
    const State start{1, k * system.mu()};
    const Orbit orbit = Flow(system).orbit(start);
    CAPTURE(law.name(), r);
    // On the ray both speeds fall linearly.
    CHECK(orbit.stop_time() ==
          Approx(start.v / (system.scaled_time_rate() * system.law()({k, 1}).force)).epsilon(1e-13));
    for (double share : {0.9, 0.4, 1e-3}) {
      const OrbitPoint point = orbit.at_time_left(share * orbit.stop_time());
      CHECK(point.u == Approx(share).epsilon(1e-13));
      CHECK(point.v == Approx(share * start.v).epsilon(1e-10));
      CHECK(point.k == Approx(k).epsilon(1e-10));
    }
  }
}

// Phi/(k Psi) of OcticLaw is 2 at k = 0 and has a minimum, 1.9909 at k = 0.144. One ray repels, the other attracts.
TEST_CASE("a law with several rays has a curve on each side of each", "[similarity_solution]") {
  const Law law = OcticLaw{};
  CHECK(quadrature_solution(law, 1.99, terminal_ratios(law, 1.99)).curves().size() == 1);
  CHECK(quadrature_solution(law, 2, terminal_ratios(law, 2)).curves().size() == 2);
  const SimilaritySolution solution = quadrature_solution(law, 1.995, terminal_ratios(law, 1.995));
  REQUIRE(solution.curves().size() == 3);
  const auto end = [&](double k) { return std::exp(solution.through(std::log(k))->chart().log_terminal_ratio()); };
  CHECK(end(0.08) == 0);
  CHECK(end(0.083) == Approx(0.1889458024).epsilon(1e-9));
  CHECK(end(0.19) == Approx(0.1889458024).epsilon(1e-9));
}
