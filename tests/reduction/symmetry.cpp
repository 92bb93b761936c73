#include "contensou/reduction/symmetry.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/canonical_coordinates.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pade_law.hpp"
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

TEST_CASE("canonical coordinates there and back", "[similarity][invariant]") {
  WorstCase back("(u, v) -> (q, p) -> (u, v)");
  for (double u : {-3.0, -1e-200, 1e-7, 0.4, 1e100}) {
    for (double v : {1e-200, 1e-3, 1.0, 25.0, 1e100}) {
      const Canonical point = to_canonical({u, v});
      if (point.q == 0 || std::isinf(point.q)) continue;
      const State state = from_canonical(point);
      const std::string where = fmt::format("u = {}, v = {}", u, v);
      const double conditioning = 1 + std::abs(point.p);  // v = exp(p)
      back.add(u, state.u, conditioning * std::abs(u), where);
      back.add(v, state.v, conditioning * v, where);
      CHECK(std::signbit(point.q) == std::signbit(u));
    }
  }
  CHECK_WITHIN_EPS(back, 3);
}

TEST_CASE("the group moves p alone", "[similarity][symmetry]") {
  const Canonical here = to_canonical({-0.75, 0.3});
  const Canonical moved = to_canonical({-0.75 * 4096, 0.3 * 4096});
  CHECK(moved.q == here.q);
  CHECK(moved.p - here.p == Approx(12 * std::numbers::ln2).epsilon(1e-15));
}

TEST_CASE("the separated equation is dv/du in other coordinates", "[similarity][route]") {
  // q = v/u, p = ln v: dp/dq = 1/(q (1 - q/w)) with w = dv/du.
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

TEST_CASE("the axes have no canonical coordinates", "[similarity][domain]") {
  for (const State bad :
       {State{0, 1}, State{1, 0}, State{0, 0}, State{1, -1}, State{not_a_number, 1}, State{1, infinity}}) {
    CAPTURE(bad.u, bad.v);
    CHECK_THROWS_AS(to_canonical(bad), std::domain_error);
  }
  for (const Canonical bad : {Canonical{0, 1}, Canonical{not_a_number, 1}, Canonical{infinity, 1},
                              Canonical{1, infinity}, Canonical{1, not_a_number}}) {
    CAPTURE(bad.q, bad.p);
    CHECK_THROWS_AS(from_canonical(bad), std::domain_error);
  }
  const ReducedSystem system(PadeLaw{}, 0.1);
  for (double bad : {0.0, infinity, not_a_number}) CHECK_THROWS_AS(separated_slope(system, bad), std::domain_error);
}
