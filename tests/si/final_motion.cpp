#include "contensou/si/final_motion.hpp"

#include <catch2/catch.hpp>

#include "contensou/si/catalogue.hpp"

using namespace contensou::si;

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
    CHECK(7 * R * angular_velocity.y() == Approx(5 * entry.shot.start.slip).epsilon(1e-15));
  }
}
