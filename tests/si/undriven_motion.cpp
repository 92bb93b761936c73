#include "contensou/si/motion.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "motion_cases.hpp"

using namespace contensou;
using namespace contensou::si;

TEST_CASE("the bowling ball of the textbook", "[table]") {
  Experiment experiment = find_ball("bowling")->experiment;
  experiment.ball.radius = 0.11;
  experiment.contact.friction = 0.19;
  experiment.environment.gravity = 9.8;
  experiment.start = Velocities{{8.10, 0}, {0, 0, 0}};
  for (const reduction::Law& law : reduction::named_laws()) {
    const Motion motion = Motion::reduced(experiment, law);
    const MotionPoint stop = motion.at(motion.stop_time());
    CHECK(motion.stop_time() == Approx(1.243).margin(5e-4));
    CHECK(stop.velocity.x() == Approx(5.786).margin(5e-4));
    CHECK(stop.position.x() == Approx(8.63).margin(5e-3));
    CHECK(stop.position.x() == Approx(12 * 8.1 * 8.1 / (49 * 0.19 * 9.8)).epsilon(1e-14));
    CHECK(motion.path_length(motion.stop_time()) == Approx(stop.position.x()).epsilon(1e-15));
    CHECK(motion.slip_length() == Approx(8.1 * 8.1 / (7 * 0.19 * 9.8)).epsilon(1e-13));
    CHECK(motion.spin_angle() == 0);
    CHECK(motion.slip_time(0.25 * 8.1) == Approx(0.75 * motion.stop_time()).epsilon(1e-12));
  }
}

TEST_CASE("both routes give the same motion to 1e-12", "[route]") {
  for (const reduction::Law& law : reduction::named_laws()) {
    const std::vector<double> all{1e-3, 1e-2, 0.1, 0.3, 1.0}, some{1e-3, 1.0};
    for (double mu : CONTENSOU_FULL_TESTS ? all : some) {
      if (law.force_slope() <= 5 * mu * mu / 7 * law.pivoting_moment()) continue;  // ends on a ray, has no curve
      for (const MotionCase& motion_case : motion_cases) {
        INFO(law.name() << ", mu = " << mu << ", " << motion_case.name);
        const Experiment experiment = experiment_of(motion_case, mu);
        const Motion reduced = Motion::reduced(experiment, law);
        const double stop = reduced.stop_time();
        const double sliding = 2 * slip_at_start(experiment) / (7 * 0.2 * 9.80665);
        Eigen::ArrayXd times(62);  // times of the slide, of the whole motion, and after its end
        times << Eigen::ArrayXd::LinSpaced(31, 0, 1.2 * stop), Eigen::ArrayXd::LinSpaced(31, 0, 2 * sliding);
        const MotionColumns a = reduced.at(times);
        const Motion integrated = Motion::in_steps(experiment, law);
        const MotionColumns b = integrated.at(times);

        const double R = experiment.ball.radius;
        const double speed = motion_case.start.velocity.norm() + R * motion_case.start.angular_velocity.norm();
        const double length = speed * stop + 1e-300;
        const double energy = experiment.ball.mass * speed * speed;
        const auto differ = [](const Eigen::ArrayXd& one, const Eigen::ArrayXd& other, double scale) {
          return (one - other).abs().maxCoeff() / scale;
        };
        CHECK(differ(a.x, b.x, length) < 1e-12);
        CHECK(differ(a.y, b.y, length) < 1e-12);
        CHECK(differ(a.vx, b.vx, speed) < 1e-12);
        CHECK(differ(a.vy, b.vy, speed) < 1e-12);
        CHECK(differ(a.wx, b.wx, speed / R) < 1e-12);
        CHECK(differ(a.wy, b.wy, speed / R) < 1e-12);
        CHECK(differ(a.wz, b.wz, speed / R) < 1e-12);
        CHECK(differ(a.slip, b.slip, speed) < 1e-12);
        CHECK(differ(a.energy, b.energy, energy) < 1e-12);
        CHECK(integrated.stop_time() == Approx(stop).epsilon(1e-12));
        CHECK(integrated.slip_length() == Approx(reduced.slip_length()).epsilon(1e-12));
        CHECK(integrated.spin_angle() == Approx(reduced.spin_angle()).epsilon(1e-12));
      }
    }
  }
}

// Cases: a masse shot, a ball that comes back, a ball that hardly moves. Steps are equal in the fourth root of time.
TEST_CASE("the path is the integral of the centre's speed", "[route]") {
  for (const MotionCase& motion_case : motion_cases) {
    for (double mu : {1e-2, 0.3}) {
      const Experiment experiment = experiment_of(motion_case, mu);
      const Motion motion = Motion::reduced(experiment, reduction::HertzLaw{});
      for (double end : {motion.slip_time(1e-3), 0.5 * motion.stop_time(), 1.5 * motion.stop_time()}) {
        constexpr Eigen::Index panels = 2000;
        const Eigen::ArrayXd s = Eigen::ArrayXd::LinSpaced(panels + 1, 0, 1);
        const MotionColumns at = motion.at(end * s.pow(4));
        const Eigen::ArrayXd rate = (at.vx.square() + at.vy.square()).sqrt() * 4 * end * s.cube();
        double path = 0;
        for (Eigen::Index i = 0; i < panels; i += 2) {
          path += (rate[i] + 4 * rate[i + 1] + rate[i + 2]) / (3 * panels);
        }
        CAPTURE(motion_case.name, mu, end);
        CHECK(motion.path_length(end) == Approx(path).epsilon(1e-6).margin(1e-12));
      }
    }
  }
}

TEST_CASE("after the stop the ball rolls on a straight line", "[invariant]") {
  for (const MotionCase& motion_case : motion_cases) {
    INFO(motion_case.name);
    const Experiment experiment = experiment_of(motion_case, 0.1);
    const Motion motion = Motion::reduced(experiment, reduction::HertzLaw{});
    const double stop = motion.stop_time();
    const Velocities rolling = final_motion(experiment);
    const MotionPoint here = motion.at(stop);
    const MotionPoint later = motion.at(stop + 3);
    CHECK((later.position - here.position - 3 * rolling.velocity).norm() < 1e-13 * (1 + later.position.norm()));
    for (const MotionPoint& point : {here, later}) {
      CHECK((point.velocity - rolling.velocity).norm() < 1e-15);
      CHECK((point.angular_velocity - rolling.angular_velocity).norm() < 2e-14);
      CHECK(point.slip == 0);
    }
  }
}

TEST_CASE("a masse shot curves while it slips", "[limit]") {
  const Experiment experiment = experiment_of(motion_cases[1], 0.1);
  const Motion motion = Motion::reduced(experiment, reduction::PadeLaw{});
  const auto direction = [&](double t) {
    const MotionPoint point = motion.at(t);
    return std::atan2(point.velocity.y(), point.velocity.x());
  };
  CHECK(direction(0) == 0);
  const double slips = motion.slip_time(0.01 * slip_at_start(experiment));
  double before = 0;
  for (int i = 1; i <= 10; ++i) {
    const double now = direction(slips * i / 10);
    CHECK(now < before);
    before = now;
  }
  CHECK(direction(motion.slip_time(1e-9)) == Approx(direction(2 * motion.stop_time())).epsilon(1e-9));
}

TEST_CASE("when the slip has fallen to a speed", "[route]") {
  for (const reduction::Law& law : reduction::named_laws()) {
    const Experiment experiment = experiment_of(motion_cases[2], 0.1);
    const Motion motion = Motion::reduced(experiment, law);
    for (double share : {0.9, 0.5, 1e-3}) {
      CHECK(motion.at(motion.slip_time(share * slip_at_start(experiment))).slip ==
            Approx(share * slip_at_start(experiment)).epsilon(1e-9));
    }
    CHECK(motion.slip_time(0) == motion.stop_time());
    CHECK(motion.slip_time(slip_at_start(experiment)) == 0);
    CHECK_THROWS_AS(motion.slip_time(-1), std::domain_error);
  }
  CHECK(Motion::reduced(experiment_of(motion_cases[5], 0.1), reduction::PadeLaw{}).slip_time(0.5) == 0);
}

TEST_CASE("a time before the start is refused", "[domain]") {
  const Motion motion = Motion::reduced(experiment_of(motion_cases[0], 0.1), reduction::PadeLaw{});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double t : {-1.0, nan}) {
    CHECK_THROWS_AS(motion.at(t), std::domain_error);
    CHECK_THROWS_AS(motion.path_length(t), std::domain_error);
  }
}
