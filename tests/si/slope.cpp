#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

#include <Eigen/Core>
#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"
#include "si/motion/pure_rolling.hpp"

using namespace contensou;
using namespace contensou::si;
using Catch::Matchers::Contains;
using Eigen::Vector2d;

namespace {

const reduction::Law& hertz() { return reduction::paper_laws().front(); }

double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

Experiment ball_on(double slope, const Start& start, double u_r = 0, const char* name = "pool") {
  Experiment experiment = find_ball(name)->experiment;
  experiment.start = start;
  experiment.environment.slope = slope;
  experiment.contact.rolling_friction = u_r;
  return experiment;
}

Motion motion_on(const Experiment& experiment) { return Motion::reduced(experiment, hertz()); }

/// x, y, vx, vy, wx, wy, wz of a rigid ball.
using Rigid = std::array<double, 7>;

/// Newton's and Euler's equations of a rigid ball. They contain the force of a law, but no slip, rolling or reduction.
Rigid rates(const Experiment& experiment, const reduction::Law& law, const Rigid& x) {
  const double g = experiment.environment.gravity, alpha = radians(experiment.environment.slope);
  const double m = experiment.ball.mass, R = experiment.ball.radius, J = 0.4 * m * R * R, N = m * g * std::cos(alpha);
  const double f = experiment.contact.friction, eps = patch_radius_of(experiment, law);
  const double cx = x[2] - R * x[5], cy = x[3] + R * x[4], v = std::hypot(cx, cy);
  const auto [force, moment] = law({v, eps * std::abs(x[6])});
  const double Fx = v > 0 ? -f * N * force * cx / v : 0, Fy = v > 0 ? -f * N * force * cy / v : 0;
  // Rolling resistance is a torque against the rotation about a horizontal axis.
  const double turning = std::hypot(x[4], x[5]);
  const double torque = 1.4 * experiment.contact.rolling_friction * N * R;
  const double tx = turning > 0 ? -torque * x[4] / turning : 0, ty = turning > 0 ? -torque * x[5] / turning : 0;
  const double spin = x[6] > 0 ? 1 : x[6] < 0 ? -1 : 0;
  return {x[2],
          x[3],
          Fx / m - g * std::sin(alpha),
          Fy / m,
          (R * Fy + tx) / J,
          (-R * Fx + ty) / J,
          -spin * f * N * eps * moment / J};
}

Rigid stepped(const Experiment& experiment, const reduction::Law& law, double end, int steps) {
  const auto [velocity, w] = velocities_of(experiment.start);
  Rigid x{0, 0, velocity.x(), velocity.y(), w.x(), w.y(), w.z()};
  const double h = end / steps;
  const auto at = [&](const Rigid& from, const Rigid& slope, double part) {
    Rigid there = from;
    for (std::size_t i = 0; i < there.size(); ++i) there[i] += part * slope[i];
    return there;
  };
  for (int n = 0; n < steps; ++n) {
    const Rigid a = rates(experiment, law, x), b = rates(experiment, law, at(x, a, h / 2));
    const Rigid c = rates(experiment, law, at(x, b, h / 2)), d = rates(experiment, law, at(x, c, h));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return x;
}

void check_rigid(const MotionPoint& point, const Rigid& truth, double allowed) {
  CHECK(point.position.x() == Approx(truth[0]).margin(allowed));
  CHECK(point.position.y() == Approx(truth[1]).margin(allowed));
  CHECK(point.velocity.x() == Approx(truth[2]).margin(allowed));
  CHECK(point.velocity.y() == Approx(truth[3]).margin(allowed));
  for (Eigen::Index i = 0; i < 3; ++i)
    CHECK(point.angular_velocity[i] == Approx(truth[static_cast<std::size_t>(4 + i)]).margin(100 * allowed));
}

}  // namespace

TEST_CASE("a ball without spin on a slope, in closed form", "[formula][slope]") {
  for (double slope : {-2.0, -0.1, 2.0, 5.0}) {
    for (double u_r : {0.0, 0.01}) {
      const Experiment experiment = ball_on(slope, SlipAndSpin{1, 0}, u_r);
      const Motion motion = motion_on(experiment);
      INFO("slope " << slope << ", u_r " << u_r);
      CHECK(motion.is_reduced() == (slope < 0));
      const double f = experiment.contact.friction, g = experiment.environment.gravity, alpha = radians(slope);
      const double drive = (u_r - std::tan(alpha) / 3.5) / f;
      const double slides = 2 / (7 * f * g * std::cos(alpha) * (1 - drive)), exact = motion.is_reduced() ? 1e-13 : 1e-7;
      CHECK(motion.stop_time() == Approx(slides).epsilon(exact));
      const double speed = 1 - (f * std::cos(alpha) + std::sin(alpha)) * g * slides;
      CHECK(motion.at(slides).velocity.x() == Approx(speed).epsilon(10 * exact));
      // After the slide the ball rolls: uphill (slope > 0) until it turns round or rests, or downhill (slope < 0).
      const double up = (5.0 / 7 * std::sin(alpha) + u_r * std::cos(alpha)) * g;
      const double half = 0.5 * (up > 0 ? speed / up : 1);
      CHECK(motion.at(slides + half).velocity.x() == Approx(speed - up * half).epsilon(10 * exact));
      const bool holds = u_r >= 5.0 / 7 * std::abs(std::tan(alpha));
      CHECK(motion.rest().has_value() == holds);
      if (slope < 0 || holds) continue;
      const double back = (5.0 / 7 * std::sin(alpha) - u_r * std::cos(alpha)) * g;
      CHECK(motion.at(slides + speed / up + 1).velocity.x() == Approx(-back).epsilon(1e-6));
    }
  }
}

TEST_CASE("slip and spin end as a drive of 2 tan(angle)/(7 f) has it", "[formula][slope]") {
  const double slope = -3;
  const Experiment experiment = ball_on(slope, SlipAndSpin{1, 100});
  const reduction::ReducedSystem system = reduced_system(experiment, hertz());
  CHECK(system.drive() == Approx(2 * std::tan(radians(3)) / (7 * experiment.contact.friction)).epsilon(1e-15));
  const double tau = reduction::Flow(system).stop_time(reduced_start(experiment)).tau;
  const double t = 2 * tau / (3 * std::numbers::pi * experiment.contact.friction * 9.80665 * std::cos(radians(3)));
  CHECK(motion_on(experiment).stop_time() == Approx(t).epsilon(1e-14));
  CHECK(motion_on(experiment).creep_ratio().value() ==
        Approx(reduction::Flow(system).terminal().rays.at(0).k).epsilon(1e-14));
  // A puck has chi = 1. The pull of the slope does not make it roll.
  const Experiment puck = ball_on(-2, SlipAndSpin{5, 100}, 0, "puck");
  CHECK(reduced_system(puck, hertz()).drive() == Approx(std::tan(radians(2)) / puck.contact.friction).epsilon(1e-15));
}

TEST_CASE("a ball on a slope against Newton's and Euler's equations in steps", "[reference][slope]") {
  const std::vector<std::tuple<double, Start, double>> cases{{-3, SlipAndSpin{1, 100}, 0},
                                                             {-3, SlipAndSpin{1, 100}, 0.01},
                                                             {-1, SlipAndSpin{0, 60}, 0},
                                                             {4, SlipAndSpin{1, 100}, 0},
                                                             {4, SlipAndSpin{0.3, -200}, 0},
                                                             {-3, Velocities{{1, 0.5}, {0, 3, 80}}, 0},
                                                             {3, Velocities{{1, 0.5}, {10, 3, -80}}, 0.01},
                                                             {-2, Velocities{{1, 0}, {0, 20, 60}}, 0.01},
                                                             {2, Velocities{{-1, 0}, {0, -20, 60}}, 0}};
  for (const auto& [slope, start, u_r] : cases) {
    const Experiment experiment = ball_on(slope, start, u_r);
    const Motion motion = motion_on(experiment);
    for (double t : {0.02, 0.15, 0.4}) {
      INFO("slope " << slope << ", u_r " << u_r << ", slip " << slip_at_start(experiment) << ", t " << t);
      check_rigid(motion.at(t), stepped(experiment, hertz(), t, 20'000), 1e-7);
    }
  }
}

TEST_CASE("random balls and pucks on slopes: without steps and in steps one motion", "[route][slope]") {
  std::mt19937 random(20'281);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const std::vector<reduction::Law> laws{*reduction::find_law("exact"), *reduction::find_law("pade"),
                                         *reduction::find_law("uniform"), *reduction::find_law("paraboloid")};
  constexpr int shots = CONTENSOU_FULL_TESTS ? 4000 : 200;
  int several = 0, held_first = 0;
  for (int i = 0; i < shots; ++i) {
    const bool flat = i % 5 == 0;
    const reduction::Law& law = laws[static_cast<std::size_t>(i) % laws.size()];
    Experiment experiment = find_ball(flat ? "puck" : "pool")->experiment;
    const double R = experiment.ball.radius, f = uniform(0.05, 0.5);
    experiment.contact.friction = f;
    experiment.contact.patch = PatchRadius{R * (flat ? 1.0 : std::pow(10, uniform(-0.9, 0)))};
    const double u_r = flat || i % 3 == 0 ? 0 : f * std::pow(10, uniform(-2, -0.2));
    experiment.contact.rolling_friction = u_r;
    const double most = flat || 5 * f <= 7 * u_r ? f : 3.5 * (f - u_r);
    experiment.environment.slope =
        i % 7 == 1 && u_r > 0 ? 0 : -std::atan(uniform(0.01, 0.9) * most) * (180 / std::numbers::pi);
    const double slip = uniform(0, 1) < 0.2 ? 0 : uniform(0, 2), spin = uniform(-1, 1) * 2 / R;
    if (flat || uniform(0, 1) < 0.6) {
      experiment.start = SlipAndSpin{slip, spin};
    } else {  // a ball, which also rolls
      const double rolls = uniform(0, 0.5);
      experiment.start = Velocities{{slip + rolls, 0}, {0, rolls / R, spin}};
    }
    const Motion reduced = Motion::reduced(experiment, law), in_steps = Motion::in_steps(experiment, law);
    INFO(i << ": law " << law.name() << ", flat " << flat << ", f " << f << ", u_r " << u_r << ", slope "
           << experiment.environment.slope << ", slip " << slip << ", R spin " << R * spin << ", mu "
           << patch_ratio(experiment, law) << ", pieces " << reduced.pieces().size());
    CHECK_FALSE(in_steps.is_reduced());
    if (!reduced.is_reduced()) continue;  // this body rolls, and its resistance exceeds friction
    several += reduced.pieces().size() > 1;
    held_first += !flat && !reduced.pieces().empty() && !reduced.pieces().front().turns;
    const double stop = reduced.stop_time(), size = 2 + 10 * stop;
    REQUIRE(in_steps.stop_time() == Approx(stop).epsilon(1e-5).margin(1e-9));
    CHECK(in_steps.rest().has_value() == reduced.rest().has_value());
    CHECK(in_steps.slip_length() == Approx(reduced.slip_length()).epsilon(1e-5).margin(1e-8));
    CHECK(in_steps.spin_angle() == Approx(reduced.spin_angle()).epsilon(1e-5).margin(1e-7));
    for (double part : {0.1, 0.5, 0.9, 1.2}) {
      const MotionPoint a = reduced.at(part * stop), b = in_steps.at(part * stop);
      REQUIRE((a.position - b.position).norm() < 1e-6 * size * (1 + stop));
      REQUIRE((a.velocity - b.velocity).norm() < 1e-6 * size);
      REQUIRE((a.angular_velocity - b.angular_velocity).norm() < 1e-6 * size / R);
    }
  }
  CHECK(several > shots / 27);
  CHECK(held_first > shots / 80);
}

// Reference: Newton's and Euler's equations by SciPy's Radau, with friction and resistance regularised below 1e-7 m/s.
// The ball rolls across the slope and turns downhill. At some angle rolling needs more than f N; the ball slides.
TEST_CASE("a ball that rolls down slides when friction no longer holds it", "[reference][slope]") {
  const double R = find_ball("pool")->experiment.ball.radius;
  const Experiment experiment = ball_on(-6, Velocities{{0, 0.5}, {-0.5 / R, 0, 0}}, 0.19);
  const Motion motion = motion_on(experiment);
  CHECK_FALSE(motion.is_reduced());
  // At the beginning of the slide rolling needs all the friction: |tan(angle)/chi + u_r V/|V|| = f.
  const double share = std::tan(radians(6)) / 3.5, rolls = motion.slip_time(0) / 10;
  for (double t : {0.05, 0.1, 0.11, 0.12, 0.13, 0.14, 0.15, 0.2}) {
    const MotionPoint point = motion.at(t);
    const Vector2d needed = Vector2d(share, 0) + 0.19 * point.velocity.normalized();
    INFO("t " << t << ", needs " << needed.norm());
    if (point.slip == 0) CHECK(needed.norm() <= 0.2 * (1 + 1e-12));
    if (needed.norm() < 0.1999) CHECK(point.slip == 0);
  }
  CHECK(motion.at(rolls).slip == 0);
  CHECK(motion.at(0.3).slip > 0.03);
  CHECK(motion.rest()->t == Approx(0.3378015).margin(3e-6));
  CHECK(motion.rest()->place.x() == Approx(0.0167889).margin(1e-6));
  CHECK(motion.rest()->place.y() == Approx(0.0706613).margin(1e-6));
  CHECK(motion.slip_length() == Approx(0.0029546).margin(2e-6));
  // Cases: a ball that needs more friction than f N from the start; a ball for which f N always suffices.
  const Motion at_once = motion_on(ball_on(-6, Velocities{{0.3, 0.5}, {-0.5 / R, 0.3 / R, 0}}, 0.19));
  CHECK(at_once.rest()->t == Approx(0.5130047).margin(2e-6));
  CHECK((at_once.rest()->place - Vector2d(0.0951515, 0.0948541)).norm() < 1e-6);
  CHECK(at_once.slip_length() == Approx(0.0337911).margin(1e-6));
  Experiment held = experiment;
  held.contact.friction = 0.19 + std::tan(radians(6)) / 3.5 + 1e-9;
  CHECK(motion_on(held).slip_length() == 0);
  held.contact.friction -= 2e-6;
  CHECK(motion_on(held).slip_length() > 0);
  // A ball that rolls straight down slides from the start.
  const Experiment down = ball_on(-6, Velocities{{0.5, 0}, {0, 0.5 / R, 0}}, 0.19);
  CHECK(motion_on(down).at(0.01).slip > 0);
}

TEST_CASE("energy on a slope: what gravity gives is in the balance", "[formula][slope]") {
  for (double slope : {-3.0, 3.0}) {
    for (const Start& start : {Start(SlipAndSpin{1, 100}), Start(Velocities{{1, 0.5}, {0, 3, 80}})}) {
      const Experiment experiment = ball_on(slope, start, 0.01);
      const Motion motion = motion_on(experiment);
      const double first = motion.at(0).energy, gained = motion.energy_balance().gained;
      const double kept = motion.at(motion.last_time()).energy;
      const double spun = energy_loss(experiment).pivoting;
      const double slid = first + gained - kept - spun - motion.energy_balance().rolling;
      INFO("slope " << slope << ", gained " << gained);
      const double fell = -std::sin(radians(slope)) * motion.at(motion.last_time()).position.x();
      CHECK(gained == Approx(experiment.ball.mass * experiment.environment.gravity * fell).epsilon(1e-12));
      // The friction force never exceeds f N.
      const double N = experiment.ball.mass * pressing(experiment.environment);
      CHECK(slid > 0);
      CHECK(slid < experiment.contact.friction * N * motion.slip_length() * (1 + 1e-6));
    }
  }
}

TEST_CASE("as the slope vanishes, the motion on the level", "[limit][slope]") {
  for (const Start& start : {Start(SlipAndSpin{1, 100}), Start(Velocities{{1, 0}, {30, -60, 50}})}) {
    const Motion level = Motion::reduced(ball_on(0, start), hertz());
    for (double slope : {-1e-7, 1e-7}) {
      const Motion almost = motion_on(ball_on(slope, start));
      CHECK(almost.stop_time() == Approx(level.stop_time()).epsilon(1e-6));
      for (double t : {0.05, 0.3, 2.0}) {
        CHECK((almost.at(t).position - level.at(t).position).norm() < 1e-6);
        CHECK((almost.at(t).velocity - level.at(t).velocity).norm() < 1e-6);
      }
    }
  }
  // Without a slope, the drive is exactly 0, and the pressing acceleration is exactly gravity.
  const Experiment level = ball_on(0, SlipAndSpin{1, 100});
  CHECK(reduced_system(level, hertz()).drive() == 0);
  CHECK(pressing(level.environment) == level.environment.gravity);
}

TEST_CASE("pure rolling on a slope against Runge-Kutta", "[formula][slope]") {
  const Vector2d pull(-0.7, 0);
  for (double resisting : {0.0, 0.3, 0.7, 0.71, 1.4}) {
    for (const Vector2d& start : {Vector2d(1, 0.5), Vector2d(-1, 0.01), Vector2d(1, 0.05), Vector2d(0, 2)}) {
      const PureRolling rolling(start, pull, resisting);
      const double rest = rolling.rest_time(), end = std::min(2.0, 0.9 * rest);
      Vector2d velocity = start, place(0, 0);
      double path = 0;
      constexpr int steps = CONTENSOU_FULL_TESTS ? 100'000 : 10'000;
      const double h = end / steps;
      const auto rate = [&](const Vector2d& v) { return Vector2d(pull - resisting * v / v.norm()); };
      for (int i = 0; i < steps; ++i) {
        const Vector2d a = rate(velocity), b = rate(velocity + h / 2 * a), c = rate(velocity + h / 2 * b);
        const Vector2d middle = velocity + h / 2 * b, last = velocity + h * c;
        place += h / 6 * (velocity + 4 * middle + last);
        path += h / 6 * (velocity.norm() + 4 * middle.norm() + last.norm());
        velocity += h / 6 * (a + 2 * b + 2 * c + rate(last));
      }
      INFO("a " << resisting << ", from (" << start.x() << ", " << start.y() << ") for " << end);
      const auto here = rolling.after(end);
      CHECK((here.velocity - velocity).norm() < 1e-6);
      CHECK((here.way - place).norm() < 1e-6);
      CHECK(here.path == Approx(path).epsilon(1e-6));
      CHECK(std::isinf(rest) == (resisting <= 0.7));
      if (std::isfinite(rest)) CHECK(rolling.after(2 * rest).velocity.norm() < 1e-9);
    }
  }
  CHECK(PureRolling({0, 0}, pull, 0.7).rest_time() == 0);
  CHECK(PureRolling({0, 0}, pull, 0.7).after(5).path == 0);
  CHECK(PureRolling({0, 0}, pull, 0.5).after(5).way.x() == Approx(-0.5 * 0.2 * 25));
  CHECK(PureRolling({2, 0}, {0, 0}, 0.5).rest_time() == 4);
  CHECK(PureRolling({2, 0}, {0, 0}, 0).after(3).way.x() == 6);
}

TEST_CASE("the textbook's ball on a slope is one without spin, and spins by itself", "[slope]") {
  const Experiment experiment = ball_on(-2, SlipAndSpin{1, 100}), still = ball_on(-2, SlipAndSpin{1, 0});
  const Motion textbook = Motion::uncoupled(experiment, hertz(), 0), spinless = Motion::reduced(still, hertz());
  CHECK(textbook.rolls(0) == Approx(spinless.rolls(0)).epsilon(1e-13));
  CHECK(textbook.stop_time() == textbook.spin_end());
  CHECK_FALSE(textbook.rest());
  for (double t : {0.1, 1.0, 20.0}) {
    CHECK((textbook.at(t).position - spinless.at(t).position).norm() < 1e-12 * (1 + t * t));
    CHECK(textbook.at(t).angular_velocity.z() == Approx(std::max(0.0, 100 * (1 - t / textbook.spin_end()))));
  }
}

TEST_CASE("what slides on too steep a slope never stops, and that is said", "[errors][slope]") {
  const double f = find_ball("pool")->experiment.contact.friction;
  const double steepest = std::atan(3.5 * f) * (180 / std::numbers::pi);
  CHECK_NOTHROW(motion_on(ball_on(-0.999 * steepest, SlipAndSpin{1, 100})));
  for (double slope : {1.001 * steepest, -1.001 * steepest, 89.0}) {
    CHECK_THROWS_WITH(motion_on(ball_on(slope, SlipAndSpin{1, 100})), Contains("never stops sliding"));
    CHECK_THROWS_WITH(Motion::in_steps(ball_on(slope, SlipAndSpin{1, 100}), hertz()), Contains("never stops sliding"));
  }
  CHECK_THROWS_WITH(reduced_system(ball_on(2, SlipAndSpin{1, 100}), hertz()), Contains("must slide straight down"));
  CHECK_THROWS_WITH(reduced_system(ball_on(-2, Velocities{{1, 0.5}, {0, 0, 9}}), hertz()),
                    Contains("must slide straight down"));
  CHECK_THROWS_WITH(reduced_system(ball_on(-2, Velocities{{1, 0}, {0, -3, 9}}), hertz()),
                    Contains("roll the way it slides"));
  CHECK_THROWS_WITH(motion_on(ball_on(90, SlipAndSpin{1, 100})), Contains("above -90 and below 90"));
  CHECK_THROWS_WITH(motion_on(ball_on(-2, SlipAndSpin{1, 100}, 0.01, "puck")), Contains("never rolls"));
  Experiment loaded = ball_on(-2, SlipAndSpin{1, 100});
  loaded.environment.load = 3;
  CHECK_THROWS_WITH(motion_on(loaded), Contains("a load and a slope exclude each other"));
}
