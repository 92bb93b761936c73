#include "contensou/reduction/paper_system.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "contensou/reduction/pade_law.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;

TEST_CASE("the printed equations are the reduced system of the Pade ball", "[paper_system][route]") {
  WorstCase field("(2.6)"), regularised("(2.7)"), weight("(2.8)"), slope("dv/du");
  for (double mu : {1e-6, 1e-3, 0.1, 0.7, 1.0, 3.0}) {
    const ReducedSystem system(PadeLaw{}, mu);
    for (double u : {-1e8, -2.0, -1e-6, 1e-6, 0.3, 5.0}) {
      for (double v : {1e-12, 1e-3, 0.5, 7.0, 1e9}) {
        const State state{u, v};
        const std::string where = fmt::format("mu = {}, u = {}, v = {}", mu, u, v);
        field.add(paper::field(mu, state).u, system.field(state).u, where);
        field.add(paper::field(mu, state).v, system.field(state).v, where);
        regularised.add(paper::regularised_field(mu, state).u, system.regularised_field(state).u, where);
        regularised.add(paper::regularised_field(mu, state).v, system.regularised_field(state).v, where);
        weight.add(paper::regularising_weight(mu, state), system.regularising_weight(state), where);
        slope.add(paper::slope(mu, state), system.slope(state), where);
      }
    }
  }
  CHECK_WITHIN_EPS(field, 8);
  CHECK_WITHIN_EPS(regularised, 8);
  CHECK_WITHIN_EPS(weight, 4);
  CHECK_WITHIN_EPS(slope, 8);
}

TEST_CASE("on the axes the printed equations have the reduced system's limits", "[paper_system][limit]") {
  const ReducedSystem system(PadeLaw{}, 0.1);
  for (const State state : {State{2, 0}, State{-2, 0}, State{0, 2}}) {
    CHECK(paper::field(0.1, state).u == Approx(system.field(state).u).epsilon(1e-15));
    CHECK(paper::field(0.1, state).v == Approx(system.field(state).v).epsilon(1e-15));
  }
  CHECK(paper::regularised_field(0.1, {0, 0}).u == 0);
  CHECK(std::isnan(paper::field(0.1, {0, 0}).u));
  CHECK(std::isnan(paper::slope(0.1, {0, 0})));
}
