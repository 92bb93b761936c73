// Tests that both steppers must pass.
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "contensou/reduction/tabulated_pressure_law.hpp"
#include "octic_law.hpp"
#include "user_laws.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using Catch::Matchers::Contains;
using std::numbers::pi;

namespace {

struct Stepper {
  std::string name;
  Motion (*run)(const ReducedSystem&, State, const Eigen::ArrayXd& times, const StepperSettings&);
  Route route;
};

const Stepper steppers[]{{"integrate_regularised", integrate_regularised, Route::regularised},
                         {"integrate_directly", integrate_directly, Route::direct}};

/// A law that is NaN for 5e-4 > k > 2e-5. The tests of Law do not evaluate ratios in this interval.
struct BrokenLaw {
  Resistance operator()(Slip slip) const {
    const bool broken = slip.sliding < 5e-4 * slip.pivoting && slip.sliding > 2e-5 * slip.pivoting;
    return broken ? Resistance{NAN, NAN} : RootLaw{}(slip);
  }
};

/// Compares states of a stepper with the orbit. For r < 1 errors are relative to the state, else to the start.
struct States {
  explicit States(const std::string& name) : name_(name) {}

  void compare(const Stepper& stepper, const Flow& flow, double k0) {
    const ReducedSystem& system = flow.system();
    const bool gentle = system.r() < 1;
    const State start{-3, 3 * system.mu() * k0};
    const Orbit orbit = flow.orbit(start);
    const std::string where =
        fmt::format("{}, r = {}, mu = {}, k0 = {}", system.law().name(), system.r(), system.mu(), k0);
    const Eigen::ArrayXd times = orbit.stop_time() * Eigen::ArrayXd{{0, 1e-9, 1e-3, 0.1, 0.3, 0.5, 0.5, 0.9, 1.5}};
    const Motion motion = stepper.run(system, start, times, {});
    CAPTURE(where, motion.outcome.sentence);
    REQUIRE(motion.outcome.ok());
    CHECK(motion.outcome.sentence == "The body came to rest.");
    REQUIRE(motion.points.rows() == times.size());
    stop_.add(orbit.stop_time(), motion.stop_time, where);
    const double unit = 1 / (16 * system.mu() * 3 + 15 * pi * start.v);
    for (Eigen::Index i = 0; i + 1 < times.size(); ++i) {
      const OrbitPoint wanted = orbit.at_time(times[i]), got = motion.points.row(i);
      const std::string instant = where + fmt::format(", tau = {} tau*", times[i] / orbit.stop_time());
      CHECK(got.tau == times[i]);
      if (gentle) {
        itself_.add(wanted.u, got.u, instant);
        itself_.add(wanted.ln_v, got.ln_v, 1 + std::abs(wanted.ln_v), instant);
        itself_.add(wanted.beta, got.beta, wanted.beta + unit, instant);
      } else {
        start_.add(wanted.u, got.u, 3, instant);
        start_.add(wanted.v, got.v, start.v, instant);
      }
    }
    const OrbitPoint rest = motion.points.row(times.size() - 1);
    CHECK((rest.u == 0 && rest.v == 0 && rest.tau == times[times.size() - 1]));
  }

  void check() const {
    CAPTURE(name_);
    CHECK_WITHIN_EPS(stop_, 3e-11 / eps);
    if (itself_.count() > 0) CHECK_WITHIN_EPS(itself_, 1e-10 / eps);
    CHECK_WITHIN_EPS(start_, 1e-9 / eps);
  }

 private:
  std::string name_;
  WorstCase stop_{"stop time"}, itself_{"state relative to itself"}, start_{"state relative to the start"};
};

/// Returns a flat puck with the mass at its rim: r = mu^2, and mu can be any number.
ReducedSystem rim_puck(const Law& law, double r) { return {law, std::sqrt(r), {.chi = 1, .gamma = 1}}; }

}  // namespace

TEST_CASE("the steppers and the orbit give one motion, of every law in every regime", "[steppers][route]") {
  std::vector<Law> laws = CONTENSOU_FULL_TESTS ? named_laws() : paper_laws();
  laws.insert(laws.end(),
              {RootLaw{}, CallOnly<HertzLaw>{},
               TabulatedPressureLaw("table", Eigen::ArrayXd{{0, 0.35, 0.6, 1}}, Eigen::ArrayXd{{1, 2.5, 4, 0.5}})});
  const std::vector<double> all{7e-9, 0.064, 0.71, 1.9, 2.0, 2.3, 4.5, 5.2, 1e3}, some{7e-9, 0.71, 2.0, 5.2};
  for (const Stepper& stepper : steppers) {
    States states(stepper.name);
    for (const Law& law : laws) {
      for (double r : CONTENSOU_FULL_TESTS ? all : some) {
        const Flow flow(rim_puck(law, r));
        for (double k0 : {1e-4, 0.5, 1.0, 7.0, 1e6}) states.compare(stepper, flow, k0);
      }
    }
    states.check();
  }
}

TEST_CASE("beside a ray that repels the steppers agree", "[steppers][route]") {
  for (const Stepper& stepper : steppers) {
    States states(stepper.name);
    for (double r : {1.991, 1.995, 2.0}) {
      const Flow flow({OcticLaw{}, 1, {1, r}});
      for (double k0 : {1e-3, 0.08, 0.0816, 0.0817, 0.1, 0.144, 0.15, 0.2, 0.5, 10.0})
        states.compare(stepper, flow, k0);
    }
    states.check();
  }
}

TEST_CASE("every step is reported when no instants are asked for", "[steppers][route]") {
  for (const Stepper& stepper : steppers) {
    for (const Law& law : paper_laws()) {
      const ReducedSystem system(law, 0.1);
      const Orbit orbit = Flow(system).orbit({2, 1});
      const Motion motion = stepper.run(system, {2, 1}, {}, {});
      CAPTURE(stepper.name, law.name());
      REQUIRE(motion.outcome.ok());
      const OrbitColumns& points = motion.points;
      const Eigen::Index last = points.rows() - 1;
      REQUIRE(last > 10);
      CHECK(motion.evaluations > motion.steps);
      CHECK((points.u[0] == 2 && points.v[0] == 1 && points.tau[0] == 0));
      for (Eigen::Index i = 1; i <= last; ++i) {
        CAPTURE(i);
        CHECK(points.tau[i] >= points.tau[i - 1]);
        CHECK(points.u[i] <= points.u[i - 1]);
        CHECK(points.ln_v[i] <= points.ln_v[i - 1]);
        const OrbitPoint point = points.row(i);
        if (point.tau < 0.9 * motion.stop_time) CHECK(orbit.at_time(point.tau).u == Approx(point.u).epsilon(1e-10));
      }
      CHECK((points.k == 1).any());  // k0 = 5, so a step must end at k = 1, where the exact law has no third derivative
      CHECK((points.tau[last] == motion.stop_time && points.u[last] == 0 && points.v[last] == 0));
      CHECK(points.beta[last] == infinity);
    }
  }
}

TEST_CASE("the steppers on the axes and at rest", "[steppers][limit]") {
  for (const Stepper& stepper : steppers) {
    for (const Law& law : paper_laws()) {
      const ReducedSystem system(law, 0.1);
      CAPTURE(stepper.name, law.name());
      for (const State start : {State{0, 2}, State{-2, 0}}) {
        const Motion motion = stepper.run(system, start, Eigen::ArrayXd{{0.5, 100.0}}, {});
        const OrbitPoint wanted = Flow(system).orbit(start).at_time(0.5), got = motion.points.row(0);
        REQUIRE(motion.outcome.ok());
        CHECK(motion.stop_time == Approx(start.u == 0 ? system.sliding_limit(2) : 64).epsilon(1e-15));
        CHECK(got.u == Approx(wanted.u).epsilon(1e-14));
        CHECK(got.v == Approx(wanted.v).epsilon(1e-14));
        CHECK(got.beta == Approx(wanted.beta).epsilon(1e-13));
        CHECK((motion.points.u[1] == 0 && motion.points.v[1] == 0));
      }
      const Motion rest = stepper.run(system, {0, 0}, Eigen::ArrayXd{{0.0, 1.0}}, {});
      CHECK((rest.outcome.ok() && rest.stop_time == 0));
      REQUIRE(rest.points.rows() == 2);
      CHECK((rest.points.u[0] == 0 && rest.points.tau[1] == 1));
    }
  }
}

// tau, u and v are speeds, so another unit of speed multiplies all of them by the same number.
TEST_CASE("the unit of speed does not matter to the steppers", "[steppers][symmetry]") {
  for (const Stepper& stepper : steppers) {
    for (const Law& law : paper_laws()) {
      const ReducedSystem system(law, 0.2);
      const Motion here = stepper.run(system, {-1, 2}, Eigen::ArrayXd{{0.3, 2.0}}, {});
      for (int power : {-1000, -500, 60, 1000}) {
        const double unit = std::ldexp(1.0, power);
        const Motion scaled = stepper.run(system, {-unit, 2 * unit}, unit * Eigen::ArrayXd{{0.3, 2.0}}, {});
        CAPTURE(stepper.name, law.name(), power);
        REQUIRE(scaled.outcome.ok());
        CHECK(scaled.stop_time == Approx(unit * here.stop_time).epsilon(1e-11));
        for (Eigen::Index i = 0; i < 2; ++i) {
          CHECK(scaled.points.u[i] == Approx(unit * here.points.u[i]).epsilon(1e-11));
          CHECK(scaled.points.v[i] == Approx(unit * here.points.v[i]).epsilon(1e-11));
        }
      }
    }
  }
}

TEST_CASE("a run that does not reach the stop says why", "[steppers][domain]") {
  const ReducedSystem broken_system(BrokenLaw{}, 0.3);
  for (const auto& [name, run, route] : steppers) {
    for (const Eigen::ArrayXd& times : {Eigen::ArrayXd{}, Eigen::ArrayXd{{1e-9, 20.0}}}) {
      const Motion motion = run({PadeLaw{}, 0.1}, {1, 1}, times, {.step_limit = 3});
      CHECK(motion.outcome.kind == Outcome::Kind::step_limit);
      CHECK(motion.steps == 3);
      CHECK(std::isnan(motion.stop_time));
      CHECK(motion.points.rows() >= 1);
      CHECK(motion.points.u[0] == Approx(1));
      CHECK_THAT(motion.outcome.sentence,
                 Contains(name) && Contains("step limit") && Contains("3 steps") && Contains("u = 1"));
    }
    const Motion broken = run(broken_system, {1, 1}, {}, {});
    CHECK(broken.outcome.kind == Outcome::Kind::not_finite);
    CHECK(std::isnan(broken.stop_time));
    CHECK_THAT(broken.outcome.sentence, Contains(name) && Contains("not finite"));
    CHECK_THROWS_AS(stop_time(broken_system, {1, 1}, route), std::runtime_error);
    CHECK_THROWS_WITH(stop_time(broken_system, {1, 1}, route), Contains("not finite"));
  }
}

TEST_CASE("times that decrease or are no times are named", "[steppers][domain]") {
  const ReducedSystem system(PadeLaw{}, 0.1);
  for (const Stepper& stepper : steppers) {
    for (const Eigen::ArrayXd& bad :
         {Eigen::ArrayXd{{-1.0}}, Eigen::ArrayXd{{not_a_number}}, Eigen::ArrayXd{{0.1, infinity}}}) {
      CHECK_THROWS_AS(stepper.run(system, {1, 1}, bad, {}), std::domain_error);
    }
    CHECK_THROWS_WITH(stepper.run(system, {1, 1}, Eigen::ArrayXd{{0.5, 0.25}}, {}),
                      Contains(stepper.name) && Contains("0.25 after 0.5"));
    CHECK_THROWS_WITH(stepper.run(system, {1, -2}, {}, {}), Contains(stepper.name) && Contains("-2"));
  }
}
