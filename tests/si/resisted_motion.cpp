#include "contensou/si/resisted_motion.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/ball_motion.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/course.hpp"
#include "contensou/si/uncoupled_motion.hpp"

using namespace contensou;
using namespace contensou::si;

namespace {

const reduction::Law& exact() { return reduction::paper_laws().front(); }

Experiment pool(const Start& start) {
  Experiment experiment = find_ball("pool")->experiment;
  experiment.start = start;
  return experiment;
}

}  // namespace

TEST_CASE("a ball without spin: slip v/(1 - u_r/f), then it slows down evenly", "[formula]") {
  const Experiment experiment = pool(SlipAndSpin{1, 0});
  const double f = experiment.contact.friction, g = experiment.environment.gravity, u_r = 0.01;
  const ResistedMotion motion(experiment, exact(), u_r);
  CHECK(motion.is_reduced());
  CHECK_FALSE(motion.creep_ratio());
  const double slides = 2 / (7 * f * g * (1 - u_r / f));
  CHECK(motion.stop_time() == Approx(slides).epsilon(1e-14));
  const double rolls = 1 - f * g * slides;
  CHECK(motion.at_time(slides).velocity.x() == Approx(rolls).epsilon(1e-13));
  CHECK(motion.rest_time() == Approx(slides + rolls / (u_r * g)).epsilon(1e-13));
  const double way = slides - f * g * slides * slides / 2 + rolls * rolls / (2 * u_r * g);
  CHECK(motion.rest_position().x() == Approx(way).epsilon(1e-13));
  CHECK(motion.path_length(100) == Approx(way).epsilon(1e-13));
  CHECK(motion.slip_length() == Approx(slides / 2).epsilon(1e-13));
}

// By an integration in Python that shares no code with this one, of slip, rolling and spin in the plane of the motion.
TEST_CASE("a pool ball with spin creeps, and turns no more before it rests", "[reference]") {
  const ResistedMotion motion(pool(SlipAndSpin{1, 100}), exact(), 0.01);
  CHECK(motion.is_reduced());
  CHECK(motion.creep_ratio().value() == Approx(0.0426093361).epsilon(1e-9));
  CHECK(motion.at_time(0.31).slip == Approx(0.0129141402).epsilon(1e-8));
  CHECK(motion.at_time(0.31).position.x() == Approx(0.24102981).epsilon(1e-7));
  CHECK(motion.at_time(7).slip == Approx(0.003762867).epsilon(1e-7));
  CHECK(motion.at_time(7.2585).angular_velocity.y() > 0);
  CHECK(motion.at_time(7.2586).angular_velocity.y() == 0);
  CHECK(motion.slip_time(1e-3) == Approx(7.3016638).epsilon(1e-8));
  CHECK(motion.rest_time() == Approx(7.3800736).epsilon(1e-8));
  CHECK(motion.rest_position().x() == Approx(2.6408730).epsilon(1e-8));
  CHECK(motion.spin_end() > 10);
  CHECK(motion.at_time(8).angular_velocity.z() > 0);
  CHECK(ResistedMotion(pool(SlipAndSpin{1, 30}), exact(), 0.01).stop_time() == Approx(3.1411203).epsilon(1e-7));
}

TEST_CASE("without steps and in steps: one motion", "[route]") {
  // Slow and fast spin, one that rolls already, one that rolls with topspin short of rolling, a resistance that holds it.
  const double R = pool(SlipAndSpin{1, 0}).ball.radius;
  const std::vector<std::pair<Start, double>> cases{{SlipAndSpin{1, 0}, 0.01},
                                                    {SlipAndSpin{1, 30}, 0.01},
                                                    {SlipAndSpin{1, -100}, 0.01},
                                                    {SlipAndSpin{0.5, 400}, 0.02},
                                                    {SlipAndSpin{1, 100}, 0.15},
                                                    {Velocities{{1, 0}, {0, 0.4 / R, 60}}, 0.01},
                                                    {Velocities{{0.6, 0.8}, {-0.8 / R, 0.6 / R, 60}}, 0.01}};
  for (const auto& [start, u_r] : cases) {
    const Experiment experiment = pool(start);
    INFO("slip " << slip_at_start(experiment) << ", spin " << spin_at_start(experiment) << ", u_r " << u_r);
    const ResistedMotion reduced(experiment, exact(), u_r), in_steps(experiment, exact(), u_r, true);
    CHECK(reduced.is_reduced());
    CHECK_FALSE(in_steps.is_reduced());
    CHECK(in_steps.stop_time() == Approx(reduced.stop_time()).epsilon(1e-6));
    CHECK(in_steps.rest_time() == Approx(reduced.rest_time()).epsilon(1e-6));
    CHECK((in_steps.rest_position() - reduced.rest_position()).norm() < 1e-7);
    CHECK(in_steps.spin_angle() == Approx(reduced.spin_angle()).epsilon(1e-6));
    CHECK(in_steps.slip_length() == Approx(reduced.slip_length()).epsilon(1e-6));
    CHECK(in_steps.rolling_loss() == Approx(reduced.rolling_loss()).epsilon(1e-6));
    for (double part : {0.0, 0.01, 0.1, 0.5, 0.9, 1.1}) {
      const MotionPoint a = reduced.at_time(part * reduced.rest_time()),
                        b = in_steps.at_time(part * reduced.rest_time());
      CHECK((a.position - b.position).norm() < 1e-7);
      CHECK((a.velocity - b.velocity).norm() < 1e-7);
      CHECK((a.angular_velocity - b.angular_velocity).norm() < 1e-5);
    }
  }
}

TEST_CASE("a ball whose slip is below 1e-4 m/s while it rolls is not at rest", "[route]") {
  const auto of = [](const char* ball, const Velocities& start) {
    Experiment experiment = find_ball(ball)->experiment;
    experiment.start = start;
    return experiment;
  };
  const Experiment along = of("steel", {{0.5, 0}, {0, 0, 20}}), across = of("steel", {{0.5, 0}, {5, 0, 20}}),
                   heavy = of("bowling", {{1, 0}, {2, 0, 2.5}});
  CHECK(ResistedMotion(along, exact(), 0.01, true).rest_time() ==
        Approx(ResistedMotion(along, exact(), 0.01).rest_time()).epsilon(1e-6));
  for (const Experiment& experiment : {along, across, heavy}) {
    const ResistedMotion motion(experiment, exact(), 0.01, true);
    const auto speed = [&](double part) { return motion.at_time(part * motion.rest_time()).velocity.norm(); };
    CHECK(motion.at_time(motion.rest_time() / 2).slip < 1e-4);
    CHECK(speed(1) < 1.001e-4);
    CHECK(speed(0.998) > 1e-4);
  }
}

TEST_CASE("a ball that does not slide the way it rolls is integrated; without resistance it is the ball's motion",
          "[route][limit]") {
  for (const Eigen::Vector3d& w :
       {Eigen::Vector3d(0, 100, 50), Eigen::Vector3d(0, -100, 50), Eigen::Vector3d(30, -60, 50)}) {
    const Experiment experiment = pool(Velocities{{1, 0}, w});
    CHECK_FALSE(ResistedMotion(experiment, exact(), 0.01).is_reduced());
    const ResistedMotion almost_free(experiment, exact(), 1e-9);
    const BallMotion free(experiment, exact());
    CHECK(almost_free.stop_time() == Approx(free.stop_time()).epsilon(1e-5));
    for (double t : {0.05, 0.3, 2.0}) {
      CHECK((almost_free.at_time(t).position - free.at_time(t).position).norm() < 1e-6);
      CHECK((almost_free.at_time(t).velocity - free.at_time(t).velocity).norm() < 1e-6);
    }
  }
}

// Friction slows the ball down at f g, resistance its turning at chi u_r g - (chi - 1) f g, and it slides by the difference.
TEST_CASE("rolling friction above f: a ball that rolls slides at once, the whole motion and the uncoupled one",
          "[formula]") {
  const double R = pool(SlipAndSpin{0, 0}).ball.radius, chi = 3.5;
  const auto check = [&](const auto& motion, double g, double u_r) {
    const double f = 0.2, turning = (chi * u_r - (chi - 1) * f) * g;
    CHECK(motion.rest()->t == Approx(1 / (f * g)).epsilon(1e-6));
    CHECK(motion.rest()->place.x() == Approx(1 / (2 * f * g)).epsilon(1e-6));
    CHECK(motion.slip_length() == Approx((1 / f / g - 1 / turning) / 2).epsilon(1e-6));
    CHECK(motion.rolls == Approx(motion.rest()->t - 1e-3 / (f * g)).epsilon(1e-6));
    CHECK(motion.path_length(motion.rolls) == Approx(motion.event(motion.rolls).place.x()).epsilon(1e-6));
    for (double t : {0.1, 0.3, 0.5}) {
      const MotionPoint point = motion.at_time(t);
      CHECK(point.velocity.x() == Approx(1 - f * g * t).epsilon(1e-6));
      CHECK(R * point.angular_velocity.y() == Approx(std::max(0.0, 1 - turning * t)).margin(1e-7));
      CHECK(point.slip == Approx(point.velocity.x() - R * point.angular_velocity.y()).margin(1e-12));
    }
  };
  for (double u_r : {0.21, 0.3, 2.0}) {
    const Experiment rolls = pool(Velocities{{1, 0}, {0, 1 / R, 0}});
    const double g = rolls.environment.gravity;
    INFO("u_r " << u_r);
    check(Course<BallMotion>(rolls, {rolls, exact()}, 1e-3, u_r), g, u_r);
    check(Course<UncoupledMotion>(rolls, {rolls, exact()}, 1e-3, u_r), g, u_r);
    // Starts beside it move alike.
    const ResistedMotion there(rolls, exact(), u_r);
    for (double beside : {-1e-7, 1e-7}) {
      const ResistedMotion near(pool(Velocities{{1, 0}, {0, (1 + beside) / R, 0}}), exact(), u_r);
      CHECK(near.rest_time() == Approx(there.rest_time()).epsilon(1e-6));
      CHECK(near.slip_length() == Approx(there.slip_length()).epsilon(1e-5));
    }
  }
  // Friction just holds the ball: it rolls.
  const Experiment experiment = pool(Velocities{{1, 0}, {0, 1 / R, 0}});
  CHECK(ResistedMotion(experiment, exact(), 0.2).is_reduced());
  CHECK(ResistedMotion(experiment, exact(), 0.2).slip_length() == 0);
}

TEST_CASE("what rolling resistance cannot be", "[errors]") {
  const Experiment experiment = pool(SlipAndSpin{1, 100});
  for (double wrong : {0.0, -1.0, std::nan("")})
    CHECK_THROWS_AS(ResistedMotion(experiment, exact(), wrong), std::domain_error);
  const ResistedMotion motion(experiment, exact(), 0.01);
  CHECK_THROWS_AS(motion.at_time(-1), std::domain_error);
  CHECK_THROWS_AS(motion.slip_time(-1), std::domain_error);
  CHECK_THROWS_AS(ResistedMotion(find_ball("puck")->experiment, exact(), 0.01), std::domain_error);
}
