#include "contensou/si/contact_cone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <boost/math/tools/minima.hpp>
#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"
#include "contensou/si/motion.hpp"

using namespace contensou;
using namespace contensou::si;

namespace {

Experiment gel(double slip, double spin) {
  Experiment experiment = find_ball("gel")->experiment;
  experiment.start = SlipAndSpin{slip, spin};
  return experiment;
}

/// Computes the times from the cone and the principle of greatest dissipation alone. A search finds the point of the
/// cone's border with the greatest power. Its force and moment act for 10 microseconds; then the search is repeated.
FadeTimes by_search(const Experiment& experiment, Cone cone, double moment_arm) {
  struct Point {
    double force, moment;  // divided by f N and by c N
  };
  const auto border = [cone](double t) -> Point {  // t from 0 to 1 covers a quarter of the border
    const double x = (1 - t * t) / (1 + t * t);
    const double y = 2 * t / (1 + t * t);
    const double size = cone == Cone::elliptic ? 1 : cone == Cone::box ? std::max(x, y) : x + y;
    return {x / size, y / size};
  };
  const double f = experiment.contact.friction;
  const double R = experiment.ball.radius;
  const double g = experiment.environment.gravity;
  const double v0 = slip_at_start(experiment);
  const double w0 = std::abs(spin_at_start(experiment));
  constexpr double step = 1e-5;
  double v = v0;
  double w = w0;
  FadeTimes times{0, 0, 0, 0};
  for (long i = 1; v > faded * v0 || w > faded * w0; ++i) {
    const auto loss = [&](double t) { return -border(t).force * f * v - border(t).moment * moment_arm * w; };
    const Point acts = border(boost::math::tools::brent_find_minima(loss, 0.0, 1.0, 26).first);
    v = std::max(0.0, v - 3.5 * f * g * acts.force * step);
    w = std::max(0.0, w - 2.5 * moment_arm * g / (R * R) * acts.moment * step);
    if (v > faded * v0) times.slip = static_cast<double>(i) * step;
    if (w > faded * w0) times.spin = static_cast<double>(i) * step;
    times.slip_length += v * step;
    times.turns += w * step / (2 * std::numbers::pi);
  }
  return times;
}

}  // namespace

TEST_CASE("under a cone acts what dissipates most", "[route]") {
  constexpr double arm = 2.1e-3;
  struct Start {
    double slip, spin;
  };
  for (const Cone cone : {Cone::elliptic, Cone::box, Cone::pyramid}) {
    // Starts: slip above (c/f) omega; slip below it; slip so small that it is frozen; hardly any spin.
    for (const auto& [slip, spin] : {Start{0.5, 30}, Start{0.05, -30}, Start{1e-4, 20}, Start{0.3, 0.05}}) {
      const Experiment experiment = gel(slip, spin);
      const FadeTimes found = by_search(experiment, cone, arm);
      const FadeTimes times = fade_times(experiment, cone, arm);
      INFO(name(cone) << ", slip " << slip << ", spin " << spin);
      CHECK(times.slip == Approx(found.slip).epsilon(2e-3).margin(2e-5));
      CHECK(times.spin == Approx(found.spin).epsilon(2e-3).margin(2e-5));
      CHECK(times.slip_length == Approx(found.slip_length).epsilon(2e-3).margin(1e-6));
      CHECK(times.turns == Approx(found.turns).epsilon(2e-3).margin(1e-5));
    }
  }
}

namespace {

/// Integrates a disc of radius a in steps, like an engine. The disc stands on four contact points at the distance `arm`
/// from its middle. Each point carries a quarter of the load.
/// @param twist  true: bounded force against the slip, bounded moment against the spin; false: friction at each point
FadeTimes in_steps(const Experiment& puck, double arm, bool twist) {
  const double f = puck.contact.friction, a = puck.ball.radius, g = puck.environment.gravity;
  constexpr double dt = 1e-4;
  const double v0 = slip_at_start(puck), w0 = spin_at_start(puck);
  Eigen::Vector2d v(v0, 0);
  double w = w0, turned = 0;
  FadeTimes times{0, 0, 0, 0};
  for (long i = 1; v.norm() > faded * v0 || w > faded * w0; ++i) {
    Eigen::Vector2d force = Eigen::Vector2d::Zero();  // force divided by the mass
    double moment = 0;                                // moment divided by the moment of inertia
    for (int k = 0; k < 4; ++k) {
      const double angle = turned + k * std::numbers::pi / 2;
      const Eigen::Vector2d r = arm * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      const Eigen::Vector2d at_point = v + w * Eigen::Vector2d(-r.y(), r.x());
      const Eigen::Vector2d friction = -f * g / 4 * (twist ? v : at_point).stableNormalized();
      force += friction;
      moment += (twist ? -f * g / 4 * arm : r.x() * friction.y() - r.y() * friction.x()) / (a * a / 2);
    }
    v = v.norm() > force.norm() * dt ? Eigen::Vector2d(v + force * dt) : Eigen::Vector2d::Zero();
    w = std::max(0.0, w + moment * dt);
    turned += w * dt;
    if (v.norm() > faded * v0) times.slip = static_cast<double>(i) * dt;
    if (w > faded * w0) times.spin = static_cast<double>(i) * dt;
    times.slip_length += v.norm() * dt;
  }
  times.turns = turned / (2 * std::numbers::pi);
  return times;
}

}  // namespace

TEST_CASE("a puck on four contact points, in steps", "[route]") {
  Experiment puck = find_ball("puck")->experiment;
  puck.contact.friction = 0.1;
  puck.start = SlipAndSpin{5, 100};
  for (const double arm : {2 * puck.ball.radius / 3, puck.ball.radius}) {
    for (const bool twist : {true, false}) {
      const FadeTimes found = in_steps(puck, arm, twist);
      const FadeTimes times = fade_times(puck, twist ? Cone::box : Cone::points, puck.contact.friction * arm);
      INFO("arm " << arm << (twist ? ", a row of twist" : ", friction at each point"));
      CHECK(times.slip == Approx(found.slip).epsilon(2e-3));
      CHECK(times.spin == Approx(found.spin).epsilon(2e-3));
      CHECK(times.slip_length == Approx(found.slip_length).epsilon(2e-3));
      CHECK(times.turns == Approx(found.turns).epsilon(2e-3));
    }
  }
  CHECK(in_steps(puck, puck.ball.radius, true).turns == Approx(15.46).epsilon(1e-3));
  CHECK(in_steps(puck, 2 * puck.ball.radius / 3, true).turns == Approx(23.19).epsilon(1e-3));
}

TEST_CASE("the elliptic cone is a friction law", "[route]") {
  const Experiment experiment = gel(0.5, 30);
  const double patch = patch_radius_of(experiment, reduction::HertzLaw{});
  const double arm = experiment.contact.friction * patch * reduction::EllipticLaw::hertz_moment;
  const FadeTimes law = fade_times(experiment, reduction::EllipticLaw{});
  const FadeTimes cone = fade_times(experiment, Cone::elliptic, arm);
  CHECK(cone.slip == Approx(law.slip).epsilon(1e-12));
  CHECK(cone.spin == Approx(law.spin).epsilon(1e-12));
}

TEST_CASE("times of a law are those of its motion", "[route]") {
  const Experiment experiment = gel(0.5, -30);
  const FadeTimes times = fade_times(experiment, reduction::HertzLaw{});
  const Motion motion = Motion::reduced(experiment, reduction::HertzLaw{});
  CHECK(motion.at(times.slip).slip == Approx(0.5e-3).epsilon(1e-9));
  CHECK(motion.at(times.spin).angular_velocity.z() == Approx(-30e-3).epsilon(1e-9));
  CHECK(motion.spin_time(31) == 0);
  CHECK(motion.spin_time(0) == Approx(motion.stop_time()).epsilon(1e-12));
  CHECK_THROWS_AS(motion.spin_time(-1), std::domain_error);
}

TEST_CASE("without slip, without spin, without a moment", "[limit]") {
  constexpr double never = std::numeric_limits<double>::infinity();
  for (const Cone cone : {Cone::elliptic, Cone::box, Cone::pyramid}) {
    INFO(name(cone));
    const double sliding = fade_times(gel(0.5, 0), cone, 2e-3).slip;
    CHECK(sliding == Approx(0.999 * 2 * 0.5 / (7 * 0.5 * 9.80665)).epsilon(1e-12));
    CHECK(fade_times(gel(0.5, 0), cone, 2e-3).spin == 0);
    const double spinning = fade_times(gel(0, 30), cone, 2e-3).spin;
    CHECK(spinning == Approx(0.999 * 2 * 0.03 * 0.03 * 30 / (5 * 2e-3 * 9.80665)).epsilon(1e-12));
    CHECK(fade_times(gel(0, 30), cone, 2e-3).slip == 0);
    CHECK(fade_times(gel(0.5, 30), cone, 0).slip == Approx(sliding).epsilon(1e-12));
    CHECK(fade_times(gel(0.5, 30), cone, 0).spin == never);
    CHECK(fade_times(gel(0.5, 0), cone, 0).spin == 0);
    CHECK_THROWS_AS(fade_times(gel(0.5, 30), cone, -1e-3), std::domain_error);
    CHECK_THROWS_AS(fade_times(gel(0.5, 30), cone, never), std::domain_error);
  }
}

TEST_CASE("slip and spin under a pyramid fade when fade_times says", "[analytic]") {
  const double arm = 2e-3;
  for (const auto& [slip, spin] : {SlipAndSpin{1, 100}, {0.01, -100}, {1, 0}, {0, -3}, {0.4, 100}}) {
    const Experiment experiment = gel(slip, spin);
    const FadeTimes fades = fade_times(experiment, Cone::pyramid, arm);
    CAPTURE(slip, spin);
    CHECK(speeds_under_pyramid(experiment, arm, fades.slip).slip == Approx(faded * slip).epsilon(1e-10));
    CHECK(speeds_under_pyramid(experiment, arm, fades.spin).spin == Approx(faded * spin).epsilon(1e-10));
    CHECK(speeds_under_pyramid(experiment, arm, 0).slip == slip);
    CHECK(speeds_under_pyramid(experiment, arm, 0).spin == Approx(spin).epsilon(1e-15));
    const SlipAndSpin later = speeds_under_pyramid(experiment, arm, 9);
    CHECK((later.slip == 0 && later.spin == 0));
  }
  // The spin is frozen while f v > arm omega. Later slip and spin fall together, with f v = arm omega.
  const Experiment fast = gel(1, 100);
  CHECK(speeds_under_pyramid(fast, arm, 0.02).spin == Approx(100).epsilon(1e-15));
  const SlipAndSpin together = speeds_under_pyramid(fast, arm, 0.2);
  CHECK(together.slip == Approx(arm / fast.contact.friction * together.spin).epsilon(1e-12));
}
