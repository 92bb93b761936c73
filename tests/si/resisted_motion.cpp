#include "contensou/si/motion.hpp"

#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"

using namespace contensou;
using namespace contensou::si;

namespace {

const reduction::Law& exact() { return reduction::paper_laws().front(); }

Experiment pool(const Start& start, double u_r = 0) {
  Experiment experiment = find_ball("pool")->experiment;
  experiment.start = start;
  experiment.contact.rolling_friction = u_r;
  return experiment;
}

Motion motion_of(const Experiment& experiment) { return Motion::reduced(experiment, exact()); }

}  // namespace

TEST_CASE("a ball without spin: slip v/(1 - u_r/f), then it slows down evenly", "[formula]") {
  const double u_r = 0.01;
  const Experiment experiment = pool(SlipAndSpin{1, 0}, u_r);
  const double f = experiment.contact.friction, g = experiment.environment.gravity;
  const Motion motion = motion_of(experiment);
  CHECK(motion.is_reduced());
  CHECK_FALSE(motion.creep_ratio());
  const double slides = 2 / (7 * f * g * (1 - u_r / f));
  CHECK(motion.stop_time() == Approx(slides).epsilon(1e-14));
  const double rolls = 1 - f * g * slides;
  CHECK(motion.at(slides).velocity.x() == Approx(rolls).epsilon(1e-13));
  CHECK(motion.rest()->t == Approx(slides + rolls / (u_r * g)).epsilon(1e-13));
  const double way = slides - f * g * slides * slides / 2 + rolls * rolls / (2 * u_r * g);
  CHECK(motion.rest()->place.x() == Approx(way).epsilon(1e-13));
  CHECK(motion.path_length(100) == Approx(way).epsilon(1e-13));
  CHECK(motion.slip_length() == Approx(slides / 2).epsilon(1e-13));
}

// Reference: an integration in Python of slip, rolling and spin in the plane of the motion. It shares no code with us.
TEST_CASE("a pool ball with spin creeps, and turns no more before it rests", "[reference]") {
  const Motion motion = motion_of(pool(SlipAndSpin{1, 100}, 0.01));
  CHECK(motion.is_reduced());
  CHECK(motion.creep_ratio().value() == Approx(0.0426093361).epsilon(1e-9));
  CHECK(motion.at(0.31).slip == Approx(0.0129141402).epsilon(1e-8));
  CHECK(motion.at(0.31).position.x() == Approx(0.24102981).epsilon(1e-7));
  CHECK(motion.at(7).slip == Approx(0.003762867).epsilon(1e-7));
  CHECK(motion.at(7.2585).angular_velocity.y() > 0);
  CHECK(motion.at(7.2586).angular_velocity.y() == 0);
  CHECK(motion.slip_time(1e-3) == Approx(7.3016638).epsilon(1e-8));
  CHECK(motion.rest()->t == Approx(7.3800736).epsilon(1e-8));
  CHECK(motion.rest()->place.x() == Approx(2.6408730).epsilon(1e-8));
  CHECK(motion.spin_end() > 10);
  CHECK(motion.at(8).angular_velocity.z() > 0);
  CHECK(motion_of(pool(SlipAndSpin{1, 30}, 0.01)).stop_time() == Approx(3.1411203).epsilon(1e-7));
}

TEST_CASE("without steps and in steps: one motion", "[route]") {
  // Starts: slow spin (3 cases); fast spin; resistance holds the ball at first; topspin slower than rolling; rolling.
  const double R = pool(SlipAndSpin{1, 0}).ball.radius;
  const std::vector<std::pair<Start, double>> cases{{SlipAndSpin{1, 0}, 0.01},
                                                    {SlipAndSpin{1, 30}, 0.01},
                                                    {SlipAndSpin{1, -100}, 0.01},
                                                    {SlipAndSpin{0.5, 400}, 0.02},
                                                    {SlipAndSpin{1, 100}, 0.15},
                                                    {Velocities{{1, 0}, {0, 0.4 / R, 60}}, 0.01},
                                                    {Velocities{{0.6, 0.8}, {-0.8 / R, 0.6 / R, 60}}, 0.01}};
  for (const auto& [start, u_r] : cases) {
    const Experiment experiment = pool(start, u_r);
    INFO("slip " << slip_at_start(experiment) << ", spin " << spin_at_start(experiment) << ", u_r " << u_r);
    const Motion reduced = motion_of(experiment), in_steps = Motion::in_steps(experiment, exact());
    CHECK(reduced.is_reduced());
    CHECK_FALSE(in_steps.is_reduced());
    CHECK(in_steps.stop_time() == Approx(reduced.stop_time()).epsilon(1e-11));
    CHECK(in_steps.rest()->t == Approx(reduced.rest()->t).epsilon(2e-12));
    CHECK((in_steps.rest()->place - reduced.rest()->place).norm() < 1e-11);
    CHECK(in_steps.spin_angle() == Approx(reduced.spin_angle()).epsilon(1e-6));
    CHECK(in_steps.slip_length() == Approx(reduced.slip_length()).epsilon(1e-6));
    CHECK(in_steps.energy_balance().rolling == Approx(reduced.energy_balance().rolling).epsilon(1e-6));
    for (double part : {0.0, 0.01, 0.1, 0.5, 0.9, 1.1}) {
      const MotionPoint a = reduced.at(part * reduced.rest()->t), b = in_steps.at(part * reduced.rest()->t);
      CHECK((a.position - b.position).norm() < 1e-7);
      CHECK((a.velocity - b.velocity).norm() < 1e-7);
      CHECK((a.angular_velocity - b.angular_velocity).norm() < 1e-5);
    }
  }
}

// Reference for the rest: an integration in Python that shares no code with ours. It uses the variable ln|W| while the
// ball rolls slowly; W = R (omega_y, -omega_x) is the rolling velocity.
TEST_CASE("a ball that slides across its roll: rest and stop to the accuracy of the steps", "[reference][route]") {
  struct Row {
    Velocities start;
    double u_r, rest;
  };
  for (const auto& [start, u_r, rest] :
       {Row{{{0.9, 0.9}, {-31, -108, 105}}, 0.01, 9.65616449282538},
        Row{{{0.9, 0.9}, {-31, -108, 105}}, 0.03, 3.76814823802434},
        Row{{{1, 0}, {30, -60, 50}}, 0.03, 1.7021593006278}, Row{{{1, 0}, {-100, -40, 200}}, 0.03, 4.33783424024656}}) {
    CAPTURE(u_r, rest);
    const Motion motion = motion_of(pool(start, u_r));
    CHECK(motion.rest()->t == Approx(rest).margin(1e-11));
    // A motion that begins at an instant of this motion has other steps but must have the same end.
    for (const double share : {0.1, 0.3, 0.9}) {
      const MotionPoint here = motion.at(share * rest);
      const Motion later = motion_of(pool(Velocities{here.velocity, here.angular_velocity}, u_r));
      CHECK(here.t + later.rest()->t == Approx(rest).margin(1e-11));
      CHECK(here.t + later.stop_time() == Approx(motion.stop_time()).margin(1e-10));
    }
  }
}

TEST_CASE("a ball whose slip is below 1e-4 m/s while it rolls is not at rest", "[route]") {
  const auto of = [](const char* ball, const Velocities& start) {
    Experiment experiment = find_ball(ball)->experiment;
    experiment.start = start;
    experiment.contact.rolling_friction = 0.01;
    return experiment;
  };
  const Experiment along = of("steel", {{0.5, 0}, {0, 0, 20}}), across = of("steel", {{0.5, 0}, {5, 0, 20}}),
                   heavy = of("bowling", {{1, 0}, {2, 0, 2.5}});
  CHECK(Motion::in_steps(along, exact()).rest()->t == Approx(motion_of(along).rest()->t).epsilon(1e-6));
  for (const Experiment& experiment : {along, across, heavy}) {
    const Motion motion = Motion::in_steps(experiment, exact());
    const auto speed = [&](double part) { return motion.at(part * motion.rest()->t).velocity.norm(); };
    CHECK(motion.at(motion.rest()->t / 2).slip < 1e-4);
    CHECK(speed(1) < 1.001e-4);
    CHECK(speed(0.998) > 1e-4);
  }
}

TEST_CASE("a ball that does not slide the way it rolls is integrated; without resistance it is the ball's motion",
          "[route][limit]") {
  for (const Eigen::Vector3d& w :
       {Eigen::Vector3d(0, 100, 50), Eigen::Vector3d(0, -100, 50), Eigen::Vector3d(30, -60, 50)}) {
    const Velocities start{{1, 0}, w};
    CHECK_FALSE(motion_of(pool(start, 0.01)).is_reduced());
    const Motion almost_free = motion_of(pool(start, 1e-9)), free = motion_of(pool(start));
    CHECK(almost_free.stop_time() == Approx(free.stop_time()).epsilon(1e-5));
    for (double t : {0.05, 0.3, 2.0}) {
      CHECK((almost_free.at(t).position - free.at(t).position).norm() < 1e-6);
      CHECK((almost_free.at(t).velocity - free.at(t).velocity).norm() < 1e-6);
    }
  }
}

// Friction slows the velocity V down at the rate f g. Resistance slows R omega_y down at the rate chi u_r g - (chi - 1)
// f g. The slip is V - R omega_y.
TEST_CASE("rolling friction above f: a ball that rolls slides at once, the whole motion and the uncoupled one",
          "[formula]") {
  const double R = pool(SlipAndSpin{0, 0}).ball.radius, chi = 3.5;
  const auto check = [&](const Motion& motion, double g, double u_r) {
    const double f = 0.2, turning = (chi * u_r - (chi - 1) * f) * g;
    CHECK(motion.rest()->t == Approx(1 / (f * g)).epsilon(1e-6));
    CHECK(motion.rest()->place.x() == Approx(1 / (2 * f * g)).epsilon(1e-6));
    CHECK(motion.slip_length() == Approx((1 / f / g - 1 / turning) / 2).epsilon(1e-6));
    CHECK(motion.rolls() == Approx(motion.rest()->t - 1e-3 / (f * g)).epsilon(1e-6));
    CHECK(motion.path_length(motion.rolls()) == Approx(motion.event(motion.rolls()).place.x()).epsilon(1e-6));
    for (double t : {0.1, 0.3, 0.5}) {
      const MotionPoint point = motion.at(t);
      CHECK(point.velocity.x() == Approx(1 - f * g * t).epsilon(1e-6));
      CHECK(R * point.angular_velocity.y() == Approx(std::max(0.0, 1 - turning * t)).margin(1e-7));
      CHECK(point.slip == Approx(point.velocity.x() - R * point.angular_velocity.y()).margin(1e-12));
    }
  };
  for (double u_r : {0.21, 0.3, 2.0}) {
    const Experiment rolls = pool(Velocities{{1, 0}, {0, 1 / R, 0}}, u_r);
    const double g = rolls.environment.gravity;
    INFO("u_r " << u_r);
    const Motion there = motion_of(rolls);
    check(there, g, u_r);
    check(Motion::uncoupled(rolls, exact()), g, u_r);
    // Neighbouring starts have nearly the same motion.
    for (double beside : {-1e-7, 1e-7}) {
      const Motion near = motion_of(pool(Velocities{{1, 0}, {0, (1 + beside) / R, 0}}, u_r));
      CHECK(near.rest()->t == Approx(there.rest()->t).epsilon(1e-6));
      CHECK(near.slip_length() == Approx(there.slip_length()).epsilon(1e-5));
    }
  }
  // Friction f N just suffices to keep the ball rolling.
  const Motion held = motion_of(pool(Velocities{{1, 0}, {0, 1 / R, 0}}, 0.2));
  CHECK(held.is_reduced());
  CHECK(held.slip_length() == 0);
}

TEST_CASE("what rolling resistance cannot be", "[errors]") {
  for (double wrong : {-1.0, std::nan("")})
    CHECK_THROWS_AS(motion_of(pool(SlipAndSpin{1, 100}, wrong)), std::domain_error);
  const Motion motion = motion_of(pool(SlipAndSpin{1, 100}, 0.01));
  CHECK_THROWS_AS(motion.at(-1), std::domain_error);
  CHECK_THROWS_AS(motion.slip_time(-1), std::domain_error);
  Experiment puck = find_ball("puck")->experiment;
  puck.contact.rolling_friction = 0.01;
  CHECK_THROWS_AS(motion_of(puck), std::domain_error);
}

TEST_CASE("what nothing resists is one orbit without a drive", "[limit]") {
  const std::vector<ReducedPiece> pieces = motion_of(pool(SlipAndSpin{1, 100})).pieces();
  REQUIRE(pieces.size() == 1);
  CHECK(pieces.front().flow.system().drive() == 0);
  CHECK(pieces.front().turns);
  CHECK_FALSE(motion_of(pool(SlipAndSpin{1, 100})).rest());
}
