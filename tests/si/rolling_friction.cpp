#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/motion.hpp"
#include "motion_cases.hpp"

using namespace contensou;
using namespace contensou::si;

TEST_CASE("from where it rolls, a ball slows down evenly and rests V/a later, V^2/(2 a) farther", "[table]") {
  Experiment experiment = experiment_of(motion_cases[2], 0.1);
  const reduction::HertzLaw law;
  const Motion free = Motion::uncoupled(experiment, law);
  const MotionPoint rolls = free.at(free.slip_time(1e-3));
  const double a = 0.1, speed = rolls.velocity.norm();
  experiment.contact.rolling_friction = a / experiment.environment.gravity;
  const Motion slowed = Motion::uncoupled(experiment, law);
  const Event rests = slowed.rest().value();
  CHECK(rests.t == Approx(rolls.t + speed / a).epsilon(1e-15));
  CHECK((rests.place - rolls.position).norm() == Approx(speed * speed / (2 * a)).epsilon(1e-14));

  CHECK(slowed.at(rolls.t / 2).energy == free.at(rolls.t / 2).energy);
  const MotionPoint half = slowed.at(rolls.t + speed / a / 2);
  CHECK(half.velocity.norm() == Approx(speed / 2).epsilon(1e-14));
  CHECK((half.position - rolls.position).norm() == Approx(0.75 * speed * speed / (2 * a)).epsilon(1e-14));
  CHECK(half.velocity.x() == Approx(experiment.ball.radius * half.angular_velocity.y()).epsilon(1e-14));
  CHECK(half.velocity.y() == Approx(-experiment.ball.radius * half.angular_velocity.x()).epsilon(1e-14));
  const MotionPoint rest = slowed.at(rests.t + free.stop_time());
  CHECK(rest.energy == 0);
  CHECK((rest.position - rests.place).norm() < 1e-15);
  CHECK(slowed.at(rolls.t * 1.5).angular_velocity.z() == free.at(rolls.t * 1.5).angular_velocity.z());

  // Without a velocity the ball rests at its start.
  experiment.start = Velocities{{0, 0}, {0, 0, 5}};
  CHECK(Motion::uncoupled(experiment, law).rest()->t == 0);
  CHECK(Motion::uncoupled(experiment, law).rest()->place == Eigen::Vector2d(0, 0));
  for (double wrong : {-1.0, std::nan("")}) {
    experiment.contact.rolling_friction = wrong;
    CHECK_THROWS_AS(Motion::uncoupled(experiment, law), std::domain_error);
  }
}
