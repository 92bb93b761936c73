#include "contensou/portraits/reduction_figure.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "figures.hpp"

using namespace contensou;
using namespace contensou::portraits;
using Eigen::Vector2d;
using std::numbers::ln2, std::numbers::pi;

namespace {

/// Returns the lines of an orbit and of its copies, the smallest first. The fourth line is the orbit of the start.
std::vector<const Lines*> by_size(const Panel& panel) {
  std::vector<const Lines*> all;
  const auto first = &layer(panel, "its copies");
  const auto last = &layer(panel, "orbit of the start");
  for (const Lines* lines = first; lines <= last; ++lines) all.push_back(lines);
  REQUIRE(all.size() == 7);
  std::rotate(all.begin() + 3, all.end() - 1, all.end());
  return all;
}

/// Checks that each line of the strip is the one before, shifted by ln 2, and has the colour of its line in the plane.
void check_shifts(const Figure& figure) {
  REQUIRE(figure.panels.size() >= 2);
  const auto in_plane = by_size(figure.panels[0]), in_strip = by_size(figure.panels[1]);
  for (std::size_t i = 0; i < 7; ++i) {
    CHECK(in_plane[i]->stroke.colour.rgb == in_strip[i]->stroke.colour.rgb);
    CHECK((in_strip[i]->stroke.width > 2) == (i == 3));
    REQUIRE(in_strip[i]->lines.size() == in_strip[3]->lines.size());
    for (std::size_t j = 0; j < in_strip[i]->lines.size(); ++j) {
      const Polyline &line = in_strip[i]->lines[j], &own = in_strip[3]->lines[j];
      REQUIRE(line.size() == own.size());
      for (std::size_t n = 0; n < line.size(); ++n) {
        CHECK(line[n].x == own[n].x);
        CHECK(std::abs(line[n].y - own[n].y - (static_cast<double>(i) - 3) * ln2) < 1e-9);
      }
    }
  }
}

/// Returns the figure of a linear system. The scaling is given, so no decomposition has to find it.
Figure figure_of(const Eigen::Matrix2d& matrix, const Vector2d& start) {
  const reduction::PlanarField field = [matrix](const Vector2d& x) { return Vector2d(matrix * x); };
  const reduction::Generator scaling{0, Eigen::Matrix2d::Identity(), Vector2d::Zero()};
  return reduction_figure(reduction::PlanarReduction(field, scaling, start), start, {"linear"});
}

Figure figure_of(const reduction::Flow& flow, const reduction::State& start) {
  return reduction_figure(reduction::reduced(flow), {start.u, start.v}, {"(2.6)"});
}

Eigen::Matrix2d matrix(double a, double b, double c, double d) { return (Eigen::Matrix2d() << a, b, c, d).finished(); }

}  // namespace

TEST_CASE("a copy in plane and strip is the motion from the start so many times as large", "[route]") {
  for (const char* law : {"exact", "pade", "uniform"}) {
    for (const reduction::State start : {reduction::State{1, 1}, {-0.2, 3}, {5, 0.01}}) {
      const double mu = law == std::string("uniform") ? 1 : 0.3;
      const reduction::Inertia body = mu == 1 ? reduction::Inertia{.chi = 1, .gamma = 2} : reduction::Inertia{};
      const reduction::Flow flow({*reduction::find_law(law), mu, body});
      const Figure figure = figure_of(flow, start);
      INFO(law << " from " << start.u << ", " << start.v);
      check_shifts(figure);
      const auto in_plane = by_size(figure.panels[0]), in_strip = by_size(figure.panels[1]);
      int seen = 0;
      for (std::size_t i = 0; i < 7; ++i) {
        const double factor = std::exp2(static_cast<double>(i) - 3);
        const reduction::Orbit orbit = flow.orbit({factor * start.u, factor * start.v});
        const Polyline &plane = in_plane[i]->lines[0], &strip = in_strip[i]->lines[0];
        REQUIRE(plane.size() == strip.size());
        for (std::size_t n = 401; n < plane.size(); n += 2) {  // point 400 is the start
          const auto at = orbit.at_log_ratio(strip[n].x);
          if (at.v < 1e-200 || std::abs(at.k / std::exp(strip.back().x) - 1) < 1e-3) continue;
          CHECK(strip[n].y == Approx(at.ln_v).epsilon(0).margin(1e-9));
          CHECK(plane[n].x == Approx(at.u).epsilon(1e-9));
          CHECK(plane[n].y == Approx(at.v).epsilon(1e-9));
          ++seen;
        }
        CHECK(plane[400].x == Approx(factor * start.u).epsilon(1e-12));
        CHECK(plane[400].y == Approx(factor * start.v).epsilon(1e-12));
        CHECK(plane.front().y > plane.back().y);
      }
      CHECK(seen > 50);
    }
  }
}

TEST_CASE("copies over their starts are one line, other starts are not", "[route]") {
  for (const reduction::State start : {reduction::State{1, 1}, {-0.2, 0.3}}) {
    const reduction::Flow flow(reduction::HertzLaw{}, 1);
    const Figure figure = figure_of(flow, start);
    REQUIRE(figure.panels.size() == 3);
    const Panel& panel = figure.panels[2];
    const double integral = flow.log_first_integral(start.u, std::log(start.v));
    const auto here = [&](Point at) { return flow.log_first_integral(at.x * start.u, std::log(at.y * start.v)); };
    int beads = 0;
    REQUIRE(panel.marks.size() == 7);
    for (std::size_t i = 0; i < 6; ++i) {
      CHECK(panel.marks[i].points.size() >= 3);
      for (const Point& bead : panel.marks[i].points) {
        CHECK(here(bead) == Approx(integral).epsilon(0).margin(1e-9));
        ++beads;
      }
    }
    CHECK(beads > 30);
    for (const Polyline& line : layer(panel, "other starts").lines) {
      int through_start = 0;
      double farthest = 0;
      for (const Point& at : line) {
        if (at.x < 0.1 || at.y < 0.1 || at.x > 2 || at.y > 2) continue;
        through_start += std::hypot(at.x - 1, at.y - 1) < 1e-12;
        farthest = std::max(farthest, std::abs(here(at) - integral));
      }
      CHECK(through_start == 1);
      CHECK(farthest > 0.1);
    }
  }
}

TEST_CASE("an orbit comes to the stop for any mu and any start", "[limit]") {
  for (const double mu : {1.0, 0.01, 1e-4}) {
    for (const reduction::State start : {reduction::State{1, 1e-20}, {1, 1}, {1e-20, 1}}) {
      const Figure figure = figure_of(reduction::Flow(reduction::HertzLaw{}, mu), start);
      const Polyline& line = by_size(figure.panels[0])[3]->lines[0];
      INFO("mu = " << mu << " from " << start.u << ", " << start.v);
      CHECK(line.size() < 4400);
      CHECK(line.back().x < 1e-5 * start.u);
      CHECK(line.back().y < 1e-5 * start.v);
    }
  }
}

TEST_CASE("a node, a saddle, a focus and a centre are reduced as is known of them", "[exact]") {
  // First integrals: u/v^2 of the node, u v of the saddle, r exp(a angle) of the focus, r of the centre.
  const auto check = [](const Figure& figure, auto integral, bool inwards) {
    check_shifts(figure);
    const auto lines = by_size(figure.panels[0]);
    for (const Lines* copy : lines) {
      const Polyline& line = copy->lines.front();
      for (std::size_t n = 0; n < line.size(); n += 7) {
        CHECK(integral(line[n]) == Approx(integral(line[line.size() / 2])).epsilon(1e-9));
      }
      if (inwards) CHECK(std::hypot(line.front().x, line.front().y) > std::hypot(line.back().x, line.back().y));
    }
  };
  const auto node = figure_of(matrix(-2, 0, 0, -1), {1, 1});
  check(
      node, [](Point x) { return x.x / (x.y * x.y); }, true);
  CHECK(layer(node.panels[0], "orbits of other sectors").lines.size() == 3);
  CHECK(layer(node.panels[1], "rays").lines.size() == 5);  // the ray at -pi appears again at pi
  check(
      figure_of(matrix(1, 0, 0, -1), {-2, 0.5}), [](Point x) { return x.x * x.y; }, false);
  const double a = 0.1;
  const auto angle = [](Point x) { return std::atan2(x.y, x.x) + (x.y < 0 ? 2 * pi : 0); };
  check(
      figure_of(matrix(-a, -1, 1, -a), {-1, -1}),
      [&](Point x) { return std::hypot(x.x, x.y) * std::exp(a * angle(x)); }, true);
  check(
      figure_of(matrix(0, -1, 1, 0), {1, -1}), [](Point x) { return std::hypot(x.x, x.y); }, false);
}

TEST_CASE("a scaling with two weights moves along curves", "[exact]") {
  // For u' = v, v' = -sign(u), |u| + v^2/2 is constant. The generator is X/2, X = t d/dt + 2 u d/du + v d/dv.
  const reduction::PlanarField field = [](const Vector2d& x) {
    return Vector2d(x[1], x[0] > 0 ? -1 : x[0] < 0 ? 1 : 0);
  };
  const reduction::Generator scaling{0.5, matrix(1, 0, 0, 0.5), Vector2d::Zero()};
  const Vector2d start(1, 2);
  const Figure figure = reduction_figure(reduction::PlanarReduction(field, scaling, start), start, {"weights"});
  check_shifts(figure);
  const auto in_plane = by_size(figure.panels[0]);
  for (std::size_t i = 0; i < 7; ++i) {
    for (const Point& x : in_plane[i]->lines[0]) {
      CHECK(std::abs(x.x) + x.y * x.y / 2 == Approx(3 * std::exp2(static_cast<double>(i) - 3)).epsilon(1e-9));
    }
  }
}

TEST_CASE("shifts and turns move orbits along p", "[exact]") {
  // y' = c + a^2 + (y - c x)^2 has the orbits x = atan(q/a)/a + C, q = y - c x, and the shift (1, c).
  for (const auto& [c, a] : {std::pair(0.0, 1.0), std::pair(0.7, 0.6), std::pair(-2.0, 1.3)}) {
    const auto field = [c = c, a = a](const Vector2d& x) {
      const double q = x[1] - c * x[0];
      return Vector2d(1, c + a * a + q * q);
    };
    const Vector2d start(0.4, 0.3 + 0.4 * c);
    const reduction::Generator shift{0, matrix(0, 0, 0, 0), Vector2d(1, c)};
    const ReducedOrbits from = reduced_orbits(reduction::by_steps(field), start, shift);
    CHECK(from.rays.empty());
    REQUIRE(from.orbit.size() == 1);
    REQUIRE(from.orbit[0].size() > 50);
    const double constant = 0.4 - std::atan(0.3 / a) / a;
    for (const Point& at : from.orbit[0]) CHECK(at.y == Approx(constant + std::atan(at.x / a) / a).margin(1e-3));
    const Point copy = from.in_plane({from.start.x, from.start.y + 2});
    CHECK(copy.x == Approx(2.4));
    CHECK(copy.y == Approx(start[1] + 2 * c));
  }
  // r' = r (1 - r^2), angle' = 1 has the orbits angle = ln(r/sqrt|1 - r^2|) + C, and the invariant circle r = 1.
  const auto field = [](const Vector2d& x) {
    const double free = 1 - x.squaredNorm();
    return Vector2d(free * x[0] - x[1], free * x[1] + x[0]);
  };
  const reduction::Generator turn{0, matrix(0, -1, 1, 0), Vector2d::Zero()};
  const ReducedOrbits from = reduced_orbits(reduction::by_steps(field), {0.5, 0}, turn);
  REQUIRE(from.rays.size() == 1);
  CHECK(from.rays[0] == Approx(1));
  const auto level = [](double r) { return std::log(r / std::sqrt(std::abs(1 - r * r))); };
  for (const Polyline& line : from.orbit) {
    for (const Point& at : line) {
      if (at.x < 0.1 || at.x > 0.99) continue;
      CHECK(std::abs(std::remainder(at.y - level(at.x) + level(0.5), 2 * pi)) < 2e-3);
    }
  }
  CHECK_FALSE(from.elsewhere.empty());
  CHECK_THROWS_AS(reduced_orbits(reduction::by_steps(field), {0, 1}, turn), std::domain_error);
}

TEST_CASE("scalings with two rates move orbits along p", "[exact]") {
  // y' = m (y-c)/(x-a) + ((y-c)^2/(x-a)^m - b^2 (x-a)^m)/(x-a) has dq/dp = q^2 - b^2 with q = (y-c)/(x-a)^m, thus the
  // orbits p = ln|(q - b)/(q + b)|/(2 b) + C and the invariant curves q = b, -b.
  for (const auto& [m, side] : {std::pair(1, 1), std::pair(-2, -1), std::pair(3, -1)}) {
    const double a = 0.3, c = -0.7, b = 0.8, q0 = 0.45;
    const auto field = [=, m = m](const Vector2d& x) {
      const double raised = std::pow(x[0] - a, m), y = x[1] - c;
      return Vector2d(1, (m * y + y * y / raised - b * b * raised) / (x[0] - a));
    };
    const Vector2d start(a + 1.5 * side, c + q0 * std::pow(1.5 * side, m));
    const reduction::Generator scaling{0, matrix(1, 0, 0, m), Vector2d(-a, -m * c)};
    INFO("m = " << m);
    const ReducedOrbits from = reduced_orbits(reduction::by_steps(field), start, scaling);
    REQUIRE(from.rays.size() == 2);
    CHECK(from.rays[0] == Approx(-b));
    CHECK(from.rays[1] == Approx(b));
    CHECK(from.elsewhere.size() == 2);
    const auto level = [&](double q) { return std::log(std::abs((q - b) / (q + b))) / (2 * b); };
    REQUIRE(from.orbit.size() == 1);
    REQUIRE(from.orbit[0].size() > 50);
    for (const Point& at : from.orbit[0]) {
      if (std::abs(at.x) < 0.99 * b) CHECK(at.y == Approx(std::log(1.5) + level(at.x) - level(q0)).margin(2e-3));
    }
    const Point copy = from.in_plane({from.start.x, from.start.y + 1});
    CHECK(copy.x == Approx(a + side * 1.5 * std::exp(1)));
    CHECK(copy.y == Approx(c + q0 * std::pow(side * 1.5 * std::exp(1), m)));
  }
}

TEST_CASE("what the symmetry moves along itself has no strip", "[limit]") {
  const reduction::Flow flow(reduction::HertzLaw{}, 0.3);
  for (const reduction::State start : {reduction::State{0, 1}, {1, 0}, {0, 0}}) {
    CHECK_THROWS_AS(figure_of(flow, start), std::domain_error);
  }
  const reduction::Flow puck({*reduction::find_law("uniform"), 1, {.chi = 1, .gamma = 2}});
  CHECK_THROWS_AS(figure_of(puck, reduction::State{1, puck.terminal().rays[0].k}), std::domain_error);
  CHECK_THROWS_AS(figure_of(matrix(-1, 0, 0, -1), {1, 1}), std::domain_error);  // a star
  CHECK_THROWS_AS(figure_of(matrix(-1, 0, 0, -2), {0, 1}), std::domain_error);
}
