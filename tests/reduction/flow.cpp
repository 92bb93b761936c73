#include "contensou/reduction/flow.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/stop_time.hpp"

using namespace contensou::reduction;
using Catch::Matchers::Contains;

TEST_CASE("one flow answers for all motions of a system", "[flow][route]") {
  for (const Law& law : paper_laws()) {
    for (double mu : {0.01, 0.5, 3.0}) {
      const ReducedSystem system(law, mu, homogeneous_ball);
      const Flow flow(system), by_quadrature = Flow::by_quadrature(system);
      CHECK(flow.terminal().low == terminal_ratios(law, system.r()).low);
      const std::vector<double> u0{1, -2, 0, 3}, v0{1, 0.1, 2, 0};
      std::vector<double> taus(u0.size());
      flow.stop_times(u0, v0, taus);
      for (std::size_t i = 0; i < u0.size(); ++i) {
        const State start{u0[i], v0[i]};
        const StopTime stop = flow.stop_time(start);
        CAPTURE(law.name(), mu, start.u, start.v);
        CHECK(stop.tau == Approx(flow.orbit(start).stop_time()).epsilon(1e-14));
        CHECK(stop.tau == Approx(taus[i]).epsilon(2e-15));
        CHECK(by_quadrature.is_by_quadrature());
        CHECK(flow.is_by_quadrature() == (routes(system).front() == Route::quadrature));
      }
    }
  }
}

TEST_CASE("copies of a flow share what is solved, and its table is released", "[flow]") {
  const Flow flow(HertzLaw{}, 0.3);
  const Flow copy = flow;
  CHECK(flow.solution().through(0) == copy.solution().through(0));
  std::weak_ptr<const SimilarityCurve> curve;
  {
    const Flow other(HertzLaw{}, 0.4);
    curve = other.solution().through(0);
    CHECK(other.refused(Flow::many_starts) == 0);
  }
  CHECK(curve.expired());
}

// In earlier versions, Orbit accepted the solution of another system without a message: 10.8252 instead of 10.8269.
TEST_CASE("a solution of another system is refused", "[flow][domain]") {
  const ReducedSystem system(HertzLaw{}, 0.3);
  CHECK_THROWS_WITH(Flow(system, quadrature_solution(HertzLaw{}, 0.1, terminal_ratios(HertzLaw{}, 0.1))),
                    Contains("Flow: a solution for r = 0.1"));
  CHECK_THROWS_WITH(Flow(system, SimilaritySolution()), Contains("no curve"));

  // For 2 < r < 5 two curves lead to the k* of this law. The curves of another law lead to another k*.
  const ReducedSystem puck(HertzLaw{}, 1, {.chi = 1, .gamma = 2.5});
  const SimilaritySolution right = quadrature_solution(HertzLaw{}, 2.5, terminal_ratios(HertzLaw{}, 2.5));
  CHECK(Flow(puck, right).stop_time({1, 1}).tau == Flow(puck).stop_time({1, 1}).tau);
  CHECK_THROWS_WITH(Flow(puck, right.curves().front()), Contains("no curve"));
  CHECK_THROWS_WITH(
      Flow(puck, quadrature_solution(*find_law("uniform"), 2.5, terminal_ratios(*find_law("uniform"), 2.5))),
      Contains("tends to"));
  CHECK_THROWS_WITH(Flow({HertzLaw{}, 1, {.chi = 1, .gamma = 1.5}},
                         quadrature_solution(*find_law("ring"), 1.5, terminal_ratios(*find_law("ring"), 1.5))),
                    Contains("where law exact"));
}

TEST_CASE("the first integral is constant along the steps of (2.6)", "[flow][invariant]") {
  for (const Law& law : paper_laws()) {
    for (double mu : {1e-3, 0.3, 1.0}) {
      const Flow flow({law, mu, homogeneous_ball});
      const State start{-2, 3};
      const double wanted = flow.log_first_integral(start.u, std::log(start.v));
      const Motion motion = integrate_directly(flow.system(), start);
      long compared = 0;
      for (Eigen::Index i = 0; i < motion.points.rows(); ++i) {
        if (!std::isnormal(motion.points.v[i])) continue;
        CHECK(flow.log_first_integral(motion.points.u[i], motion.points.ln_v[i]) == Approx(wanted).margin(1e-10));
        ++compared;
      }
      CHECK(compared > 50);
    }
  }
}

TEST_CASE("the first integral is shifted by ln c under scaling, and has no value on the axes", "[flow][symmetry]") {
  const Flow flow(HertzLaw{}, 0.5);
  const double ln_2 = std::log(2), ln_7 = std::log(7);
  const double here = flow.log_first_integral(1, ln_2);
  CHECK(flow.log_first_integral(7, ln_2 + ln_7) == Approx(here + ln_7).epsilon(1e-14));
  CHECK(flow.log_first_integral(-1, ln_2) == here);
  CHECK(std::abs(flow.log_first_integral(1.1, ln_2) - here) > 0.05);
  for (const State at : {State{0, 1}, State{1, 0}, State{0, 0}, State{1, -1}, State{std::nan(""), 1}}) {
    CHECK_THROWS_AS(flow.log_first_integral(at.u, std::log(at.v)), std::domain_error);
  }
}

TEST_CASE("the first integral has no value on an invariant ray, and one beside it", "[flow][symmetry]") {
  const ReducedSystem puck(*find_law("uniform"), 1, {.chi = 1, .gamma = 2});
  const Flow flow(puck);
  REQUIRE(flow.terminal().rays.size() == 1);
  const double ln_k = std::log(flow.terminal().rays.front().k);
  for (double u : {-1.0, 1e-3, 40.0}) {
    CAPTURE(u);
    const double ln_v = ln_k + std::log(std::abs(u));
    CHECK_THROWS_WITH(flow.log_first_integral(u, ln_v), Contains("no value on the invariant ray k = 0.653"));
    for (double aside : {-1e-9, 1e-9}) {
      const double here = flow.log_first_integral(u, ln_v + aside);
      CHECK(std::isfinite(here));
      CHECK(flow.log_first_integral(2 * u, ln_v + aside + std::log(2)) == Approx(here + std::log(2)).epsilon(1e-6));
    }
  }
}
