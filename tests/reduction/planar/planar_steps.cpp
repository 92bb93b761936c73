#include "contensou/reduction/planar_reduction.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace contensou::reduction;
using Catch::Matchers::Contains;
using Eigen::Vector2d;

TEST_CASE("orbits by steps are those of closed forms, in any order of times", "[planar]") {
  const PlanarReduction oscillator = by_steps([](const Vector2d& x) { return Vector2d(x[1], -x[0]); });
  CHECK(oscillator.form().empty());
  CHECK(oscillator.scaling() == nullptr);
  CHECK_THROWS_AS(oscillator.factor({1, 0}), std::domain_error);
  CHECK_THROWS_AS(oscillator.first_integral({1, 0}), std::domain_error);
  const PlanarOrbit orbit = oscillator.orbit({1, 0}), back = oscillator.reversed().orbit({1, 0});
  CHECK(orbit.end() == PlanarEnd::undecided);
  CHECK(std::isnan(orbit.end_time()));
  for (double t : {5.0, 0.0, 1.3, 20.0, 3.0}) {
    CHECK((orbit.at(t) - Vector2d(std::cos(t), -std::sin(t))).norm() < 2e-11);
    CHECK((back.at(t) - Vector2d(std::cos(t), std::sin(t))).norm() < 2e-11);
  }
  CHECK_THROWS_AS(orbit.at(-1), std::domain_error);
}

TEST_CASE("steps see jumps of the field", "[planar]") {
  // u'' = -sign u: from rest at u = 1/2 the motion reaches u = 0 at t = 1 and meets u = 0 again after each time 2.
  const PlanarOrbit relay =
      by_steps([](const Vector2d& x) { return Vector2d(x[1], x[0] > 0 ? -1.0 : 1.0); }).orbit({0.5, 0});
  CHECK((relay.at(2) - Vector2d(-0.5, 0)).norm() < 1e-9);
  CHECK((relay.at(4) - Vector2d(0.5, 0)).norm() < 1e-9);
}

TEST_CASE("steps end where a field does, and after a limit of their number", "[planar]") {
  const PlanarOrbit blows_up = by_steps([](const Vector2d& x) { return Vector2d(1, x[1] * x[1]); }).orbit({0, 1});
  CHECK((blows_up.at(0.9) - Vector2d(0.9, 10)).norm() < 1e-9);
  CHECK_THROWS_WITH(blows_up.at(1.1), Contains("steps follow this orbit to the time 0.99999"));
  CHECK((blows_up.at(0.5) - Vector2d(0.5, 2)).norm() < 1e-11);
}
