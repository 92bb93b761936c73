// Motions that slide, stick and rest at jumps of typed fields, against closed forms.
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "answers/asked/planar_system.hpp"
#include "contensou/portraits/planar_portrait.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "run_program.hpp"

using namespace contensou;
using Catch::Matchers::Contains;
using Eigen::Vector2d;
using reduction::PlanarEnd;
using reduction::PlanarOrbit;
using std::numbers::pi;

namespace {

using Generator = std::mt19937_64;
double rounded(Generator& random, double from, double to) {
  return std::stod(fmt::format("{:.3f}", from + (to - from) * static_cast<double>(random() >> 11) * 0x1p-53));
}

reduction::SmoothField typed_field(const std::string& text) { return answers::parse_planar_system(text, {}); }

/// The orbit by the solver that `reduce` chooses, and by steps.
struct Orbits {
  Orbits(const std::string& text, const Vector2d& start)
      : solved(reduction::reduce(typed_field(text), start).orbit(start)),
        stepped(reduction::by_steps(typed_field(text)).orbit(start)) {}

  void check(double time, const Vector2d& x, double tolerance = 1e-11) const {
    INFO("t = " << time);
    CHECK((solved.at(time) - x).norm() <= tolerance * (1 + x.norm()));
    CHECK((stepped.at(time) - x).norm() <= 10 * tolerance * (1 + x.norm()));
  }

  PlanarOrbit solved, stepped;
};

/// Closed form of x'' = -w^2 x - c sign(x'): half turns about +-c/w^2.
struct DryOscillator {
  double w, c;

  /// Moves the state on until a time, or until rest. Returns the time that has passed.
  double go(double& x, double& v, double until) const {
    double passed = 0;
    const double reach = c / (w * w);
    while (!(v == 0 && std::abs(x) <= reach)) {
      const double side = v != 0 ? std::copysign(1, v) : -std::copysign(1, x), centre = -side * reach;
      const double amplitude = std::hypot(x - centre, v / w), phase = std::atan2(-v / w, x - centre);
      const double left = ((side < 0 ? pi : 2 * pi) - (phase < 0 ? phase + 2 * pi : phase)) / w;
      if (passed + left > until) {
        const double angle = phase + w * (until - passed);
        x = centre + amplitude * std::cos(angle);
        v = -amplitude * w * std::sin(angle);
        return until;
      }
      passed += left;
      x = centre + side * amplitude;
      v = 0;
    }
    return passed;
  }
};

}  // namespace

TEST_CASE("dry-friction oscillators drawn at random stop where and when their closed form says", "[sliding]") {
  Generator random(60);
  for (int i = 0; i < (CONTENSOU_FULL_TESTS ? 300 : 30); ++i) {
    const DryOscillator oscillator{rounded(random, 0.4, 3), rounded(random, 0.05, 1)};
    const Vector2d start(rounded(random, -3, 3), rounded(random, -3, 3));
    const std::string text = fmt::format("x'' = -({})*x - {}*sign(x')", oscillator.w * oscillator.w, oscillator.c);
    CAPTURE(text, start.transpose());
    double x = start[0], v = start[1];
    const double stop = oscillator.go(x, v, 1e9);
    const Orbits orbits(text, start);
    for (const PlanarOrbit* orbit : {&orbits.solved, &orbits.stepped}) {
      CHECK(orbit->end() == PlanarEnd::rest);
      CHECK(orbit->end_time() == Approx(stop).epsilon(1e-11));
      CHECK((orbit->at(2 * stop) - Vector2d(x, 0)).norm() < 1e-10);
    }
    for (const double part : {0.1, 0.4, 0.9}) {
      x = start[0], v = start[1];
      oscillator.go(x, v, part * stop);
      orbits.check(part * stop, {x, v});
    }
  }
}

TEST_CASE("motions of y' = a - b sign(y - c x - d) slide along the line, or cross it", "[sliding]") {
  Generator random(61);
  int slides = 0, crosses = 0;
  for (int i = 0; i < (CONTENSOU_FULL_TESTS ? 300 : 40); ++i) {
    const double a = rounded(random, -1, 1), b = rounded(random, 0.2, 2), c = rounded(random, -1, 1),
                 d = rounded(random, -1, 1);
    const Vector2d start(rounded(random, -1, 1), rounded(random, -2, 2));
    const double h = start[1] - c * start[0] - d, side = h > 0 ? 1 : -1, rate = a - b * side - c;
    if (std::abs(h) < 0.01 || std::abs(std::abs(a - c) - b) < 0.05) continue;
    const std::string text = fmt::format("y' = {} - {}*sign(y - ({})*x - ({}))", a, b, c, d);
    CAPTURE(text, start.transpose());
    const Orbits orbits(text, start);
    const double meets = rate * side < 0 ? -h / rate : 1e9;
    const bool stays = std::abs(a - c) < b;
    slides += stays;
    crosses += !stays && meets < 1e9;
    for (const double time : {0.5 * std::min(meets, 2.0), std::min(meets, 2.0) + 0.7}) {
      const double before = std::min(time, meets), after = time - before, x = start[0] + time;
      const double at_line = start[1] + before * (a - b * side);
      orbits.check(time, {x, after == 0 ? at_line : stays ? c * x + d : at_line + after * (a + b * side)});
    }
  }
  CHECK(slides > 5);
  CHECK(crosses > 5);
}

TEST_CASE("a sliding velocity is the convex combination along the line", "[sliding]") {
  Generator random(62);
  for (int i = 0; i < (CONTENSOU_FULL_TESTS ? 300 : 40); ++i) {
    const double angle = rounded(random, -3, 3);
    const Vector2d normal(std::cos(angle), std::sin(angle)), along(-normal[1], normal[0]);
    const double of_first = -rounded(random, 0.1, 2), of_second = rounded(random, 0.1, 2);
    const double shift_first = rounded(random, -2, 2), shift_second = rounded(random, -2, 2);
    const Vector2d f = of_first * normal + shift_first * along, g = of_second * normal + shift_second * along;
    // f where h > 0 and g where h < 0, h = normal . x - 0.3
    const std::string h = fmt::format("sign(({:.17g})*u + ({:.17g})*v - 0.3)", normal[0], normal[1]);
    const std::string text = fmt::format("u' = {:.17g} + ({:.17g})*{}; v' = {:.17g} + ({:.17g})*{}", (f + g)[0] / 2,
                                         (f - g)[0] / 2, h, (f + g)[1] / 2, (f - g)[1] / 2, h);
    const Vector2d start = (0.3 + rounded(random, 0.2, 2)) * normal + rounded(random, -1, 1) * along;
    CAPTURE(text, start.transpose());
    const double meets = (normal.dot(start) - 0.3) / -of_first;
    const Vector2d there = start + meets * f;
    const double speed = (of_second * shift_first - of_first * shift_second) / (of_second - of_first);
    const Orbits orbits(text, start);
    orbits.check(meets / 2, start + meets / 2 * f);
    orbits.check(meets + 1.3, there + 1.3 * speed * along);
  }
}

TEST_CASE("a block on a belt sticks and slips", "[sliding]") {
  // Friction that falls with the slip: leaves the belt at x = 0.4, sticks again at x = -0.335058894593.
  constexpr double slips = 5.266719402578, period = 6.736837191765, sticks = -0.335058894593;
  const std::string falling = "x'' = -x - (0.4 - 0.2*abs(x'-0.5))*sign(x'-0.5)";
  const Orbits cycle(falling, {0, 0.5});
  const PlanarOrbit joins = reduction::by_steps(typed_field(falling)).orbit({0.1, 0.2});
  for (int turn = 0; turn < 4; ++turn) {
    const double begin = 0.8 + turn * period;
    cycle.check(begin, {0.4, 0.5}, 2e-12);
    cycle.check(begin + slips, {sticks, 0.5}, 2e-12);
    cycle.check(begin + slips + 0.5, {sticks + 0.25, 0.5}, 2e-12);
  }
  CHECK(joins.at(40)[1] <= 0.5 + 1e-12);
  CHECK((joins.at(40) - joins.at(40 + period)).norm() < 1e-10);

  // Constant friction: leaves at (0.2, 0.5) and goes round a circle about (0.2, 0), which touches the belt.
  const Orbits circle("x'' = -x - 0.2*sign(x'-0.5)", {-0.1, 0.5});
  for (const double time : {1.5, 4.0, 20.0}) {
    circle.check(0.6 + time, {0.2 + 0.5 * std::sin(time), 0.5 * std::cos(time)});
  }
  CHECK(circle.solved.end() == PlanarEnd::cycle);
}

TEST_CASE("a curve that is an orbit of one side is followed: the time-optimal double integrator", "[sliding]") {
  const std::string text = "x'' = -sign(x + x'*abs(x')/2)";
  for (const auto& [start, stop] : {std::pair(Vector2d(1, 0), 2.), {Vector2d(1, 1), 1 + std::sqrt(6)}}) {
    const Orbits orbits(text, start);
    for (const PlanarOrbit* orbit : {&orbits.solved, &orbits.stepped}) {
      CHECK(orbit->end_time() == Approx(stop).epsilon(1e-11));
      CHECK(orbit->at(2 * stop).norm() < 1e-11);
    }
    const double left = 0.25;
    orbits.check(stop - left, {left * left / 2, -left});
  }
}

TEST_CASE("where several motions leave a jump none is chosen", "[sliding]") {
  CHECK_THAT(reduction::reduce(typed_field("y' = sign(y)"), {0.3, 0}).orbit({0.3, 0}).undecided(),
             Contains("both sides point away"));
  const PlanarOrbit stepped = reduction::by_steps(typed_field("y' = sign(y) + x*y")).orbit({0.3, 0});
  CHECK(stepped.end() == PlanarEnd::undecided);
  CHECK_THROWS_WITH(stepped.at(1), Contains("the motion is not unique"));
  // At the crossing of two lines one motion leaves into each of two opposite sectors.
  const PlanarOrbit crossing = reduction::by_steps(typed_field("u' = sign(u) + 0.1*v; v' = -sign(v)")).orbit({0, 0.5});
  CHECK_THROWS_WITH(crossing.at(1), Contains("not unique"));
  const PlanarOrbit saddle = reduction::by_steps(typed_field("u' = sign(u*v); v' = 1 + u")).orbit({0, -0.5});
  CHECK_THROWS_WITH(saddle.at(1), Contains("the motion is not unique"));
}

TEST_CASE("sliding along a curve ends at a pseudo-equilibrium, and past motions of a slide are not unique",
          "[sliding]") {
  // Along v = 0, u' = -u: f = (-u, -+1).
  const Orbits orbits("u' = -u; v' = -sign(v)", {1, 0.5});
  orbits.check(0.25, {std::exp(-0.25), 0.25});
  orbits.check(3, {std::exp(-3), 0});
  CHECK(orbits.solved.end() == PlanarEnd::equilibrium);
  CHECK_THROWS_WITH(reduction::by_steps(typed_field("u' = -u; v' = -sign(v)")).reversed().orbit({1, 0}).at(1),
                    Contains("the motion is not unique"));
}

TEST_CASE("parts of switching curves end where motions begin to cross", "[sliding]") {
  using Kind = reduction::SwitchingMotion::Kind;
  const auto parts = [](const std::string& text) {
    return portraits::switching_parts(typed_field(text), Vector2d(-2, -2), Vector2d(2, 2));
  };
  const auto rest = parts("x'' = -x - 0.2*sign(x')");
  REQUIRE(rest.size() == 1);
  CHECK(rest[0].motion == Kind::rests);
  CHECK((rest[0].points.front() - Vector2d(-0.2, 0)).norm() < 1e-8);
  CHECK((rest[0].points.back() - Vector2d(0.2, 0)).norm() < 1e-8);
  const auto belt = parts("x'' = -x - (0.4 - 0.2*abs(x'-0.5))*sign(x'-0.5)");
  REQUIRE(belt.size() == 1);
  CHECK(belt[0].motion == Kind::slides);
  CHECK((belt[0].points.front() - Vector2d(-0.4, 0.5)).norm() < 1e-8);
  CHECK((belt[0].points.back() - Vector2d(0.4, 0.5)).norm() < 1e-8);
  // Two senses of sliding meet at a point at rest.
  for (const double centre : {-1.37, -0.21, 0., 0.0113, 0.8}) {
    const auto slides = parts(fmt::format("x' = -(x - {}); y' = -y - sign(y)", centre));
    REQUIRE(slides.size() == 2);
    for (const auto& part : slides) CHECK((part.points.back() - Vector2d(centre, 0)).norm() < 1e-8);
  }
  const auto away = parts("y' = sign(y)");
  REQUIRE(away.size() == 1);
  CHECK(away[0].motion == Kind::leaves);
  CHECK(parts("x'' = -x - abs(x')").empty());
  CHECK(parts("x'' = -x").empty());
}

TEST_CASE("the program says when dry friction stops a motion", "[sliding][cli]") {
  const std::vector<std::string> oscillator{"--system", "x'' = -x - 0.2*sign(x')", "--x0", "2", "--y0", "0"};
  const auto run = [&](std::vector<std::string> words, const std::vector<std::string>& more = {}) {
    words.insert(words.end(), oscillator.begin(), oscillator.end());
    words.insert(words.end(), more.begin(), more.end());
    return run_program(words);
  };
  const Run text = run({"reduce"});
  CHECK(text.status == 0);
  CHECK_THAT(text.out, Contains("at t = 15.708") && Contains("it comes to rest"));
  CHECK_THAT(text.out, Contains("rest         from x = -0.2, x' = 0 to x = 0.2, x' = 0"));
  const auto json = nlohmann::json::parse(run({"reduce"}, {"--format", "json"}).out);
  CHECK(json.at("end") == "rest");
  CHECK(json.at("end_time").get<double>() == Approx(5 * pi).epsilon(1e-12));
  CHECK(json.at("switching").at(0).at("motion") == "rests");
  const auto states = nlohmann::json::parse(run({"orbit"}, {"--samples", "6", "--format", "json"}).out);
  const std::vector<double> amplitudes{2, -1.6, 1.2, -0.8, 0.4, 0};
  for (std::size_t i = 0; i < amplitudes.size(); ++i) {
    CHECK(states.at("x").at(i).get<double>() == Approx(amplitudes[i]).margin(1e-11));
    CHECK(states.at("by").at(i) == "quadrature");
  }
  const Run check = run({"check"});
  CHECK(check.status == 0);
  CHECK_THAT(check.out, Contains("time of rest: quadrature against steps"));
}
