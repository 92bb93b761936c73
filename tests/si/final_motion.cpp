#include "contensou/si/final_motion.hpp"

#include <catch2/catch.hpp>

#include "contensou/si/catalogue.hpp"

using namespace contensou::si;

TEST_CASE("any start ends in rolling along one line", "[invariant]") {
  Shot shot = find_ball("pool")->shot;
  const double R = shot.ball.radius;
  const Velocities start{{1, 0.5}, {20, -30, 40}};
  shot.start = start;
  const auto [rolling, turning] = final_motion(shot);
  CHECK(rolling.x() == Approx(R * turning.y()).epsilon(1e-15));
  CHECK(rolling.y() == Approx(-R * turning.x()).epsilon(1e-15));
  CHECK(turning.z() == 0);
  // The angular momentum about any point of the plane is kept: m R V + J omega across it.
  CHECK(rolling.x() + 0.4 * R * turning.y() == Approx(1 + 0.4 * R * -30).epsilon(1e-15));
  CHECK(rolling.y() - 0.4 * R * turning.x() == Approx(0.5 - 0.4 * R * 20).epsilon(1e-15));
  // The two ways to give one start agree.
  shot.start = Velocities{{2, 0}, {0, 0, 7}};
  const FinalMotion general = final_motion(shot);
  shot.start = SlipAndSpin{.slip = 2, .spin = 7};
  CHECK(general.velocity.isApprox(final_motion(shot).velocity, 1e-15));
  CHECK(general.angular_velocity.isApprox(final_motion(shot).angular_velocity, 1e-15));
}

TEST_CASE("the ball ends rolling at 5/7 of its slip", "[invariant]") {
  for (const CatalogueEntry& entry : catalogue()) {
    const auto [velocity, angular_velocity] = final_motion(entry.shot);
    const double R = entry.shot.ball.radius;
    INFO(entry.name);
    // The contact point is at rest: v = omega x R e_z.
    CHECK(velocity.x() == Approx(R * angular_velocity.y()).epsilon(1e-15));
    CHECK(velocity.y() == -R * angular_velocity.x());
    CHECK(angular_velocity.z() == 0);
    // 7 R omega_y + 5 v keeps its value, v being the slip.
    CHECK(7 * R * angular_velocity.y() == Approx(5 * slip_at_start(entry.shot)).epsilon(1e-15));
  }
}
