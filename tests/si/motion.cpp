#include "contensou/si/motion.hpp"

#include <catch2/catch.hpp>

#include "motion_cases.hpp"

using namespace contensou::si;

TEST_CASE("kinetic energy of a ball", "[table]") {
  const Ball ball{.name = "", .mass = 2, .radius = 0.5};
  CHECK(kinetic_energy(ball, {{3, 4}, {0, 0, 0}}) == 25);
  CHECK(kinetic_energy(ball, {{0, 0}, {2, 4, 4}}) == Approx(0.5 * (0.4 * 2 * 0.25) * 36).epsilon(1e-15));
}

TEST_CASE("the motion that belongs to a slip obeys (2.1) and loses the right energy", "[invariant]") {
  for (const MotionCase& motion_case : motion_cases) {
    INFO(motion_case.name);
    const Shot shot = shot_of(motion_case, 0.1);
    const double R = shot.ball.radius;
    const double v0 = slip_at_start(shot);
    const MotionPoint start = motion_by_slip(shot, 0, v0, 0, spin_at_start(shot));
    CHECK(start.velocity == motion_case.start.velocity);
    CHECK(start.angular_velocity == motion_case.start.angular_velocity);
    CHECK(start.position.norm() == 0);
    const MotionPoint point = motion_by_slip(shot, 1, v0 / 3, 0.1, 5);
    const Eigen::Vector2d contact{point.velocity.x() - R * point.angular_velocity.y(),
                                  point.velocity.y() + R * point.angular_velocity.x()};
    CHECK((contact - slip_velocity_at_start(shot) / 3).norm() < 1e-14);
    const MotionPoint end = motion_by_slip(shot, 1, 0, 0.1, 0);
    const EnergyLoss loss = energy_loss(shot);
    CHECK(start.energy - end.energy == Approx(loss.sliding + loss.pivoting).epsilon(1e-12).margin(1e-15));
  }
}
