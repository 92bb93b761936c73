#include "fit/rolling_orbit.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"
#include "films.hpp"

using namespace contensou;
using Eigen::ArrayXd;

namespace {

struct Off {
  double slip = 0, spin = 0, centre = 0, way = 0;
};

/// How far an orbit is from another route, over its whole motion and beyond, relative to the speeds and lengths of its own.
Off off(const si::Experiment& ball, const reduction::Law& law, double rolling, bool in_steps) {
  const si::Motion motion = in_steps ? si::Motion::in_steps(ball, law) : si::Motion::reduced(ball, law);
  const double rate = ball.contact.friction * ball.environment.gravity;
  const double v0 = si::slip_at_start(ball), u0 = ball.ball.radius * si::spin_at_start(ball);
  fit::RollingOrbit orbit(law, si::patch_ratio(ball, law), {.u = u0, .v = v0}, rolling,
                          ball.contact.rolling_friction / ball.contact.friction, ball.ball.body.inertia);
  orbit.reach(std::numeric_limits<double>::infinity());
  const double last = motion.last_time(), size = v0 + rolling + std::abs(u0);
  CHECK(orbit.stop().T == Approx(rate * motion.stop_time()).epsilon(1e-8).margin(in_steps ? 1e-6 : 1e-9));
  ArrayXd t(80);
  t << ArrayXd::LinSpaced(40, 0, 0.3 * last), ArrayXd::LinSpaced(40, 0.31 * last, 1.2 * last);
  Off worst;
  std::size_t cell = 0;
  for (double at : t) {
    const si::MotionPoint is = motion.at(at);
    const fit::Speeds now = orbit.speeds_at(rate * at, cell);
    const auto keep = [](double& most, double error) { most = std::max(most, std::abs(error)); };
    keep(worst.slip, (now.v - is.slip) / size);
    keep(worst.spin, (now.u / ball.ball.radius - is.angular_velocity.z()) * ball.ball.radius / size);
    keep(worst.centre, (now.centre - is.velocity.norm()) / size);
    keep(worst.way, (now.way / rate - is.position.norm()) / (size * last));
  }
  return worst;
}

si::Experiment ball_of(double slip, double spin, double rolling, double u_r, double mu) {
  si::Experiment ball = pool_ball();
  ball.contact.patch = si::PatchRadius{mu * ball.ball.radius};
  ball.contact.rolling_friction = u_r;
  ball.start = si::Velocities{{slip + rolling, 0}, {0, rolling / ball.ball.radius, spin}};
  return ball;
}

}  // namespace

TEST_CASE("a ball with rolling friction in a fit moves as it does by the closed orbits", "[route]") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform;
  const auto logarithmic = [&](double low, double high) { return low * std::pow(high / low, uniform(random)); };
  for (int i = 0; i < (CONTENSOU_FULL_TESTS ? 2000 : 60); ++i) {
    const reduction::Law law = reduction::paper_laws()[static_cast<std::size_t>(i % 2)];
    const double mu = logarithmic(0.01, 0.4), rolling = i % 3 == 0 ? 0 : logarithmic(1e-3, 2);
    const double slip = i % 7 == 6 ? 0 : logarithmic(1e-3, 3), spin = i % 11 == 10 ? 0 : logarithmic(0.1, 300);
    const double u_r = 0.2 * logarithmic(1e-4, 0.5);
    INFO(law.name() << ", slip " << slip << ", spin " << spin << ", rolling " << rolling << ", u_r " << u_r << ", mu "
                    << mu);
    const Off worst = off(ball_of(slip, spin, rolling, u_r, mu), law, rolling, false);
    CHECK(worst.slip < 1e-8);
    CHECK(worst.spin < 1e-8);
    CHECK(worst.centre < 1e-8);
    CHECK(worst.way < 1e-8);
  }
}

TEST_CASE("a ball with rolling friction in a fit moves as its five equations say, in steps", "[route]") {
  const reduction::Law law = reduction::HertzLaw{};
  for (const auto& [slip, spin, rolling] : std::vector<std::tuple<double, double, double>>{
           {1, 100, 0}, {0.02, 60, 0}, {0.5, 20, 0.4}, {0.003, 200, 0.05}}) {
    INFO("slip " << slip << ", spin " << spin << ", rolling " << rolling);
    const Off worst = off(ball_of(slip, spin, rolling, 0.01, 0.0989), law, rolling, true);
    CHECK(worst.slip < 2e-7);
    CHECK(worst.spin < 2e-7);
    CHECK(worst.centre < 2e-7);
    CHECK(worst.way < 2e-7);
  }
}
