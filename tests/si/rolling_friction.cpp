#include "si/motion/rolling_friction.hpp"

#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/si/motion.hpp"
#include "motion_cases.hpp"

using namespace contensou;
using namespace contensou::si;

TEST_CASE("from where it rolls, a ball slows down evenly and rests V/a later, V^2/(2 a) farther", "[table]") {
  const Experiment experiment = experiment_of(motion_cases[2], 0.1);
  const Motion free = Motion::reduced(experiment, reduction::HertzLaw{});
  const MotionPoint rolls = free.at(free.slip_time(1e-3));
  const double a = 0.1, speed = rolls.velocity.norm();
  const RollingFriction friction(experiment.ball, rolls, a, 2);
  CHECK(friction.rest_time() == Approx(rolls.t + speed / a).epsilon(1e-15));
  CHECK((friction.rest_position() - rolls.position).norm() == Approx(speed * speed / (2 * a)).epsilon(1e-14));

  const MotionPoint before = friction(free.at(rolls.t / 2));
  CHECK(before.energy == free.at(rolls.t / 2).energy);
  const MotionPoint half = friction(free.at(rolls.t + speed / a / 2));
  CHECK(half.velocity.norm() == Approx(speed / 2).epsilon(1e-14));
  CHECK((half.position - rolls.position).norm() == Approx(0.75 * speed * speed / (2 * a)).epsilon(1e-14));
  CHECK(half.velocity.x() == Approx(experiment.ball.radius * half.angular_velocity.y()).epsilon(1e-14));
  CHECK(half.velocity.y() == Approx(-experiment.ball.radius * half.angular_velocity.x()).epsilon(1e-14));
  const MotionPoint rest = friction(free.at(friction.rest_time() + free.stop_time()));
  CHECK(rest.energy == 0);
  CHECK((rest.position - friction.rest_position()).norm() < 1e-15);
  CHECK(friction(free.at(rolls.t * 1.5)).angular_velocity.z() == free.at(rolls.t * 1.5).angular_velocity.z());

  // Without a speed it rests where it is.
  const MotionPoint still{
      .t = 1, .position = {2, 3}, .velocity = {0, 0}, .angular_velocity = {0, 0, 5}, .slip = 0, .energy = 0};
  CHECK(RollingFriction(experiment.ball, still, a, 2).rest_time() == 1);
  CHECK(RollingFriction(experiment.ball, still, a, 2).rest_position() == still.position);
  for (double wrong : {0.0, -1.0, std::nan("")})
    CHECK_THROWS_AS(RollingFriction(experiment.ball, still, wrong, 2), std::domain_error);
}
