#include "contensou/reduction/verification.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

namespace {

template <class Visit>
void over_systems_and_states(Visit visit) {
  for (const Law& law : paper_laws()) {
    for (double mu : {1e-3, 0.1, 1.0, 2.5}) {
      const ReducedSystem system(law, mu, homogeneous_ball);
      for (double k : {1e-5, 0.3, 0.9999, 1.0, 1.0001, 1.25, 8.0, 1e5}) {
        for (double u : {-2.0, 3e-6, 7e5}) {
          CAPTURE(law.name(), mu, k, u);
          visit(system, State{u, mu * std::abs(u) * k});
        }
      }
    }
  }
}

}  // namespace

TEST_CASE("the scaling generator is admitted by (2.6), (2.7) and dv/du", "[symmetry]") {
  over_systems_and_states([](const ReducedSystem& system, State state) {
    CHECK(field_symmetry_residual(system, state) < 1e-9);
    CHECK(regularised_symmetry_residual(system, state) < 1e-9);
    CHECK(slope_symmetry_residual(system, state) < 1e-9);
  });
}

TEST_CASE("the finite scaling holds bit for bit for powers of two", "[symmetry]") {
  over_systems_and_states([](const ReducedSystem& system, State state) {
    const Rate here = system.field(state), regularised = system.regularised_field(state);
    for (int power : {-200, -1, 1, 300}) {
      CAPTURE(power);
      const State scaled{std::ldexp(state.u, power), std::ldexp(state.v, power)};
      const Rate there = system.field(scaled), regularised_there = system.regularised_field(scaled);
      CHECK((there.u == here.u && there.v == here.v));
      CHECK(regularised_there.u == std::ldexp(regularised.u, 2 * power));
      CHECK(regularised_there.v == std::ldexp(regularised.v, 2 * power));
    }
  });
}

TEST_CASE("a field without the symmetry, or of another degree, is seen", "[symmetry]") {
  const auto homogeneous = [](State at) { return Rate{at.u * at.v, at.v * at.v}; };
  const State state{0.7, 1.3};
  CHECK(generator_residual(homogeneous, 2, state) < 1e-9);
  CHECK(generator_residual(homogeneous, 0, state) == Approx(2).epsilon(1e-8));
  CHECK(generator_residual(homogeneous, 1, state) == Approx(1).epsilon(1e-8));

  const auto broken = [](State at) { return Rate{at.u + 0.001 * at.u * at.u, at.v}; };
  CHECK(generator_residual(broken, 1, state) > 1e-5);
}

TEST_CASE("canonical coordinates there and back, and the group moves p alone", "[similarity][invariant]") {
  const PlanarReduction plane = reduced(ReducedSystem(PadeLaw{}, 0.1));
  WorstCase back("(u, v) -> (q, p) -> (u, v)");
  for (double u : {-3.0, -1e-200, 1e-7, 0.4, 1e100}) {
    for (double v : {1e-200, 1e-3, 1.0, 25.0, 1e100}) {
      const PlanarCanonical point = plane.canonical({u, v}), moved = plane.canonical({4096 * u, 4096 * v});
      const Eigen::Vector2d state = plane.point(point.q, point.p);
      const double conditioning = 1 + std::abs(point.p);  // the size is exp(p)
      const double size = conditioning * std::hypot(u, v);
      back.add(u, state[0], size, fmt::format("u = {}, v = {}", u, v));
      back.add(v, state[1], size, fmt::format("u = {}, v = {}", u, v));
      CHECK(moved.q == Approx(point.q).epsilon(1e-15));
      CHECK(moved.p - point.p == Approx(12 * std::numbers::ln2).epsilon(1e-13));
    }
  }
  CHECK_WITHIN_EPS(back, 3);
}

TEST_CASE("the separated equation is dv/du in other coordinates", "[similarity][route]") {
  // In q = v/u, p = ln v the slope is dp/dq = 1/(q (1 - q/w)), where w = dv/du.
  WorstCase slope("dp/dq");
  for (const Law& law : paper_laws()) {
    for (double mu : {0.05, 0.9}) {
      const ReducedSystem system(law, mu, homogeneous_ball);
      for (const State state : {State{1, 0.01}, State{-2, 0.1}, State{0.5, 0.5}, State{-1, 30}}) {
        const double q = state.v / state.u;
        slope.add(1 / (q * (1 - q / system.slope(state))), separated_slope(system, q),
                  fmt::format("{}, mu = {}, u = {}, v = {}", law.name(), mu, state.u, state.v));
      }
    }
  }
  CHECK_WITHIN_EPS(slope, 12);
}

TEST_CASE("the axes have no slope in canonical coordinates", "[similarity][domain]") {
  const ReducedSystem system(PadeLaw{}, 0.1);
  for (double bad : {0.0, infinity, not_a_number}) CHECK_THROWS_AS(separated_slope(system, bad), std::domain_error);
}
