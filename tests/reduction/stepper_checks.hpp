#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/motion.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "user_laws.hpp"
#include "worst_case.hpp"

/// What both steppers are asked in the same words.
namespace contensou::tests {

/// A law that breaks down at one k on the way: from_k > k > from_k/1000 has no number.
struct BrokenLaw {
  double from_k = 1e-3;

  reduction::Resistance operator()(reduction::Slip slip) const {
    const bool broken = slip.sliding < from_k * slip.pivoting && slip.sliding > 1e-3 * from_k * slip.pivoting;
    return broken ? reduction::Resistance{NAN, NAN} : RootLaw{}(slip);
  }
};

template <class Integrate>
void check_states(Integrate integrate) {
  using namespace reduction;
  WorstCase stop("stop time"), u("u"), ln_v("ln v"), beta("beta");
  for (const Law& law : paper_laws()) {
    for (double mu : {1e-4, 1e-2, 0.3, 1.0}) {
      for (double k0 : {1e-4, 0.5, 1.0, 7.0, 1e6}) {
        const ReducedSystem system(law, mu);
        const State start{-3, 3 * mu * k0};
        const Orbit orbit = Flow(system).orbit(start);
        const std::string where = fmt::format("{}, mu = {}, k0 = {}", law.name(), mu, k0);
        Eigen::ArrayXd times(9);
        times << 0, 1e-9, 1e-3, 0.1, 0.3, 0.5, 0.5, 0.9, 1.5;
        times *= orbit.stop_time();
        const Motion motion = integrate(system, start, times, StepperSettings{});
        CAPTURE(where, motion.outcome.sentence);
        REQUIRE(motion.outcome.ok());
        CHECK(motion.outcome.sentence == "The body came to rest.");
        CHECK(motion.steps >= 0);
        REQUIRE(motion.points.rows() == times.size());
        stop.add(orbit.stop_time(), motion.stop_time, where);
        const double unit = 1 / (16 * mu * 3 + 15 * std::numbers::pi * start.v);
        for (Eigen::Index i = 0; i + 1 < times.size(); ++i) {
          const OrbitPoint wanted = orbit.at_time(times[i]);
          const OrbitPoint got = motion.points.row(i);
          const std::string instant = where + fmt::format(", tau = {} tau*", times[i] / orbit.stop_time());
          CHECK(got.tau == times[i]);
          u.add(wanted.u, got.u, instant);
          ln_v.add(wanted.ln_v, got.ln_v, 1 + std::abs(wanted.ln_v), instant);
          beta.add(wanted.beta, got.beta, wanted.beta + unit, instant);
        }
        const OrbitPoint rest = motion.points.row(8);
        CHECK(rest.u == 0);
        CHECK(rest.v == 0);
        CHECK(rest.tau == times[8]);
      }
    }
  }
  CHECK_WITHIN_EPS(stop, 3e-11 / 2.2e-16);
  CHECK_WITHIN_EPS(u, 1e-10 / 2.2e-16);
  CHECK_WITHIN_EPS(ln_v, 1e-10 / 2.2e-16);
  CHECK_WITHIN_EPS(beta, 1e-10 / 2.2e-16);
}

template <class Integrate>
void check_every_step(Integrate integrate) {
  using namespace reduction;
  for (const Law& law : paper_laws()) {
    const ReducedSystem system(law, 0.1);
    const Orbit orbit = Flow(system).orbit({2, 1});
    const Motion motion = integrate(system, State{2, 1}, Eigen::ArrayXd{}, StepperSettings{});
    REQUIRE(motion.outcome.ok());
    REQUIRE(motion.points.rows() > 10);
    CHECK(motion.evaluations > motion.steps);
    CHECK(motion.points.u[0] == Approx(2).epsilon(1e-14));
    CHECK(motion.points.v[0] == Approx(1).epsilon(1e-14));
    CHECK(motion.points.tau[0] == 0);
    bool met_one = false;
    for (Eigen::Index i = 1; i < motion.points.rows(); ++i) {
      CAPTURE(law.name(), i);
      CHECK(motion.points.tau[i] >= motion.points.tau[i - 1]);
      CHECK(motion.points.u[i] <= motion.points.u[i - 1]);
      CHECK(motion.points.ln_v[i] <= motion.points.ln_v[i - 1]);
      met_one = met_one || motion.points.k[i] == 1;
      const OrbitPoint point = motion.points.row(i);
      if (point.tau < 0.9 * motion.stop_time) CHECK(orbit.at_time(point.tau).u == Approx(point.u).epsilon(1e-10));
    }
    CHECK(met_one);  // k0 = 5: a step ends where the exact law has no third derivative
    const OrbitPoint last = motion.points.row(motion.points.rows() - 1);
    CHECK(last.tau == motion.stop_time);
    CHECK(last.u == 0);
    CHECK(last.v == 0);
    CHECK(last.beta == std::numeric_limits<double>::infinity());
  }
}

template <class Integrate>
void check_axes_and_rest(Integrate integrate) {
  using namespace reduction;
  for (const Law& law : paper_laws()) {
    const ReducedSystem system(law, 0.1);
    const Motion sliding = integrate(system, State{0, 2}, Eigen::ArrayXd{{0.5, 100.0}}, StepperSettings{});
    REQUIRE(sliding.outcome.ok());
    CHECK(sliding.stop_time == Approx(system.sliding_limit(2)).epsilon(1e-15));
    CHECK(sliding.points.u[0] == 0);
    CHECK(sliding.points.v[0] == Approx(2 - 7 / (3 * std::numbers::pi) * 0.5).epsilon(1e-14));
    CHECK(sliding.points.v[1] == 0);
    CHECK(sliding.points.beta[0] == Approx(Flow(system).orbit({0, 2}).at_time(0.5).beta).epsilon(1e-13));
    const Motion pivoting = integrate(system, State{-2, 0}, Eigen::ArrayXd{{0.5, 100.0}}, StepperSettings{});
    REQUIRE(pivoting.outcome.ok());
    CHECK(pivoting.stop_time == Approx(64).epsilon(1e-15));
    CHECK(pivoting.points.u[0] == Approx(-2 + 0.5 / 32).epsilon(1e-14));
    CHECK(pivoting.points.v[0] == 0);
    CHECK(pivoting.points.u[1] == 0);
    CHECK(pivoting.points.beta[0] == Approx(Flow(system).orbit({-2, 0}).at_time(0.5).beta).epsilon(1e-13));
    const Motion rest = integrate(system, State{0, 0}, Eigen::ArrayXd{{0.0, 1.0}}, StepperSettings{});
    CHECK(rest.outcome.ok());
    CHECK(rest.stop_time == 0);
    REQUIRE(rest.points.rows() == 2);
    CHECK(rest.points.u[0] == 0);
    CHECK(rest.points.tau[1] == 1);
  }
}

/// tau, u, v carry the unit of speed; beta its inverse.
template <class Integrate>
void check_motion_scaling(Integrate integrate) {
  using namespace reduction;
  for (const Law& law : paper_laws()) {
    const ReducedSystem system(law, 0.2);
    const Motion here = integrate(system, State{-1, 2}, Eigen::ArrayXd{{0.3, 2.0}}, StepperSettings{});
    for (int power : {-1000, -500, 60, 1000}) {
      const auto scale = [&](double x) { return std::ldexp(x, power); };
      const Motion scaled =
          integrate(system, State{scale(-1), scale(2)}, Eigen::ArrayXd{{scale(0.3), scale(2.0)}}, StepperSettings{});
      CAPTURE(law.name(), power);
      REQUIRE(scaled.outcome.ok());
      CHECK(scaled.stop_time == Approx(scale(here.stop_time)).epsilon(1e-11));
      for (Eigen::Index i = 0; i < 2; ++i) {
        CHECK(scaled.points.u[i] == Approx(scale(here.points.u[i])).epsilon(1e-11));
        CHECK(scaled.points.v[i] == Approx(scale(here.points.v[i])).epsilon(1e-11));
      }
    }
  }
}

template <class Integrate>
void check_outcomes(Integrate integrate, const std::string& name) {
  using namespace reduction;
  using Catch::Matchers::Contains;
  const ReducedSystem system(PadeLaw{}, 0.1);
  StepperSettings impatient;
  impatient.step_limit = 3;
  for (const Eigen::ArrayXd& times : {Eigen::ArrayXd{}, Eigen::ArrayXd{{1e-9, 20.0}}}) {
    const Motion motion = integrate(system, State{1, 1}, times, impatient);
    CHECK_FALSE(motion.outcome.ok());
    CHECK(motion.outcome.kind == Outcome::Kind::step_limit);
    CHECK(motion.steps == 3);
    CHECK(std::isnan(motion.stop_time));
    CHECK(motion.points.rows() >= 1);
    CHECK(motion.points.u[0] == Approx(1));
    CHECK_THAT(motion.outcome.sentence,
               Contains(name) && Contains("step limit") && Contains("3 steps") && Contains("u = 1"));
  }

  const Motion broken = integrate(ReducedSystem(BrokenLaw{}, 0.3), State{1, 1}, Eigen::ArrayXd{}, StepperSettings{});
  CHECK_FALSE(broken.outcome.ok());
  CHECK(broken.outcome.kind == Outcome::Kind::not_finite);
  CHECK(std::isnan(broken.stop_time));
  CHECK_THAT(broken.outcome.sentence, Contains(name) && Contains("not finite"));
}

template <class Integrate>
void check_arguments(Integrate integrate, const std::string& name) {
  using namespace reduction;
  using Catch::Matchers::Contains;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const ReducedSystem system(PadeLaw{}, 0.1);
  for (const State bad :
       {State{1, -1}, State{not_a_number, 1}, State{1, not_a_number}, State{infinity, 1}, State{1, infinity}}) {
    CAPTURE(bad.u, bad.v);
    CHECK_THROWS_AS(integrate(system, bad, Eigen::ArrayXd{}, StepperSettings{}), std::domain_error);
  }
  for (const Eigen::ArrayXd& bad : {Eigen::ArrayXd{{-1.0}}, Eigen::ArrayXd{{0.5, 0.4}}, Eigen::ArrayXd{{not_a_number}},
                                    Eigen::ArrayXd{{0.1, infinity}}}) {
    CHECK_THROWS_AS(integrate(system, State{1, 1}, bad, StepperSettings{}), std::domain_error);
  }
  CHECK_THROWS_WITH(integrate(system, State{1, 1}, Eigen::ArrayXd{{0.5, 0.25}}, StepperSettings{}),
                    Contains(name) && Contains("0.25 after 0.5"));
  CHECK_THROWS_WITH(integrate(system, State{1, -2}, Eigen::ArrayXd{}, StepperSettings{}),
                    Contains(name) && Contains("-2"));
}

}  // namespace contensou::tests
