#include "fit/film_orbit.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"
#include "films.hpp"

using namespace contensou;
using Eigen::ArrayXd;

TEST_CASE("an orbit in cells is that of the ball to 1e-9, from start to rest", "[route]") {
  for (const reduction::Law& law : CONTENSOU_FULL_TESTS ? reduction::named_laws() : reduction::paper_laws()) {
    for (double mu : {1e-3, 0.1, 0.8}) {
      for (const auto& [slip, spin] :
           std::vector<std::pair<double, double>>{{1, 100}, {1, 0.01}, {1e-3, 100}, {0, 100}, {1, 0}}) {
        si::Experiment ball = pool_ball();
        ball.contact.patch = si::PatchRadius{mu * ball.ball.radius};
        ball.start = si::SlipAndSpin{.slip = slip, .spin = spin};
        const si::Motion motion = si::Motion::reduced(ball, law);
        const double rate = 0.2 * ball.environment.gravity, stop = motion.stop_time();
        ArrayXd t(122);  // times of the slide, of the whole motion, and after its end
        t << ArrayXd::LinSpaced(61, 0, 0.999 * std::min(stop, 2 * slip / (7 * rate) + 1e-9)),
            ArrayXd::LinSpaced(61, stop, 1.5 * stop);
        INFO(law.name() << ", mu = " << mu << ", slip " << slip << ", spin " << spin);
        const reduction::State start = si::reduced_start(ball);
        fit::FilmOrbit orbit(law, ball.ball.body.inertia, fit::Kind::ball, {std::log(mu), start.v, start.u});
        orbit.reach(std::numeric_limits<double>::infinity());
        CHECK(orbit.stop() == Approx(rate * stop).epsilon(1e-9));
        const double scale = std::max(slip, ball.ball.radius * spin);
        double worst_slip = 0, worst_spin = 0, worst_length = 0;
        for (Eigen::Index i = 0; i < t.size(); ++i) {
          const si::MotionPoint at = motion.at(t[i]);
          const fit::Speeds now = orbit.speeds_at(rate * t[i]);
          worst_slip = std::max(worst_slip, std::abs(now.v - at.slip));
          worst_spin = std::max(worst_spin, std::abs(now.u / ball.ball.radius - at.angular_velocity.z()));
          const double slid = slip * t[i] - 3.5 * (slip * t[i] - at.position.x());
          worst_length = std::max(worst_length, std::abs(now.slid / rate - slid));
        }
        CHECK(worst_slip <= 1e-9 * (slip > 0 ? slip : scale));
        CHECK(worst_spin <= 1e-9 * (spin > 0 ? spin : scale / ball.ball.radius));
        CHECK(worst_length < 1e-9 * scale * stop);
        CHECK(orbit.speeds_at(rate * t[t.size() - 1]).turned / rate / ball.ball.radius ==
              Approx(motion.spin_angle()).epsilon(1e-8));
      }
    }
  }
}

TEST_CASE(
    "an orbit of a body that lies flat is the library's to 1e-9, above, below and on its ray and next to the axes",
    "[route]") {
  constexpr double tau_per_T = 1.5 * std::numbers::pi;
  for (const char* name : {"exact", "uniform", "ring", "annulus:0.5"}) {
    const reduction::Law law = *reduction::find_law(name);
    for (const double mu : {0.3, 0.7, 0.95, 1.0}) {
      for (const double gamma : {2.0, 2.5}) {
        const reduction::Flow flow(reduction::ReducedSystem(law, mu, {.chi = 1, .gamma = gamma}));
        std::vector<double> ratios{1e-15, 1e-6, 0.03, 0.6, 2, 40, 1e5, 1e15};
        for (const reduction::InvariantRay& ray : flow.terminal().rays) ratios.push_back(ray.k);
        for (const double k : ratios) {
          INFO(name << ", mu = " << mu << ", gamma = " << gamma << ", k = " << k);
          const double v0 = std::min(1.0, mu * k), u0 = v0 / (mu * k);
          fit::FilmOrbit orbit(law, {.chi = 1, .gamma = gamma}, fit::Kind::flat, {std::log(mu), v0, u0});
          const reduction::Orbit expected = flow.orbit({.u = u0, .v = v0});
          const double stop = expected.stop_time() / tau_per_T;
          orbit.reach(std::numeric_limits<double>::infinity());
          CHECK(orbit.stop() == Approx(stop).epsilon(1e-9));
          double worst = 0;
          for (int i = 0; i < 40; ++i) {
            const reduction::Orbit::Instant is = expected.instant(stop * i / 40 * tau_per_T);
            const fit::Speeds now = orbit.speeds_at(stop * i / 40);
            for (const double off : {(now.v - is.v) / v0, (now.u - is.u) / u0, (now.centre - is.v) / v0,
                                     (now.slid - is.slip_length / tau_per_T) / (v0 * stop),
                                     (now.way - is.slip_length / tau_per_T) / (v0 * stop),
                                     (now.turned - is.turned / tau_per_T) / (u0 * stop)})
              worst = std::max(worst, std::abs(off));
          }
          // If a ray is close to an axis, D (src/fit/orbit_cells.hpp) has lost all digits beside the ray and the axis.
          const auto merges = [&](double r) { return std::abs(flow.system().r() / r - 1) < 1e-9; };
          CHECK(worst < (merges(flow.terminal().low) || merges(flow.terminal().high) ? 1e-6 : 1e-9));
        }
      }
    }
  }
}

namespace {

struct Off {
  double slip = 0, spin = 0, centre = 0, way = 0;
};

/// Returns the largest differences of an orbit from another route, over its whole motion and beyond, divided by the
/// speeds and lengths of the orbit.
Off off(const si::Experiment& ball, const reduction::Law& law, double rolling, bool in_steps) {
  const si::Motion motion = in_steps ? si::Motion::in_steps(ball, law) : si::Motion::reduced(ball, law);
  const double rate = ball.contact.friction * ball.environment.gravity;
  const double v0 = si::slip_at_start(ball), u0 = ball.ball.radius * si::spin_at_start(ball);
  fit::FilmOrbit orbit(
      law, ball.ball.body.inertia, fit::Kind::resisted,
      {std::log(si::patch_ratio(ball, law)), v0, u0, ball.contact.rolling_friction / ball.contact.friction, rolling});
  orbit.reach(std::numeric_limits<double>::infinity());
  const double last = motion.last_time(), size = v0 + rolling + std::abs(u0);
  CHECK(orbit.stop() == Approx(rate * motion.stop_time()).epsilon(1e-8).margin(in_steps ? 1e-6 : 1e-9));
  ArrayXd t(80);
  t << ArrayXd::LinSpaced(40, 0, 0.3 * last), ArrayXd::LinSpaced(40, 0.31 * last, 1.2 * last);
  Off worst;
  for (double at : t) {
    const si::MotionPoint is = motion.at(at);
    const fit::Speeds now = orbit.speeds_at(rate * at);
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
