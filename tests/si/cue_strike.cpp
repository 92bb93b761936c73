#include "contensou/si/experiment.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "contensou/si/motion.hpp"

using namespace contensou::si;

namespace {

constexpr double degree = std::numbers::pi / 180;
const Ball ball{"ball", 0.17, 0.03};

}  // namespace

TEST_CASE("a stroke is elastic: momentum and energy of cue and ball are kept", "[invariant]") {
  for (const auto& [right, above] : {std::pair{0.0, 0.0}, {0.3, 0.1}, {-0.2, -0.45}}) {
    const CueStrike strike{.speed = 2, .right = right, .above = above, .elevation = 0, .mass = 0.5};
    const Velocities after = struck(ball, strike);
    const double cue = 2 - ball.mass * after.velocity.x() / 0.5;
    CHECK(0.25 * cue * cue + kinetic_energy(ball, after) == Approx(0.25 * 2 * 2).epsilon(1e-14));
    CHECK(after.velocity.y() == 0);
  }
}

TEST_CASE("the spin of a stroke is the moment of its impulse", "[route]") {
  const CueStrike strike{.speed = 3, .right = 0.25, .above = -0.3, .elevation = 35};
  const Velocities after = struck(ball, strike);
  const double a = 0.25 * ball.radius, b = -0.3 * ball.radius, sine = std::sin(35 * degree),
               cosine = std::cos(35 * degree);
  const Eigen::Vector3d along(cosine, 0, -sine);
  const Eigen::Vector3d arm = -std::sqrt(ball.radius * ball.radius - a * a - b * b) * along - Eigen::Vector3d(0, a, 0) +
                              b * Eigen::Vector3d(sine, 0, cosine);
  const Eigen::Vector3d impulse = ball.mass * after.velocity.x() / cosine * along;
  const Eigen::Vector3d spin = arm.cross(impulse) / (0.4 * ball.mass * ball.radius * ball.radius);
  CHECK((after.angular_velocity - spin).norm() < 1e-12 * spin.norm());
  CHECK(after.angular_velocity.z() > 0);  // a hit on the right turns the ball to the left
}

TEST_CASE("a ball that is struck 2/5 of its radius above its centre rolls at once", "[table]") {
  const Experiment experiment{.ball = ball,
                              .contact = {.friction = 0.2, .patch = PatchRadius{1e-3}},
                              .start = struck(ball, {.speed = 1, .right = 0, .above = 0.4, .elevation = 0})};
  CHECK(slip_at_start(experiment) == Approx(0).margin(1e-15));
  CHECK(struck(ball, {.speed = 1, .right = 0, .above = 0, .elevation = 0}).velocity.x() ==
        Approx(2 / (1 + 0.17 / standard_cue_mass)).epsilon(1e-15));
}

TEST_CASE("a stroke that no cue can make is refused", "[domain]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const CueStrike& wrong : {CueStrike{.speed = 0, .right = 0, .above = 0, .elevation = 0},
                                 CueStrike{.speed = nan, .right = 0, .above = 0, .elevation = 0},
                                 CueStrike{.speed = 1, .right = 0.4, .above = 0.4, .elevation = 0},
                                 CueStrike{.speed = 1, .right = nan, .above = 0, .elevation = 0},
                                 CueStrike{.speed = 1, .right = 0, .above = 0, .elevation = 90},
                                 CueStrike{.speed = 1, .right = 0, .above = 0, .elevation = -0.1},
                                 CueStrike{.speed = 1, .right = 0, .above = 0, .elevation = 0, .mass = 0}}) {
    CHECK_THROWS_AS(struck(ball, wrong), std::domain_error);
  }
}
