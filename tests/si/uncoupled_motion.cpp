#include "contensou/si/motion.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "motion_cases.hpp"

using namespace contensou;
using namespace contensou::si;

TEST_CASE("the textbook's motion is the limit of the whole one", "[limit]") {
  const reduction::PadeLaw law;
  for (const std::size_t alone : {std::size_t{5}, std::size_t{6}}) {  // these cases have spin only, or slip only
    const Experiment experiment = experiment_of(motion_cases[alone], 0.1);
    const Motion whole = Motion::reduced(experiment, law);
    const Motion textbook = Motion::uncoupled(experiment, law);
    const double stop = whole.stop_time();
    CHECK(std::max(textbook.slip_time(0), textbook.spin_end()) == Approx(stop).epsilon(1e-14));
    CHECK(textbook.slip_length() == Approx(whole.slip_length()).epsilon(1e-13));
    CHECK(textbook.spin_angle() == Approx(whole.spin_angle()).epsilon(1e-9));
    CHECK(textbook.path_length(textbook.slip_time(0)) ==
          Approx(whole.path_length(textbook.slip_time(0))).epsilon(1e-9));
    for (double share : {0.0, 0.3, 0.9, 1.5}) {
      const MotionPoint a = whole.at(share * stop);
      const MotionPoint b = textbook.at(share * stop);
      CHECK((a.position - b.position).norm() < 1e-13);
      CHECK((a.velocity - b.velocity).norm() < 1e-13);
      CHECK((a.angular_velocity - b.angular_velocity).norm() < 1e-11);
    }
  }
}

TEST_CASE("the textbook's ball rolls after 2 v0/(7 f g), as any ball does in the end", "[table]") {
  const Experiment experiment = experiment_of(motion_cases[2], 0.1);
  const Motion textbook = Motion::uncoupled(experiment, reduction::PadeLaw{});
  CHECK(textbook.slip_time(0) == Approx(2 * slip_at_start(experiment) / (7 * 0.2 * 9.80665)).epsilon(1e-14));
  const MotionPoint rolls = textbook.at(textbook.slip_time(0));
  CHECK((rolls.velocity - final_motion(experiment).velocity).norm() < 1e-15);
  CHECK(rolls.slip == 0);
  CHECK(textbook.at(textbook.slip_time(0.01)).slip == Approx(0.01).epsilon(1e-12));
  // The force is constant and opposite to the direction e of the slip: X = V0 t - f g t^2/2 e.
  const double t = 0.7 * textbook.slip_time(0);
  const Eigen::Vector2d e = slip_velocity_at_start(experiment).normalized();
  const Eigen::Vector2d expected = velocities_of(experiment.start).velocity * t - 0.2 * 9.80665 * t * t / 2 * e;
  CHECK((textbook.at(t).position - expected).norm() < 1e-14);
  CHECK_THROWS_AS(textbook.at(-1), std::domain_error);
  CHECK_THROWS_AS(textbook.at(std::numeric_limits<double>::quiet_NaN()), std::domain_error);
}

TEST_CASE("rolling friction takes from the uncoupled model what the ball rolls with, and friction the rest",
          "[formula]") {
  Experiment experiment = experiment_of(motion_cases[6], 0.1);  // no spin
  experiment.contact.rolling_friction = 0.01;
  const Motion textbook = Motion::uncoupled(experiment, reduction::PadeLaw{}, 0);
  const auto [start, sliding, pivoting, rolling, gained, kept] = textbook.energy_balance();
  const Velocities rolls = final_motion(experiment);
  CHECK(rolling == Approx(kinetic_energy(experiment.ball, rolls)).epsilon(1e-12));
  CHECK(sliding == Approx(energy_loss(experiment).sliding).epsilon(1e-12));
  CHECK(pivoting + kept + gained == 0);
  CHECK(start == Approx(sliding + rolling).epsilon(1e-12));
}
