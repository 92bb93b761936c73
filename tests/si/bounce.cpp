#include "contensou/si/bounce.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <catch2/catch.hpp>

#include <boost/math/quadrature/tanh_sinh.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/motion.hpp"

using namespace contensou;
using namespace contensou::si;

namespace {

Experiment coming(const char* name, double patch, Velocities start) {
  Experiment experiment = find_ball(name)->experiment;
  if (patch > 0) experiment.contact.patch = PatchRadius{patch};
  experiment.start = start;
  return experiment;
}

constexpr Impact slow{.normal_speed = 1, .restitution = 0.5};

}  // namespace

TEST_CASE("a ball without spin leaves as textbooks say: f (1 + e) v_n, or 2/7 of the slip", "[bounce]") {
  const reduction::Law law = *reduction::find_law("exact");
  for (const double slip : {0.3, 1.0, 1.04, 1.06, 5.0}) {
    CAPTURE(slip);
    const Experiment ball = coming("pool", 2.83e-3, {{slip, 0}, {0, 0, 0}});
    const double change = std::min(0.2 * 1.5, 2 * slip / 7);
    for (const Rebound& end : {bounce(ball, law, slow, 0), uncoupled_bounce(ball, law, slow, 0)}) {
      CHECK(end.velocities.velocity.x() == Approx(slip - change).epsilon(1e-13));
      CHECK(end.velocities.angular_velocity.y() == Approx(2.5 * change / 0.028575).epsilon(1e-12));
      CHECK(end.slip == Approx(slip - 3.5 * change).margin(1e-13));
      CHECK(end.grip == Approx(slip / (3.5 * 0.3)).epsilon(1e-13));
    }
  }
  // Topspin faster than rolling drives the ball forward. A shell gains 2/5 of its slip as velocity.
  const Rebound topspin = bounce(coming("basketball", 5e-3, {{1, 0}, {0, 30, 0}}), law, {2, 0.5}, 0);
  CHECK(topspin.velocities.velocity.x() == Approx(1 + 2.0 / 5 * (30 * 0.121 - 1)).epsilon(1e-12));
}

TEST_CASE("spin takes from the grip: 0.2857, 0.2605, 0.2316, 0.1805 m/s", "[bounce]") {
  const reduction::Law law = *reduction::find_law("exact");
  for (const auto& [spin, change] : {std::pair{0.0, 0.2857}, {100.0, 0.2605}, {200.0, 0.2316}, {400.0, 0.1805}}) {
    const Rebound end = bounce(coming("pool", 2.83e-3, {{1, 0}, {0, 0, spin}}), law, slow);
    CHECK(1 - end.velocities.velocity.x() == Approx(change).margin(5e-5));
    CHECK((end.grip <= 1) == (spin == 0));
  }
}

TEST_CASE("the textbook's force and moment act each for itself, of a spinning ball, too", "[bounce]") {
  const reduction::Law law = *reduction::find_law("exact");
  const Rebound end = uncoupled_bounce(coming("pool", 2.83e-3, {{1, 0}, {0, 0, 100}}), law, slow);
  CHECK(1 - end.velocities.velocity.x() == Approx(2.0 / 7).epsilon(1e-12));  // the spin does not change the result
  const double impulse = 1.5, moment = 0.2 * 2.83e-3 * 3 * std::numbers::pi / 16;
  CHECK(100 - end.velocities.angular_velocity.z() ==
        Approx(2.5 * moment * impulse / (0.028575 * 0.028575)).epsilon(1e-9));
}

TEST_CASE("however the load comes and goes, its impulse counts", "[bounce][route]") {
  const reduction::Law law = *reduction::find_law("exact");
  const Experiment ball = coming("pool", 2.83e-3, {{1, 0.5}, {3, -20, 300}});
  const Impact hard{.normal_speed = 4, .restitution = 0.7};
  const Rebound end = bounce(ball, law, hard);
  // The load over time is a triangle with two unequal sides; it lasts 3 ms and has the impulse m (1 + e) v_n.
  const double peak = hard.impulse() * ball.ball.mass / 1.5e-3;
  Experiment pressed = ball;
  constexpr double first = 1;
  pressed.environment = {.gravity = first / ball.ball.mass, .load = first};
  const Motion motion =
      Motion::reduced(pressed, law, LoadHistory({0, 0, 0.7e-3, 3e-3, 3e-3}, {first, 0, peak, 0, first}));
  const MotionPoint after = motion.at(3e-3);
  CHECK((end.velocities.velocity - after.velocity).norm() < 1e-11);
  CHECK((end.velocities.angular_velocity - after.angular_velocity).norm() < 1e-9);
  CHECK(end.slip == Approx(after.slip).epsilon(1e-11));
}

TEST_CASE("the patch of an elastic impact, a mean over the impulse, against steps in which it follows the load",
          "[bounce][route]") {
  const double integral = boost::math::quadrature::tanh_sinh<double>().integrate(
      [](double w) { return std::pow(1 - w * w, 0.2); }, 0.0, 1.0);
  const HertzModuli moduli = std::get<HertzModuli>(find_ball("steel")->experiment.contact.patch);
  const double m = 0.0327, R = 0.01, v = 2, E = effective_modulus(moduli);
  // The largest depth d of the dent follows from the energy: m v^2/2 = (8/15) E sqrt(R) d^(5/2).
  const double dent = std::pow(15 * m * v * v / (16 * E * std::sqrt(R)), 0.4);
  CHECK(hertz_impact_patch_radius(m, v, R, moduli) == Approx(integral * std::sqrt(R * dent)).epsilon(1e-12));

  const reduction::Law law = *reduction::find_law("exact");
  const Experiment ball = coming("rubber", 0, {{3, 0}, {0, 0, 300}});
  const Impact elastic{.normal_speed = 1, .restitution = 1};
  const Rebound end = bounce(ball, law, elastic);
  const double widest =
      hertz_impact_patch_radius(0.072, 1, 0.025, std::get<HertzModuli>(ball.contact.patch)) / integral;
  std::array<double, 2> state{3, 300};
  constexpr int steps = 20000;
  const double h = elastic.impulse() / steps;
  const auto rate = [&](const std::array<double, 2>& s, double impulse) {
    const double w = 1 - impulse, eps = widest * std::pow(std::max(1e-12, 1 - w * w), 0.2);
    const auto [force, moment] = law(reduction::Slip{std::max(0.0, s[0]), eps * s[1]});
    return std::array{-3.5 * 0.6 * force, -2.5 * 0.6 * eps * moment / (0.025 * 0.025)};
  };
  for (int i = 0; i < steps; ++i) {
    const auto a = rate(state, i * h);
    const auto b = rate({state[0] + h / 2 * a[0], state[1] + h / 2 * a[1]}, (i + 0.5) * h);
    for (std::size_t j = 0; j < 2; ++j) state[j] += h * b[j];
  }
  const double followed = (3 - state[0]) / 3.5, held = 3 - end.velocities.velocity.x();
  UNSCOPED_INFO("velocity " << followed << " where the patch follows, " << held << " held; spin " << 300 - state[1]
                            << ", " << 300 - end.velocities.angular_velocity.z());
  CHECK(held == Approx(followed).epsilon(0.02));
  CHECK(300 - end.velocities.angular_velocity.z() == Approx(300 - state[1]).epsilon(0.02));
}

TEST_CASE("what is no impact is refused", "[bounce]") {
  const reduction::Law law = *reduction::find_law("exact");
  const Experiment ball = coming("pool", 0, {{1, 0}, {0, 0, 0}});
  for (const Impact& none : {Impact{0, 0.5}, Impact{-1, 0.5}, Impact{NAN, 0.5}, Impact{1, -0.1}, Impact{1, 1.1}})
    CHECK_THROWS_AS(bounce(ball, law, none), std::domain_error);
  CHECK(drop_speed(0.5, 9.80665) == Approx(std::sqrt(9.80665)).epsilon(1e-15));
}
