#include "contensou/si/experiment.hpp"

#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/motion.hpp"

using namespace contensou;
using namespace contensou::si;
using Catch::Matchers::Contains;

namespace {

Experiment with_inertia(const char* name, double factor) {
  Experiment experiment = find_ball(name)->experiment;
  experiment.ball.body = experiment.ball.body.with_factor(factor);
  return experiment;
}

}  // namespace

TEST_CASE("a ball of inertia c m R^2 that slides without spin ends at v0/(1 + c)", "[table]") {
  const reduction::Law law = *reduction::find_law("exact");
  for (double c : {0.1, 0.4, 0.55, 2.0 / 3}) {
    CAPTURE(c);
    Experiment experiment = with_inertia("pool", c);
    experiment.start = SlipAndSpin{.slip = 2, .spin = 0};
    const double deceleration = 0.2 * 9.80665, stop = 2 / (deceleration * (1 + 1 / c));
    const Motion motion = Motion::reduced(experiment, law);
    const MotionPoint end = motion.at(stop);
    CHECK(motion.stop_time() == Approx(stop).epsilon(1e-14));
    CHECK(end.velocity.x() == Approx(2 / (1 + 1 / c) / c).epsilon(1e-14));
    CHECK(end.position.x() == Approx(2 * stop - deceleration * stop * stop / 2).epsilon(1e-13));
    CHECK(final_motion(experiment).velocity.x() == Approx(2 / (1 + c)).epsilon(1e-14));
    CHECK(end.energy == Approx(0.1701 / 2 * (1 + c) * std::pow(2 / (1 + c), 2)).epsilon(1e-13));
    // Without slip the spin falls at the rate f N eps Psi(0)/(c m R^2); c is the moment of inertia divided by m R^2.
    experiment.start = SlipAndSpin{.slip = 0, .spin = 50};
    experiment.contact.patch = PatchRadius{2e-3};
    const double rate = deceleration * 2e-3 * law.pivoting_moment() / (c * std::pow(experiment.ball.radius, 2));
    CHECK(Motion::reduced(experiment, law).stop_time() == Approx(50 / rate).epsilon(1e-14));
    // A stroke at the height c above the centre, in radii, makes a ball roll at once. At c/2 the spin is half as large.
    const Velocities rolling = struck(experiment.ball, {.speed = 1, .right = 0, .above = c / 2, .elevation = 0});
    CHECK(experiment.ball.radius * rolling.angular_velocity.y() == Approx(rolling.velocity.x() / 2).epsilon(1e-14));
  }
}

TEST_CASE("a body of any inertia moves the same by both routes", "[route]") {
  for (const auto& [name, c, law] : {std::tuple{"gel", 0.6, "exact"},
                                     {"puck", 0.3, "uniform"},
                                     {"puck", 0.9, "exact"},
                                     {"curling-stone", 0.45, "ring"},
                                     {"basketball", 2.0 / 3, "uniform"}}) {
    CAPTURE(name, c);
    const Experiment experiment = with_inertia(name, c);
    const reduction::Law of_friction = *reduction::find_law(law);
    const Motion reduced = Motion::reduced(experiment, of_friction);
    const Eigen::ArrayXd times = Eigen::ArrayXd::LinSpaced(9, 0, 1.1 * reduced.stop_time());
    const Motion integrated = Motion::in_steps(experiment, of_friction);
    const MotionColumns a = reduced.at(times), b = integrated.at(times);
    CHECK(integrated.stop_time() == Approx(reduced.stop_time()).epsilon(1e-11));
    CHECK((a.x - b.x).abs().maxCoeff() < 1e-11 * a.x.maxCoeff());
    CHECK((a.wz - b.wz).abs().maxCoeff() < 1e-10 * a.wz[0]);
    CHECK((a.energy - b.energy).abs().maxCoeff() < 1e-11 * a.energy[0]);
  }
}

TEST_CASE("no body has more inertia than with all of its mass at its radius", "[domain]") {
  CHECK_THROWS_WITH(Body{}.with_factor(0.7), Contains("at most 2/3, as of a hollow-ball with R the radius; got 0.7"));
  CHECK_THROWS_WITH(with_inertia("puck", 1.1), Contains("at most 1, as of a ring"));
  for (const double rounded : {0.667, 0.6667, 0.66666666667, 2.0 / 3}) {
    CHECK(Body{}.with_factor(rounded).inertia.chi == Approx(2.5).epsilon(1e-15));
    CHECK(Body{}.with_factor(rounded).factor == 2.0 / 3);
  }
  CHECK(Body{}.with_factor(0.6666).factor == 0.6666);
  CHECK_THROWS_AS(Body{}.with_factor(0.668), std::domain_error);
  CHECK_THROWS_AS(Body{}.with_factor(0), std::domain_error);
  CHECK_THROWS_AS(Body{}.with_factor(NAN), std::domain_error);
}

TEST_CASE("rolling resistance slows a ball of any inertia at u_r g while it rolls", "[table]") {
  Experiment experiment = with_inertia("pool", 0.6);
  experiment.start = Velocities{{1, 0}, {0, 1 / experiment.ball.radius, 0}};
  experiment.contact.rolling_friction = 0.01;
  const Motion motion = Motion::reduced(experiment, *reduction::find_law("exact"));
  CHECK(motion.rest()->t == Approx(1 / (0.01 * 9.80665)).epsilon(1e-9));
  CHECK(motion.energy_balance().rolling == Approx(0.1701 / 2 * 1.6).epsilon(1e-6));
}

TEST_CASE("a disc on a small patch goes as far as its contact slides, and stands still from the stop on",
          "[invariant]") {
  // The body slides for a long time with a small share of its first slip. The path is v0 t minus the lost distance.
  Experiment experiment = find_ball("puck")->experiment;
  experiment.contact.patch = PatchRadius{1e-9};
  const reduction::Law law = *reduction::find_law("uniform");
  for (const Start& start : {Start{SlipAndSpin{0.3, 1e7}}, Start{Velocities{{0.1, 0.2}, {0, 0, -1e7}}}}) {
    experiment.start = start;
    const Motion motion = Motion::reduced(experiment, law);
    const MotionPoint end = motion.at(motion.stop_time());
    CHECK(end.position.norm() == Approx(motion.slip_length()).epsilon(1e-12));
    CHECK(end.velocity == Eigen::Vector2d(0, 0));
  }
}
