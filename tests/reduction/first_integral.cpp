#include "contensou/reduction/first_integral.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/direct_motion.hpp"
#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/similarity_solution.hpp"

using namespace contensou::reduction;

TEST_CASE("the first integral is constant along the steps of (2.6)", "[first_integral][invariant]") {
  for (const Law& law : {Law(PadeLaw{}), Law(HertzLaw{})}) {
    for (double mu : {1e-3, 0.3, 1.0}) {
      const ReducedSystem system(law, mu);
      const auto solution = similarity_solution(law, system.r());
      const State start{-2, 3};
      const double wanted = log_first_integral(system, solution, start);
      const Motion motion = integrate_directly(system, start);
      long compared = 0;
      for (Eigen::Index i = 0; i < motion.points.rows(); ++i) {
        if (!std::isnormal(motion.points.v[i])) continue;
        const State here{motion.points.u[i], motion.points.v[i]};
        CHECK(log_first_integral(system, solution, here) == Approx(wanted).margin(1e-10));
        ++compared;
      }
      CHECK(compared > 50);
    }
  }
}

TEST_CASE("it tells orbits apart and is shifted by ln c under scaling", "[first_integral][symmetry]") {
  const ReducedSystem system(HertzLaw{}, 0.5);
  const auto solution = similarity_solution(system.law(), system.r());
  const double here = log_first_integral(system, solution, {1, 2});
  CHECK(log_first_integral(system, solution, {7, 14}) == Approx(here + std::log(7)).epsilon(1e-14));
  CHECK(log_first_integral(system, solution, {-1, 2}) == here);
  CHECK(std::abs(log_first_integral(system, solution, {1.1, 2}) - here) > 0.05);
}

TEST_CASE("for the Pade law it is the printed product of powers", "[first_integral][table]") {
  using std::numbers::pi;
  const double mu = 0.4;
  const ReducedSystem system(PadeLaw{}, mu);
  const auto solution = similarity_solution(system.law(), system.r());
  const double A = 8 * (14 - 5 * mu * mu), B = 15 * pi * (7 - mu * mu);
  const double a = 5 * mu * mu / (14 - 5 * mu * mu);
  const double b = 21 * mu * mu / ((14 - 5 * mu * mu) * (7 - mu * mu));
  const auto printed = [&](State at) {
    const double k = at.v / (mu * at.u);
    return std::log(at.u) - a * std::log(k) + b * std::log(A + B * k);
  };
  const State reference{1, 1};
  for (const State at : {State{2, 0.1}, State{0.01, 5}, State{3, 1e-9}}) {
    CHECK(log_first_integral(system, solution, at) - log_first_integral(system, solution, reference) ==
          Approx(printed(at) - printed(reference)).epsilon(1e-13));
  }
}

TEST_CASE("it has no value on the axes", "[first_integral][domain]") {
  const ReducedSystem system(PadeLaw{}, 0.4);
  const auto solution = similarity_solution(system.law(), system.r());
  for (const State at : {State{0, 1}, State{1, 0}, State{0, 0}, State{1, -1}, State{std::nan(""), 1}}) {
    CHECK_THROWS_AS(log_first_integral(system, solution, at), std::domain_error);
  }
}
