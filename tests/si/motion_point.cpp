#include "contensou/si/motion.hpp"

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
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
    const Experiment experiment = experiment_of(motion_case, 0.1);
    const double R = experiment.ball.radius;
    const double v0 = slip_at_start(experiment);
    const MotionPoint start = motion_by_slip(experiment, 0, v0, 0, spin_at_start(experiment));
    CHECK(start.velocity == motion_case.start.velocity);
    CHECK(start.angular_velocity == motion_case.start.angular_velocity);
    CHECK(start.position.norm() == 0);
    const MotionPoint point = motion_by_slip(experiment, 1, v0 / 3, 0.1, 5);
    const Eigen::Vector2d contact{point.velocity.x() - R * point.angular_velocity.y(),
                                  point.velocity.y() + R * point.angular_velocity.x()};
    CHECK((contact - slip_velocity_at_start(experiment) / 3).norm() < 1e-14);
    const MotionPoint end = motion_by_slip(experiment, 1, 0, 0.1, 0);
    const EnergyLoss loss = energy_loss(experiment);
    CHECK(start.energy - end.energy == Approx(loss.sliding + loss.pivoting).epsilon(1e-12).margin(1e-15));
  }
}

TEST_CASE("any start ends in rolling along one line", "[invariant]") {
  Experiment experiment = find_ball("pool")->experiment;
  const double R = experiment.ball.radius;
  const Velocities start{{1, 0.5}, {20, -30, 40}};
  experiment.start = start;
  const auto [rolling, turning] = final_motion(experiment);
  CHECK(rolling.x() == Approx(R * turning.y()).epsilon(1e-15));
  CHECK(rolling.y() == Approx(-R * turning.x()).epsilon(1e-15));
  CHECK(turning.z() == 0);
  // The angular momentum about a point of the plane is constant: m R V_x + J omega_y and m R V_y - J omega_x.
  CHECK(rolling.x() + 0.4 * R * turning.y() == Approx(1 + 0.4 * R * -30).epsilon(1e-15));
  CHECK(rolling.y() - 0.4 * R * turning.x() == Approx(0.5 - 0.4 * R * 20).epsilon(1e-15));
  // A start by velocities and a start by slip and spin give the same motion.
  experiment.start = Velocities{{2, 0}, {0, 0, 7}};
  const Velocities general = final_motion(experiment);
  experiment.start = SlipAndSpin{.slip = 2, .spin = 7};
  CHECK(general.velocity.isApprox(final_motion(experiment).velocity, 1e-15));
  CHECK(general.angular_velocity.isApprox(final_motion(experiment).angular_velocity, 1e-15));
  // 7 R omega_y + 5 v is constant, where v is the slip.
  CHECK(7 * R * general.angular_velocity.y() == Approx(5 * 2).epsilon(1e-15));
}

TEST_CASE("a path is as long as the slide of a disc, at any speed", "[limit]") {
  Experiment puck = find_ball("puck")->experiment;
  for (const double slip : {1e-150, 1e-90, 1.0, 1e90, 1e150}) {
    CAPTURE(slip);
    puck.start = SlipAndSpin{.slip = slip, .spin = 0};
    const Motion motion = Motion::reduced(puck, *contensou::reduction::find_law(law_of(puck)));
    CHECK(motion.path_length(motion.stop_time()) == Approx(motion.slip_length()).epsilon(1e-13));
  }
}

TEST_CASE("a body that lies flat comes to rest, and loses all its energy", "[invariant]") {
  Experiment puck = find_ball("puck")->experiment;
  const contensou::reduction::Law law = *contensou::reduction::find_law(law_of(puck));
  const Motion motion = Motion::reduced(puck, law);
  const MotionPoint end = motion.at(motion.stop_time());
  CHECK(end.velocity.norm() < 1e-14);
  CHECK(end.angular_velocity == Eigen::Vector3d::Zero());
  CHECK(end.position.x() == Approx(motion.slip_length()).epsilon(1e-13));  // the puck slides along its whole path
  CHECK(final_motion(puck).velocity == Eigen::Vector2d::Zero());
  const auto [sliding, pivoting] = energy_loss(puck);
  CHECK(sliding == Approx(0.163 * 25 / 2).epsilon(1e-15));
  CHECK(sliding + pivoting == Approx(kinetic_energy(puck.ball, velocities_of(puck.start))).epsilon(1e-15));
  // Compare the power of friction, dE/dt = -f m g (Phi v + eps Psi |omega|), with a difference of the energy E.
  const double t = 0.4 * motion.stop_time(), dt = 1e-4;
  const MotionPoint at = motion.at(t);
  const double eps = patch_radius_of(puck, law);
  const auto [force, moment] = law(contensou::reduction::Slip{at.slip, eps * at.angular_velocity.z()});
  const double power = puck.contact.friction * puck.ball.mass * puck.environment.gravity *
                       (force * at.slip + eps * moment * at.angular_velocity.z());
  CHECK((motion.at(t - dt).energy - motion.at(t + dt).energy) / (2 * dt) == Approx(power).epsilon(1e-6));

  puck.start = Velocities{{1, 0}, {0, 1, 2}};
  CHECK_THROWS_WITH(require_experiment(puck), Catch::Matchers::Contains("turns about the vertical only"));
}

TEST_CASE("a body that lies flat by the equations of motion in steps", "[route]") {
  Experiment flat = find_ball("puck")->experiment;
  for (const char* body : {"disc", "ring"}) {
    for (const Body& known : bodies()) {
      if (known.name == body) flat.ball.body = known;
    }
    const contensou::reduction::Law law = *contensou::reduction::find_law(law_of(flat));
    for (const Velocities& start : {Velocities{{5, 0}, {0, 0, 100}},
                                    {{-0.2, 0.3}, {0, 0, -100}},
                                    {{1, 2}, {0, 0, 0}},
                                    {{0, 0}, {0, 0, 40}},
                                    {{5, 0}, {0, 0, 1e-3}}}) {
      flat.start = start;
      const Motion motion = Motion::reduced(flat, law);
      const double stop = motion.stop_time();
      const Eigen::ArrayXd times = Eigen::ArrayXd::LinSpaced(12, 0, 1.1 * stop);
      const Motion steps = Motion::in_steps(flat, law);
      const MotionColumns points = motion.at(times), by_steps = steps.at(times);
      INFO(body << ", vx " << start.velocity.x() << ", wz " << start.angular_velocity.z());
      CHECK(steps.stop_time() == Approx(stop).epsilon(1e-11));
      CHECK(steps.spin_angle() == Approx(motion.spin_angle()).epsilon(1e-10));
      const double length = std::max(motion.slip_length(), 1e-12);
      CHECK((by_steps.x - points.x).abs().maxCoeff() <= 1e-10 * length);
      CHECK((by_steps.y - points.y).abs().maxCoeff() <= 1e-10 * length);
      CHECK((by_steps.wz - points.wz).abs().maxCoeff() <= 1e-10 * 100);
      CHECK(by_steps.wx.abs().maxCoeff() == 0);
    }
  }
}
