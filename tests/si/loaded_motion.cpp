#include "contensou/si/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <random>
#include <stdexcept>
#include <tuple>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"

using namespace contensou;
using namespace contensou::si;
using Catch::Matchers::Contains;

namespace {

/// Returns a built-in body under a nominal load of 2 N.
Experiment pressed(const char* name, SlipAndSpin start) {
  Experiment experiment = find_ball(name)->experiment;
  if (!experiment.ball.body.lies_flat()) experiment.contact.patch = PatchRadius{7e-3};
  experiment.environment = {.gravity = 2 / experiment.ball.mass, .load = 2};
  experiment.start = start;
  return experiment;
}

/// A load from 2 N to 4 N in a second, then 1 N, then 0 for a tenth of a second, then 3 N.
const LoadHistory varied{{0, 1, 1, 1.2, 1.2, 1.3, 1.3}, {2, 4, 1, 1, 0, 0, 3}};

}  // namespace

TEST_CASE("the clock of a load is its impulse", "[table]") {
  CHECK(varied.nominal() == 2);
  for (const auto& [t, clock] :
       {std::pair{0.0, 0.0}, {0.5, 0.625}, {1, 1.5}, {1.1, 1.55}, {1.2, 1.6}, {1.3, 1.6}, {2.3, 3.1}}) {
    CAPTURE(t);
    CHECK(varied.clock(t) == Approx(clock).epsilon(1e-15));
    CHECK(varied.time_of(clock) == Approx(t == 1.3 ? 1.2 : t).epsilon(1e-15));
  }
  CHECK(std::isinf(LoadHistory({0, 1}, {1, 0}).time_of(0.6)));
  CHECK(LoadHistory({0, 1}, {1, 0}).time_of(0.5) == Approx(1).epsilon(1e-7));
  CHECK(LoadHistory({0, 1, 2}, {0, 0, 1}).nominal() == 1);
  for (const auto& [t, load] :
       std::vector<std::pair<std::vector<double>, std::vector<double>>>{{{0}, {1}},
                                                                        {{0, 1}, {1}},
                                                                        {{1, 2}, {1, 1}},
                                                                        {{0, 1, 0.5}, {1, 1, 1}},
                                                                        {{0, 1}, {1, -1}},
                                                                        {{0, 1}, {0, 0}},
                                                                        {{0, NAN}, {1, 1}},
                                                                        {{0, 1}, {1, INFINITY}}})
    CHECK_THROWS_AS(LoadHistory(t, load), std::domain_error);
}

TEST_CASE("a puck without spin under a growing load, in closed form", "[table]") {
  const Experiment puck = pressed("puck", {.slip = 1, .spin = 0});
  const Motion motion = Motion::reduced(puck, *reduction::find_law("uniform"), LoadHistory({0, 1}, {2, 4}));
  const double a = 0.1 / 0.163;  // f/m with m = 0.163 kg
  for (double t : {0.1, 0.4}) {
    const MotionPoint at = motion.at(t);
    CHECK(at.slip == Approx(1 - a * (2 * t + t * t)).epsilon(1e-14));
    CHECK(at.position.x() == Approx(t - a * (t * t + t * t * t / 3)).epsilon(1e-13));
    CHECK(motion.path_length(t) == Approx(at.position.x()).epsilon(1e-10));
  }
  const double stop = std::sqrt(1 + 1 / a) - 1;  // 2 t + t^2 = 1/a
  CHECK(motion.stop_time() == Approx(stop).epsilon(1e-14));
  CHECK(motion.slip_length() == Approx(stop - a * (stop * stop + stop * stop * stop / 3)).epsilon(1e-12));
  CHECK(motion.slip_time(0.5) == Approx(std::sqrt(1 + 0.5 / a) - 1).epsilon(1e-14));
  CHECK(motion.at(3).position.x() == Approx(motion.slip_length()).epsilon(1e-12));
  CHECK_THROWS_WITH(Motion::reduced(puck, *reduction::find_law("uniform"), LoadHistory({0, 0.1}, {2, 0})),
                    Contains("the load ends at 0 before the motion does"));
}

TEST_CASE("a constant load is that load, and a load as large again one of half the time", "[symmetry]") {
  const reduction::Law law = *reduction::find_law("exact");
  const Experiment ball = pressed("gel", {.slip = 1, .spin = 60});
  const Motion nominal = Motion::reduced(ball, law);
  const Motion same = Motion::reduced(ball, law, LoadHistory({0, 1}, {2, 2}));
  Experiment heavier = ball;
  heavier.environment = {.gravity = 4 / ball.ball.mass, .load = 4};
  const Motion twice = Motion::reduced(heavier, law);
  // A load of 2 N that lasts for no time at all.
  const Motion doubled = Motion::reduced(ball, law, LoadHistory({0, 0, 1}, {2, 4, 4}));
  for (double share : {0.01, 0.1, 0.6, 1.2}) {
    for (const auto& [one, other] :
         {std::pair{same.at(share * nominal.stop_time()), nominal.at(share * nominal.stop_time())},
          {doubled.at(share * twice.stop_time()), twice.at(share * twice.stop_time())}}) {
      CHECK(one.position.x() == Approx(other.position.x()).epsilon(1e-11));
      CHECK(one.velocity.x() == Approx(other.velocity.x()).epsilon(1e-11));
      CHECK(one.angular_velocity.z() == Approx(other.angular_velocity.z()).epsilon(1e-11).margin(1e-11));
    }
  }
  CHECK(doubled.spin_angle() == Approx(twice.spin_angle()).epsilon(1e-10));
  CHECK(doubled.path_length(0.1) == Approx(twice.path_length(0.1)).epsilon(1e-9));
  CHECK(Motion::uncoupled(ball, law, 0, LoadHistory({0, 0, 1}, {2, 4, 4})).spin_end() ==
        Approx(Motion::uncoupled(heavier, law).spin_end()).epsilon(1e-14));
  CHECK(Motion::reduced(ball, law, std::nullopt).at(0.3).position == nominal.at(0.3).position);
}

TEST_CASE("a load that comes and goes, against the equations of motion in steps", "[route]") {
  for (const auto& [name, law_name] : {std::pair{"gel", "exact"}, {"puck", "uniform"}}) {
    CAPTURE(name);
    const reduction::Law law = *reduction::find_law(law_name);
    const Experiment body = pressed(name, {.slip = 2, .spin = 400});
    const Motion motion = Motion::reduced(body, law, varied);
    const double eps = patch_radius_of(body, law), R = body.ball.radius,
                 f_over_m = body.contact.friction / body.ball.mass;
    const double chi = body.ball.body.inertia.chi, gamma = body.ball.body.inertia.gamma;
    // The state is v, omega, slip length and angle. Runge and Kutta's method integrates each part of the load.
    using State = std::array<double, 4>;
    const auto rate = [&](const State& s, double load) {
      const auto [force, moment] = law(reduction::Slip{std::max(0.0, s[0]), eps * s[1]});
      return State{-chi * f_over_m * load * force, -gamma * f_over_m * load * eps * moment / (R * R), s[0], s[1]};
    };
    const auto moved = [](const State& s, const State& by, double h) {
      State result = s;
      for (std::size_t i = 0; i < 4; ++i) result[i] += h * by[i];
      return result;
    };
    State state{2, 400, 0, 0};
    double t = 0;
    for (const auto& [end, first, last] :
         {std::array{0.05, 2.0, 2.1}, {0.1, 2.1, 2.2}, {1.0, 2.2, 4.0}, {1.2, 1.0, 1.0}, {1.3, 0.0, 0.0}}) {
      constexpr int steps = 4000;
      const double h = (end - t) / steps, slope = (last - first) / (end - t);
      for (int i = 0; i < steps; ++i) {
        const double load = first + slope * i * h;
        const State a = rate(state, load), b = rate(moved(state, a, h / 2), load + slope * h / 2),
                    c = rate(moved(state, b, h / 2), load + slope * h / 2),
                    d = rate(moved(state, c, h), load + slope * h);
        for (std::size_t j = 0; j < 4; ++j) state[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
      }
      t = end;
      CAPTURE(t);
      const MotionPoint at = motion.at(t);
      CHECK(at.slip == Approx(state[0]).epsilon(1e-7).margin(1e-9));
      CHECK(at.angular_velocity.z() == Approx(state[1]).epsilon(1e-9));
      CHECK(at.position.x() == Approx(2 * t - (2 * t - state[2]) / chi).epsilon(1e-8));
    }
  }
}

TEST_CASE("from its stop on a body under a load that changes stands still", "[edge]") {
  const Experiment puck = pressed("puck", {.slip = 3, .spin = 40});
  const reduction::Law law = *reduction::find_law("uniform");
  const LoadHistory lifted({0, 1, 3}, {1.6, 0.8, 1.6});
  const Motion motion = Motion::reduced(puck, law, lifted);
  for (double t : {motion.stop_time(), motion.stop_time() + 0.9874, 8.0, 80.0}) {
    CAPTURE(t);
    const MotionPoint at = motion.at(t);
    CHECK(at.velocity == Eigen::Vector2d(0, 0));
    CHECK(at.angular_velocity == Eigen::Vector3d(0, 0, 0));
    CHECK(at.position.x() == Approx(motion.slip_length()).epsilon(1e-12));
  }
}

TEST_CASE("a log of the load that is longer than the slide costs no more than the slide", "[cost]") {
  // A load cell writes a row in each millisecond. The slide ends at some place in the log, or after it.
  const reduction::Law law = *reduction::find_law("uniform");
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> noise(-0.05, 0.05);
  for (const bool noisy : {false, true}) {
    std::vector<double> t, load;
    for (int i = 0; i < 3000; ++i) {
      t.push_back(i * 1e-3);
      load.push_back(2 + (noisy ? noise(random) : 0.01 * std::sin(i / 20.0)));
    }
    const auto moved = [&](std::size_t rows) {
      const auto count = static_cast<std::ptrdiff_t>(rows);
      const std::clock_t begin = std::clock();
      const Motion motion =
          Motion::reduced(pressed("puck", {.slip = 2, .spin = 30}), law,
                          LoadHistory({t.begin(), t.begin() + count}, {load.begin(), load.begin() + count}));
      return std::tuple{motion.stop_time(), motion.slip_length(), motion.spin_angle(), std::clock() - begin};
    };
    const auto [stop, length, angle, cost] = moved(3000);
    REQUIRE(stop > 1.3);
    REQUIRE(stop < 2.9);
    // Below, the log ends before the slide, and its last load lasts.
    const auto cost_of_part = std::get<3>(moved(1201));
    CHECK(static_cast<double>(cost) < 4 * static_cast<double>(cost_of_part));
    // Rows after the stop change nothing.
    const auto last = static_cast<std::size_t>(stop * 1000) + 2;
    const auto [same_stop, same_length, same_angle, unused] = moved(last);
    CHECK(same_stop == stop);
    CHECK(same_length == length);
    CHECK(same_angle == angle);
  }
}
