#include "contensou/reduction/symmetry.hpp"

#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "user_laws.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

namespace {

template <class Visit>
void over_systems_and_states(Visit visit) {
  std::vector<Law> laws = paper_laws();
  laws.emplace_back(OcticLaw{});
  for (const Law& law : laws) {
    for (double mu : {1e-3, 0.1, 1.0, 2.5}) {
      const ReducedSystem system(law, mu);
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
    const auto field = [&](State at) { return system.field(at); };
    const auto regularised = [&](State at) { return system.regularised_field(at); };
    for (double factor : {0x1p-200, 0.5, 2.0, 0x1p300}) {
      CAPTURE(factor);
      CHECK(scaling_residual(field, 0, state, factor) == 0);
      CHECK(scaling_residual(regularised, 2, state, factor) == 0);
    }
    CHECK(scaling_residual(field, 0, state, 1.7) < 1e-14);
    CHECK(scaling_residual(regularised, 2, state, 1.7) < 1e-14);
  });
}

TEST_CASE("a field without the symmetry, or of another degree, is seen", "[symmetry]") {
  const auto homogeneous = [](State at) { return Rate{at.u * at.v, at.v * at.v}; };
  const State state{0.7, 1.3};
  CHECK(generator_residual(homogeneous, 2, state) < 1e-9);
  CHECK(generator_residual(homogeneous, 0, state) == Approx(2).epsilon(1e-8));
  CHECK(generator_residual(homogeneous, 1, state) == Approx(1).epsilon(1e-8));
  CHECK(scaling_residual(homogeneous, 0, state, 2) == 3);

  const auto broken = [](State at) { return Rate{at.u + 0.001 * at.u * at.u, at.v}; };
  CHECK(generator_residual(broken, 1, state) > 1e-5);
  CHECK(scaling_residual(broken, 1, state, 3) > 1e-5);
}

TEST_CASE("a scaling factor is positive", "[symmetry][domain]") {
  const auto field = [](State at) { return Rate{at.u, at.v}; };
  for (double bad : {0.0, -1.0, static_cast<double>(NAN)}) {
    CHECK_THROWS_AS(scaling_residual(field, 1, {1, 1}, bad), std::domain_error);
  }
}
