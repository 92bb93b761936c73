#include "contensou/reduction/planar_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "reference_table.hpp"
#include "worst_case.hpp"

using namespace contensou::reduction;
using namespace contensou::tests;
using Catch::Matchers::Contains;
using Eigen::Matrix2d;
using Eigen::Vector2d;
using std::numbers::pi;

namespace {

PlanarReduction reduced(const SmoothField& field, const Vector2d& around = {1, 1}) {
  const PlanarSymmetries found = find_symmetries(field, around);
  REQUIRE(found.scaling);
  return {field, *found.scaling, around, found.residual};
}

PlanarField linear(const Matrix2d& m) {
  return [m](const Vector2d& x) -> Vector2d { return m * x; };
}

double wrapped(double angle) { return std::remainder(angle, 2 * pi); }

}  // namespace

TEST_CASE("Zhuravlev's system is an instance: stop times and orbits of every law, body and mu", "[planar][route]") {
  std::mt19937 random(27);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  WorstCase times("stop time"), points("point on the way");
  const std::vector<Inertia> bodies{homogeneous_ball, {2.5, 1.5}, {1, 2}, {1, 1}, {3, 40}};
  std::vector<Law> laws = named_laws();
  laws.push_back(*find_law("pressure:0.3"));
  laws.push_back(*find_law("elliptic:0.7"));
  constexpr int systems = CONTENSOU_FULL_TESTS ? 250 : 30;
  for (int i = 0; i < systems; ++i) {
    const Law& law = laws[static_cast<std::size_t>(i) % laws.size()];
    const Inertia body = bodies[static_cast<std::size_t>(i / 7) % bodies.size()];
    const double mu = std::pow(10, uniform(-4, 0.5));
    const ReducedSystem system(law, mu, body);
    const Flow flow(system);
    const double scale = std::pow(10, uniform(-3, 3));
    const PlanarReduction plane = reduced(planar_field(system), {scale, scale});
    for (int j = 0; j < 4; ++j) {
      const double k = std::pow(10, uniform(-4, 4)), u = scale * std::pow(10, uniform(-1, 1)) * (j % 2 == 0 ? 1 : -1);
      const State start{u, mu * std::abs(u) * k};
      const std::string where = fmt::format("{}, mu = {}, body {},{}, u = {}, v = {}", law.name(), mu, body.chi,
                                            body.gamma, start.u, start.v);
      const double tau = flow.stop_time(start).tau;
      CAPTURE(where, plane.kind());
      const PlanarOrbit orbit = plane.orbit({start.u, start.v});
      times.add(tau, orbit.end_time(), where);
      CHECK(orbit.end() == PlanarEnd::centre);
      const double at = uniform(0, 0.99) * tau;
      const auto wanted = flow.orbit(start).at_time(at);
      const Vector2d got = orbit.at(at);
      const double size = std::max(std::abs(wanted.u), wanted.v);
      points.add(wanted.u, got[0], size, where + fmt::format(", at {}", at / tau));
      points.add(wanted.v, got[1], size, where + fmt::format(", at {}", at / tau));
    }
  }
  CHECK(times.count() == 4 * systems);
  CHECK_WITHIN_EPS(times, 2000);
  CHECK_WITHIN_EPS(points, 4500);  // 4500 eps are 1e-12
}

TEST_CASE("system (2.6) solved by its flow agrees with the solution by the values of its field", "[planar][route]") {
  std::mt19937 random(26);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  WorstCase radial("R"), angular("dT/dq"), times("end time"), points("state"),
      integrals("difference of first integrals");
  const std::vector<Inertia> bodies{homogeneous_ball, {1, 2}, {1, 1}, {3, 40}};
  std::vector<Law> laws = named_laws();
  laws.push_back(*find_law("pressure:0.3"));
  laws.push_back(*find_law("elliptic:0.7"));
  int with_rays = 0;
  constexpr int systems = CONTENSOU_FULL_TESTS ? 120 : 20;
  for (int i = 0; i < systems; ++i) {
    const Law& law = laws[static_cast<std::size_t>(i) % laws.size()];
    const Inertia body = bodies[static_cast<std::size_t>(i / 5) % bodies.size()];
    const double mu = std::pow(10, uniform(-2, 0.4)), drive = i % 3 == 0 ? 0.9 * uniform(0.01, 1) : 0;
    const ReducedSystem system(law, mu, body, drive);
    const Vector2d around(1 / mu, 1);
    const PlanarReduction by_values = reduced(planar_field(system), around), by_flow = reduced(Flow(system));
    const std::string what =
        fmt::format("{}, mu = {}, body {},{}, drive {}", law.name(), mu, body.chi, body.gamma, drive);
    CAPTURE(what);
    REQUIRE(by_flow.flow() != nullptr);
    CHECK(by_values.flow() == nullptr);
    CHECK(by_flow.form() == "scaling");
    CHECK(by_flow.kind() == by_values.kind());
    CHECK(by_flow.centre() == by_values.centre());
    REQUIRE(by_flow.rays().size() == by_values.rays().size());
    with_rays += by_flow.rays().size() > 4;
    for (std::size_t j = 0; j < by_flow.rays().size(); ++j) {
      const PlanarRay &got = by_flow.rays()[j], &wanted = by_values.rays()[j];
      CAPTURE(wanted.q, wanted.order);
      CHECK(std::abs(wrapped(got.q - wanted.q)) < 1e-13);
      CHECK(got.attracts == wanted.attracts);
      CHECK(got.to_centre == wanted.to_centre);
      CHECK(std::isnan(wanted.k));
      CHECK(std::atan(mu * got.k) == Approx(std::abs(std::asin(std::sin(got.q)))).margin(1e-14));
      // In by_values the curve p = 0 is |x| = |around|. Rates by sigma depend on this scale.
      radial.add(wanted.radial * around.norm(), got.radial, what);
      if (std::isfinite(wanted.angular)) {
        angular.add(wanted.angular * around.norm(), got.angular, what);
        CHECK(got.order == wanted.order);
      }
    }
    REQUIRE(by_flow.sectors().size() == by_values.sectors().size());
    for (std::size_t j = 0; j < by_flow.sectors().size(); ++j) {
      // Both lists run counter-clockwise, but they may begin with different sectors.
      const PlanarSector& got = by_flow.sectors()[j];
      const auto same = std::ranges::find_if(by_values.sectors(), [&](const PlanarSector& other) {
        return std::abs(wrapped(got.from - other.from)) < 1e-13 &&
               std::abs(got.to - got.from - (other.to - other.from)) < 1e-13;
      });
      REQUIRE(same != by_values.sectors().end());
      const PlanarSector& wanted = *same;
      CHECK(std::pair(got.from_ray, got.to_ray) == std::pair(wanted.from_ray, wanted.to_ray));
      // Two orbits of a sector have a difference of first integrals. Both solutions must give the same difference.
      const double one = uniform(0.05, 0.95), other = uniform(0.05, 0.95);
      double differences[2]{};
      for (int n : {0, 1}) {
        const double q = wanted.from + (wanted.to - wanted.from) * (n == 0 ? one : other);
        const Vector2d x = std::exp(uniform(-2, 2)) * Vector2d(std::cos(q), std::sin(q));
        const PlanarCanonical here = by_flow.canonical(x), there = by_values.canonical(x);
        CHECK(std::abs(wrapped(here.q - there.q)) < 1e-15);
        CHECK(here.p == Approx(there.p + std::log(around.norm())).margin(1e-14));
        CHECK((by_flow.point(here.q, here.p) - x).norm() < 1e-14 * x.norm());
        CHECK(by_flow.factor(x) == by_values.factor(x));
        CHECK(by_flow.end(x) == by_values.end(x));
        times.add(by_values.end_time(x), by_flow.end_time(x), what);
        const double time = uniform(0, 0.99) * by_flow.end_time(x);
        const Vector2d wanted_state = by_values.orbit(x).at(time), state = by_flow.orbit(x).at(time);
        for (int k : {0, 1}) points.add(wanted_state[k], state[k], wanted_state.norm(), what);
        differences[n] = by_flow.first_integral(x) - by_values.first_integral(x);
        CHECK(by_flow.first_integral(2 * x) == Approx(by_flow.first_integral(x) + std::numbers::ln2).epsilon(1e-12));
        CHECK(by_flow.reversed().end(x) == by_values.reversed().end(x));
      }
      integrals.add(differences[0], differences[1], 1 + std::abs(differences[0]), what);
    }
    for (const PlanarReduction* plane : {&by_flow, &by_values}) {
      CHECK_THROWS_AS(plane->first_integral({0, 1}), std::domain_error);
      if (drive > 0) CHECK_THROWS_AS(plane->orbit({1, 0}), std::domain_error);  // two motions leave this point
      if (drive == 0) CHECK_THROWS_AS(plane->first_integral({1, 0}), std::domain_error);
    }
    CHECK(by_flow.end_time({0, -2}) == Approx(by_values.end_time({0, -2})).epsilon(1e-13));
    CHECK(by_flow.end_time({0, 0}) == 0);
    CHECK(by_flow.end_time_error(around) < 1e-13);
  }
  CHECK(with_rays > systems / 6);
  CHECK_WITHIN_EPS(radial, 100);
  CHECK_WITHIN_EPS(angular, 1e7);  // less accurate next to the kink of a law
  CHECK_WITHIN_EPS(times, 200);
  CHECK_WITHIN_EPS(points, 4500);
  CHECK_WITHIN_EPS(integrals, 500);
}

TEST_CASE("where a ray of (2.6) merges with an axis, its order is that of the solution by values", "[planar][limit]") {
  for (const char* law : {"pade", "exact", "uniform"}) {
    const TerminalRatios limits = terminal_ratios(*find_law(law), 1);
    for (double r : {limits.low, limits.high}) {
      const ReducedSystem system(*find_law(law), 1, {1, r});
      const PlanarReduction by_values = reduced(planar_field(system)), by_flow = reduced(Flow(system));
      CAPTURE(law, r);
      CHECK(by_flow.kind() == by_values.kind());
      REQUIRE(by_flow.rays().size() == by_values.rays().size());
      for (std::size_t j = 0; j < by_flow.rays().size(); ++j) {
        CHECK(by_flow.rays()[j].attracts == by_values.rays()[j].attracts);
        CHECK(by_flow.rays()[j].order == Approx(by_values.rays()[j].order));
      }
    }
  }
}

TEST_CASE("a focus whose centre is not smooth: its spiral and its stop are exact", "[planar][exact]") {
  // The field is r' = -1, angle' = b/r. The angle is -b ln(1 - t/r0), and r shrinks by exp(-2 pi/b) in a turn.
  for (double b : {1.0, -0.3, 20.0}) {
    const PlanarReduction plane =
        reduced([b](const Vector2d& x) -> Vector2d { return Vector2d(-x[0] - b * x[1], b * x[0] - x[1]) / x.norm(); });
    CAPTURE(b);
    CHECK(plane.kind() == "stable focus");
    CHECK(plane.rays().empty());
    REQUIRE(plane.turn());
    CHECK(plane.turn()->factor == Approx(std::exp(-2 * pi / std::abs(b))).epsilon(1e-13));
    const PlanarOrbit orbit = plane.orbit({0.3, -0.4});
    CHECK(orbit.end() == PlanarEnd::centre);
    CHECK(orbit.end_time() == Approx(0.5).epsilon(1e-13));
    for (double t : {0.0, 0.1, 0.35, 0.499}) {
      const Vector2d x = orbit.at(t);
      CHECK(x.norm() == Approx(0.5 - t).epsilon(1e-12));
      CHECK(wrapped(std::atan2(x[1], x[0]) - std::atan2(-0.4, 0.3) + b * std::log1p(-t / 0.5)) ==
            Approx(0).margin(1e-11));
    }
    CHECK(orbit.at(0.5) == Vector2d(0, 0));
    CHECK(orbit.at(7) == Vector2d(0, 0));
  }
}

TEST_CASE("linear fields: kind, rays and motion against the exponential of the matrix", "[planar][exact]") {
  struct Case {
    Matrix2d m;
    std::string_view kind;
    std::size_t rays;
    PlanarEnd end;
  };
  const std::vector<Case> cases{
      {Matrix2d{{-0.1, -1}, {1, -0.1}}, "stable focus", 0, PlanarEnd::centre},
      {Matrix2d{{0.4, -1}, {3, 0.1}}, "unstable focus", 0, PlanarEnd::infinity},
      {Matrix2d{{0, -2}, {1, 0}}, "center", 0, PlanarEnd::periodic},
      {Matrix2d{{-1, 0.5}, {0.25, -2}}, "stable node", 4, PlanarEnd::centre},
      {Matrix2d{{1, 0}, {0, 5}}, "unstable node", 4, PlanarEnd::infinity},
      {Matrix2d{{1, 2}, {2, -1}}, "saddle", 4, PlanarEnd::infinity},
      {Matrix2d{{-1, 0}, {0, 2}}, "saddle", 4, PlanarEnd::infinity},
      {Matrix2d{{-3, 0}, {0, -3}}, "stable star", 0, PlanarEnd::centre},
  };
  for (const auto& [m, kind, rays, end] : cases) {
    CAPTURE(m, kind);
    const PlanarReduction plane = reduced(linear(m));
    CHECK(plane.kind() == kind);
    CHECK(plane.rays().size() == rays);
    for (const Vector2d& start : {Vector2d(0.7, 0.2), Vector2d(-0.1, 1.5), Vector2d(-1, -1e-3)}) {
      const PlanarOrbit orbit = plane.orbit(start);
      CHECK(orbit.end() == end);
      CHECK(orbit.end_time() == infinity);  // a linear motion needs infinite time
      for (double t : {0.0, 0.5, 3.0, 12.0}) {
        // The exponential exp(t m) by its series for a small part of t, which is then squared repeatedly.
        Matrix2d exact = Matrix2d::Identity(), term = exact;
        for (int i = 1; i < 20; ++i) exact += term = (term * m * (t / 256 / i)).eval();
        for (int i = 0; i < 8; ++i) exact = (exact * exact).eval();
        CAPTURE(start, t);
        CHECK((orbit.at(t) - exact * start).norm() < 1e-11 * (exact * start).norm());
      }
    }
  }
}

TEST_CASE("the rays of a node are its eigenvectors, and R and dT/dq its eigenvalues and their difference",
          "[planar][exact]") {
  const PlanarReduction plane = reduced(linear(Matrix2d{{-1, 0}, {0, -3}}));
  REQUIRE(plane.rays().size() == 4);
  for (const PlanarRay& ray : plane.rays()) {
    const bool slow = std::abs(std::sin(ray.q)) < 1e-9;
    CHECK(std::abs(wrapped(2 * ray.q)) == Approx(slow ? 0 : pi).margin(1e-14));
    CHECK(ray.attracts == slow);
    CHECK(ray.to_centre);
    CHECK(ray.radial == Approx(slow ? -1 : -3).epsilon(1e-14));
    CHECK(ray.angular == Approx(slow ? -2 : 2).epsilon(1e-12));
  }
}

TEST_CASE("weights that differ", "[planar][exact]") {
  // Scaling of u' = -sign(u), v' = -3 sqrt|v| sign(v): u -> c u, v -> c^2 v, t -> c t. u and v end at different times.
  const PlanarReduction plane = reduced([](const Vector2d& x) {
    return Vector2d(-std::copysign(1, x[0]), -3 * std::copysign(std::sqrt(std::abs(x[1])), x[1]));
  });
  CHECK(plane.scaling()->matrix.isDiagonal(0));
  CHECK(plane.scaling()->matrix(0, 0) == Approx(plane.scaling()->time).epsilon(1e-13));
  CHECK(plane.scaling()->matrix(1, 1) == Approx(2 * plane.scaling()->time).epsilon(1e-13));
  const PlanarCanonical here = plane.canonical({0.3, 0.7});
  CHECK((plane.point(here.q, here.p) - Vector2d(0.3, 0.7)).norm() < 1e-14);
}

TEST_CASE("a constant force beside friction: creeping rays, and a start that never stops", "[planar][exact]") {
  // The drive is 0.2 or 1.5 times the friction along u = 0, which is 1. k tends to a ray, or v grows for ever.
  const double rate = ReducedSystem(PadeLaw{}, 0.5).scaled_time_rate();
  const auto driven = [&](double drive) {
    return reduced([=, friction = planar_field({PadeLaw{}, 0.5})](const Vector2d& x) -> Vector2d {
      return friction(x) + Vector2d(0, drive * rate);
    });
  };
  const PlanarReduction slow = driven(0.2), fast = driven(1.5);
  CHECK(slow.end({1, 1}) == PlanarEnd::centre);
  CHECK(slow.end_time({0, 1}) == Approx(1 / (0.8 * rate)).epsilon(1e-12));
  CHECK(fast.end({0, 1}) == PlanarEnd::infinity);
  CHECK(fast.end_time({1, 1}) == infinity);
}

TEST_CASE("a first integral is one number along an orbit, and moves with the scaling", "[planar][invariant]") {
  const PlanarReduction plane = reduced(planar_field({PadeLaw{}, 0.3}));
  const PlanarOrbit orbit = plane.orbit({1, 1});
  const double integral = plane.first_integral({1, 1});
  for (double part : {0.1, 0.5, 0.9}) {
    CHECK(plane.first_integral(orbit.at(part * orbit.end_time())) == Approx(integral).margin(1e-11));
  }
  CHECK(plane.first_integral({5, 5}) - integral == Approx(std::log(5)).epsilon(1e-12));
  CHECK_THROWS_AS(plane.first_integral({1, 0}), std::domain_error);
  CHECK_THROWS_AS(plane.first_integral({0, 0}), std::domain_error);
}

TEST_CASE("a start on a line of equilibria rests, and motions beside it tend to the line", "[planar][exact]") {
  std::mt19937_64 random(3);
  const auto among = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int i = 0; i < 20; ++i) {
    // x' = -rate (n . x) w vanishes where n . x = 0; n . x falls like exp(-rate (n . w) t).
    const double angle = among(0, 2 * pi), rate = among(0.2, 3);
    const Vector2d n(std::cos(angle), std::sin(angle)), along(-n[1], n[0]), w = n + among(-1, 1) * along;
    const PlanarField field = [=](const Vector2d& x) -> Vector2d { return -rate * n.dot(x) * w; };
    const Vector2d at_rest = among(0.3, 2) * along, start = at_rest + among(0.2, 2) * n;
    CAPTURE(angle, rate);
    const PlanarReduction plane = reduce(field, start);
    REQUIRE(plane.scaling());
    const PlanarOrbit rests = plane.orbit(at_rest), moves = plane.orbit(start);
    CHECK(rests.end() == PlanarEnd::rest);
    CHECK((rests.limit() - at_rest).norm() < 1e-12);
    CHECK((rests.at(3) - at_rest).norm() < 1e-12);
    CHECK((moves.limit() - (start - n.dot(start) * w)).norm() < 1e-9);
  }
}

TEST_CASE("a field with values in a part of the plane", "[planar][domain]") {
  // For v > u the field has u' = -1. Orbits leave this region through v = u, or end where the field has no value.
  const PlanarReduction plane =
      reduced([](const Vector2d& x) { return x[1] > 0 ? Vector2d(1, -1) : Vector2d(not_a_number, 0); });
  CHECK(plane.kind() == "bordered");
  CHECK(plane.end({0, 1}) == PlanarEnd::border);
  CHECK(plane.end_time({0, 1}) == Approx(1).epsilon(1e-12));
  const PlanarOrbit orbit = plane.orbit({0, 1});
  CHECK((orbit.at(0.75) - Vector2d(0.75, 0.25)).norm() < 1e-11);
  CHECK_THROWS_WITH(orbit.at(1.1), Contains("border"));
  CHECK_THROWS_AS(plane.end({0, -1}), std::domain_error);
  CHECK_THROWS_AS(plane.end({0, not_a_number}), std::domain_error);
  CHECK_THROWS_AS(orbit.at(-1), std::domain_error);
}

TEST_CASE("a matrix that is no scaling is refused", "[planar][domain]") {
  const PlanarField field = linear(Matrix2d{{1, 0}, {0, -1}});
  for (const Matrix2d& bad : {Matrix2d{{1, 0}, {0, -1}}, Matrix2d{{0, 1}, {-1, 0}}, Matrix2d{{0, 0}, {0, 0}}}) {
    CHECK_THROWS_AS(PlanarReduction(field, {0, bad, {0, 0}}, {1, 1}), std::domain_error);
  }
  CHECK_THROWS_AS(PlanarReduction(field, {0, Matrix2d::Identity(), {0, 0}}, {0, 0}), std::domain_error);
}

namespace {

/// The field r' = R(angle), angle' = T(angle)/r.
template <class Radial, class Angular>
PlanarField polar(const Radial& radial, const Angular& angular) {
  return [=](const Vector2d& x) -> Vector2d {
    const Vector2d n = x.normalized();
    const double angle = std::atan2(x[1], x[0]);
    return radial(angle) * n + angular(angle) * Vector2d(-n[1], n[0]);
  };
}

}  // namespace

TEST_CASE("rays that are close to one another are found", "[planar][exact]") {
  const auto node = [](double q, double distance) {
    return polar([](double angle) { return -1 - 0.8 * std::sin(angle); },
                 [=](double angle) { return std::pow(std::sin(angle - q), 2) - distance * distance; });
  };
  for (double q : {0.99, 1.0, 1.01, 1.02, -2.5}) {
    for (double distance : {0.004, 1e-4, 0.03}) {
      CAPTURE(q, distance);
      const PlanarReduction plane = reduced(node(q, distance));
      CHECK(plane.kind() == "stable node");
      REQUIRE(plane.rays().size() == 4);
      for (const PlanarRay& ray : plane.rays()) {
        const double from = std::abs(std::remainder(ray.q - q, pi));
        CHECK(from == Approx(std::asin(distance)).epsilon(1e-9).margin(2e-12));
        CHECK(ray.attracts == (std::remainder(ray.q - q, pi) < 0));
      }
      CHECK(plane.end({1, 0.2}) == PlanarEnd::centre);
      CHECK(plane.end_time({1, 0.2}) > 0.5);
    }
  }
  // The reference was computed by SciPy's DOP853 in ln r and the angle, to 1e-11.
  CHECK(reduced(node(1, 0.004)).end_time({1, 0.2}) == Approx(0.7710816980055679).epsilon(1e-8));
  CHECK(reduced(node(1, 0.03)).end_time({1, 0.2}) == Approx(0.7712289685393047).epsilon(1e-8));
  // T touches 0 at a direction that is no double. Up to rounding of T there is one double ray.
  const PlanarReduction touching = reduced(node(0.96, 0));
  CHECK(touching.kind() == "stable node");
  REQUIRE(touching.rays().size() == 2);
  for (const PlanarRay& ray : touching.rays()) {
    CHECK(std::abs(std::remainder(ray.q - 0.96, pi)) < 1e-11);
    CHECK(ray.order == 2);
    CHECK_FALSE(ray.attracts);
  }
}

TEST_CASE("nodes with a double ray", "[planar][exact]") {
  // If l is the double eigenvalue of m, exp(t m) = exp(l t) (1 + t (m - l)).
  struct Case {
    Matrix2d m;
    double eigenvalue;
    std::string_view kind;
    PlanarEnd end;
  };
  std::vector<Case> cases{{Matrix2d{{3, 1}, {-1, 1}}, 2, "unstable node", PlanarEnd::infinity},
                          {Matrix2d{{0, 1}, {0, 0}}, 0, "degenerate", PlanarEnd::infinity},
                          {Matrix2d{{-1, -1}, {1, 1}}, 0, "degenerate", PlanarEnd::infinity}};
  for (double w = 0.25; w < 3; w += 0.0625 * std::numbers::sqrt2) {  // u'' + 2 w u' + w^2 u = 0
    cases.push_back({Matrix2d{{0, 1}, {-w * w, -2 * w}}, -w, "stable node", PlanarEnd::centre});
  }
  for (const auto& [m, eigenvalue, kind, end] : cases) {
    CAPTURE(m);
    // A linear field has several scalings. The solution uses the given one.
    const PlanarReduction plane(linear(m), {0, Matrix2d::Identity(), Vector2d::Zero(), true}, {1, 0.5}, 1e-15);
    CHECK(plane.kind() == kind);
    CHECK(plane.rays().size() == 2);
    for (const Vector2d& start : {Vector2d(1, 0.3), Vector2d(-1, -2.2), Vector2d(0.2, 2)}) {
      const PlanarOrbit orbit = plane.orbit(start);
      CHECK(name(orbit.end()) == name(end));
      CHECK(orbit.end_time() == infinity);
      for (double t : {0.0, 0.4, 2.0, 20.0, 100.0}) {
        const Vector2d exact = std::exp(eigenvalue * t) * (start + t * (m * start - eigenvalue * start));
        CAPTURE(start, t);
        // Next to a double ray, p ~ 1/z ~ t, with z the angle from the ray. The angle of the ray has an error of 1e-12.
        CHECK((orbit.at(t) - exact).norm() < 1e-12 * (1 + t * t) * exact.norm());
      }
    }
  }
}

TEST_CASE("resonant nodes", "[planar][exact]") {
  // The field u' = -u, v' = -k v + c u^k has the motions v exp(k t) = v0 + c u0^k t.
  for (int k : {2, 3}) {
    for (double c : {-2.0, -0.3, 0.7, 2.0}) {
      CAPTURE(k, c);
      const PlanarReduction plane =
          reduced([=](const Vector2d& x) { return Vector2d(-x[0], -k * x[1] + c * std::pow(x[0], k)); }, {1, 0.3});
      CHECK(plane.kind() == "stable node");
      for (const Vector2d& start : {Vector2d(1, 0.3), Vector2d(0, 1), Vector2d(-1, 0.3)}) {
        CHECK(plane.end(start) == PlanarEnd::centre);
        for (double t : {0.3, 3.0, 30.0}) {
          const Vector2d exact(start[0] * std::exp(-t), std::exp(-k * t) * (start[1] + c * std::pow(start[0], k) * t));
          CAPTURE(start, t);
          CHECK((plane.orbit(start).at(t) - exact).norm() < 1e-10 * exact.norm());
        }
      }
    }
  }
}

TEST_CASE("an end that is no power of the angle is not decided", "[planar][domain]") {
  const PlanarField field = [](const Vector2d& x) { return Vector2d(-x[0], x[1] * std::log(std::abs(x[1] / x[0]))); };
  const PlanarReduction plane(field, {0, Matrix2d::Identity(), Vector2d::Zero(), true}, {1, 1}, 1e-15);
  CHECK(plane.kind().empty());
  CHECK_THAT(plane.undecided(), Contains("no power of the angle"));
}

TEST_CASE("planar systems with known answers", "[planar][exact][table]") {
  static constexpr auto sign = [](double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; };
  // The systems of the table that have a scaling, as functions of u and v.
  const std::map<std::string, Vector2d (*)(double, double)> fields{
      {"u' = u^2-v^2; v' = 2*u*v", [](double u, double v) { return Vector2d(u * u - v * v, 2 * u * v); }},
      {"u' = (u^2-v^2)/(u^2+v^2); v' = 2*u*v/(u^2+v^2)",
       [](double u, double v) { return Vector2d((u * u - v * v) / (u * u + v * v), 2 * u * v / (u * u + v * v)); }},
      {"u' = (3-u)/((u-3)^2+(v+1)^2)^0.25; v' = (-1-v)/((u-3)^2+(v+1)^2)^0.25",
       [](double u, double v) -> Vector2d { return Vector2d(3 - u, -1 - v) / std::sqrt(std::hypot(u - 3, v + 1)); }},
      {"u' = v; v' = -sign(u)-0.3*sign(v)", [](double u, double v) { return Vector2d(v, -sign(u) - 0.3 * sign(v)); }},
      {"u' = v; v' = -sign(u-1)-0.3*sign(v)",
       [](double u, double v) { return Vector2d(v, -sign(u - 1) - 0.3 * sign(v)); }},
      {"u' = v; v' = -sign(u)-0.5*sign(v)", [](double u, double v) { return Vector2d(v, -sign(u) - 0.5 * sign(v)); }},
      {"u' = u^2/(2*v); v' = u-v/2", [](double u, double v) { return Vector2d(u * u / (2 * v), u - v / 2); }},
      {"u' = 1; v' = 3*v/u-u", [](double u, double v) { return Vector2d(1, 3 * v / u - u); }},
      {"u' = 1; v' = -u/v", [](double u, double v) { return Vector2d(1, -u / v); }},
      {"u' = 1; v' = v/u+u", [](double u, double v) { return Vector2d(1, v / u + u); }},
      {"u' = 1; v' = 3*u+2*v^2/u^3", [](double u, double v) { return Vector2d(1, 3 * u + 2 * v * v / (u * u * u)); }},
      {"u' = -u^99; v' = -v^99", [](double u, double v) { return Vector2d(-std::pow(u, 99), -std::pow(v, 99)); }},
      {"u' = -u^3; v' = -v^3/2-u^2*v",
       [](double u, double v) { return Vector2d(-u * u * u, -v * v * v / 2 - u * u * v); }},
      {"u' = 1; v' = 2+sign(v)", [](double, double v) { return Vector2d(1, 2 + sign(v)); }},
      {"u' = (2+sign(u-2*v))*v; v' = -(2+sign(u-2*v))*u",
       [](double u, double v) -> Vector2d { return (2 + sign(u - 2 * v)) * Vector2d(v, -u); }},
      {"u' = -u; v' = sqrt(|u*v|)", [](double u, double v) { return Vector2d(-u, std::sqrt(std::abs(u * v))); }},
      {"u' = -u; v' = -sqrt(|u*v|)*sign(v)",
       [](double u, double v) { return Vector2d(-u, -std::sqrt(std::abs(u * v)) * sign(v)); }},
      {"u' = 0; v' = -v/sqrt(u^2+v^2)", [](double u, double v) { return Vector2d(0, -v / std::hypot(u, v)); }},
      {"u' = -0.8*(0.8*u+0.6*v)/sqrt(u^2+v^2); v' = -0.6*(0.8*u+0.6*v)/sqrt(u^2+v^2)",
       [](double u, double v) -> Vector2d { return -(0.8 * u + 0.6 * v) / std::hypot(u, v) * Vector2d(0.8, 0.6); }},
      {"u' = -1; v' = -1", [](double, double) { return Vector2d(-1, -1); }},
      {"u' = v; v' = u^2", [](double u, double v) { return Vector2d(v, u * u); }},
      {"u' = -u/sqrt(u^2+v^2); v' = -v/sqrt(u^2+v^2)",
       [](double u, double v) -> Vector2d { return -Vector2d(u, v) / std::hypot(u, v); }},
      {"u' = -u/sqrt(u^2+v^2); v' = -v/sqrt(u^2+v^2)-0.25",
       [](double u, double v) { return Vector2d(-u / std::hypot(u, v), -v / std::hypot(u, v) - 0.25); }},
      {"u' = -u/sqrt(u^2+v^2); v' = -v/sqrt(u^2+v^2)-1.5",
       [](double u, double v) { return Vector2d(-u / std::hypot(u, v), -v / std::hypot(u, v) - 1.5); }},
      {"u' = v; v' = -4*u", [](double u, double v) { return Vector2d(v, -4 * u); }},
      {"u' = v; v' = -u", [](double u, double v) { return Vector2d(v, -u); }},
      {"u' = v; v' = -u^3", [](double u, double v) { return Vector2d(v, -u * u * u); }},
      {"u' = v; v' = 0", [](double, double v) { return Vector2d(v, 0); }},
      {"u' = -u-v; v' = u+v", [](double u, double v) { return Vector2d(-u - v, u + v); }},
      {"u' = v; v' = -u-2*v", [](double u, double v) { return Vector2d(v, -u - 2 * v); }},
      {"u' = 3*u+v; v' = -u+v", [](double u, double v) { return Vector2d(3 * u + v, -u + v); }},
      {"u' = u; v' = 2*v+u^2", [](double u, double v) { return Vector2d(u, 2 * v + u * u); }},
      {"u' = -0.1*u-v; v' = u-0.1*v", [](double u, double v) { return Vector2d(-0.1 * u - v, u - 0.1 * v); }},
      {"u' = u^2; v' = v^2", [](double u, double v) { return Vector2d(u * u, v * v); }},
      {"u' = -u; v' = -3*v", [](double u, double v) { return Vector2d(-u, -3 * v); }},
      {"u' = 1; v' = u", [](double u, double) { return Vector2d(1, u); }}};
  for (const ReferenceRow& row : reference_table("planar_systems")) {
    if (row.text("form") != "scaling") continue;
    const Vector2d start(row.input("u0"), row.input("v0"));
    CAPTURE(row.text("system"), start);
    const auto field = fields.at(row.text("system"));  // a row without a function fails
    const PlanarReduction plane =
        reduced([field](const Vector2d& x) { return field(x[0], x[1]); }, start.isZero() ? Vector2d(1, 1) : start);
    CHECK(plane.kind() == (row.text("kind") == "?" ? "" : row.text("kind")));
    CHECK(plane.undecided().empty() == (row.text("kind") != "?"));
    CHECK(plane.rays().size() == std::stoul(row.text("rays")));
    const PlanarOrbit orbit = plane.orbit(start);
    CHECK(name(orbit.end()) == (row.text("end") == "?" ? "undecided" : row.text("end")));
    CHECK(orbit.period().has_value() == (row.text("end") == "periodic"));
    if (row.text("time") == "inf") {
      CHECK(orbit.end_time() == infinity);
    } else if (!row.text("time").empty()) {
      CHECK(orbit.period().value_or(orbit.end_time()) == Approx(row.input("time")).epsilon(1e-12));
      if (!orbit.period()) CHECK(plane.end_time_error(start) < 1e-12);
      if (row.text("end") == "border" || row.text("end") == "infinity") {
        CHECK_THROWS_WITH(orbit.at(1.1 * row.input("time")), Contains(row.text("end")));
      }
    }
    if (row.text("t").empty()) continue;
    const Vector2d state(row.input("u"), row.input("v"));
    CHECK((orbit.at(row.input("t")) - state).norm() < 1e-11 * state.norm());
  }
}

TEST_CASE("a field is too steep to decide", "[planar][domain]") {
  CHECK(
      find_symmetries([](const Vector2d& x) { return Vector2d(-std::pow(x[0], 1000), -std::pow(x[1], 1000)); }, {1, 2})
          .verdict == PlanarSymmetries::Verdict::undecided);
}

TEST_CASE("relays whose jumps lie on no axis", "[planar][exact]") {
  // The same relay in sheared coordinates must stop at the same time.
  const auto sign = [](double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; };
  std::mt19937 random(7);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  int sharp = 0;
  for (int i = 0; i < 40; ++i) {
    const double friction = uniform(0.1, 0.95);
    const PlanarField relay = [=](const Vector2d& x) { return Vector2d(x[1], -sign(x[0]) - friction * sign(x[1])); };
    Matrix2d map;
    map << uniform(0.5, 2), uniform(-1, 1), uniform(-0.9, 0.9), uniform(0.5, 2);
    if (std::abs(map.determinant()) < 0.2) continue;
    const Vector2d start(uniform(0.2, 1.5), uniform(-1, 1));
    const double exact = reduced(relay, start).end_time(start);
    CAPTURE(friction, map, start);
    const Matrix2d back = map.inverse();
    const PlanarReduction sheared =
        reduced([=](const Vector2d& x) -> Vector2d { return map * relay(back * x); }, map* start);
    const double stated = sheared.end_time_error(map * start);
    CHECK(stated < 1e-9);
    CHECK(sheared.end_time(map * start) == Approx(exact).epsilon(stated));
    sharp += stated <= 1e-12;
  }
  CHECK(sharp >= 35);
}

TEST_CASE("rates that differ more than doubles can show never make a point at rest", "[planar][domain]") {
  for (const double small : {1e-8, 1e-14, 1e-18, 1e-40, 1e-300}) {
    for (const double sign : {-1, 1}) {
      for (const int axis : {0, 1}) {
        Vector2d rates(-1, -1);
        rates[axis] = sign * small;
        const PlanarReduction plane([=](const Vector2d& x) -> Vector2d { return rates.cwiseProduct(x); },
                                    {0, Matrix2d::Identity(), Vector2d::Zero()}, {1, 1});
        const PlanarEnd end = plane.end({0.7, 0.4});
        CAPTURE(rates);
        CHECK((end == PlanarEnd::undecided || end == (sign < 0 ? PlanarEnd::centre : PlanarEnd::infinity)));
        CHECK((plane.kind().empty() || plane.kind() == (sign < 0 ? "stable node" : "saddle")));
        if (small >= 1e-8) CHECK(end != PlanarEnd::undecided);
      }
    }
  }
}

TEST_CASE("far from 1, too", "[planar][domain]") {
  for (double unit : {1e-155, 1e160}) {
    const PlanarReduction plane =
        reduced([](const Vector2d& x) { return Vector2d(-x.stableNormalized()); }, {3 * unit, 4 * unit});
    CHECK(plane.end_time({3 * unit, 4 * unit}) == Approx(5 * unit).epsilon(1e-13));
  }
}

TEST_CASE("the factor of a scaling is an inverse integrating factor", "[planar]") {
  const PlanarField field = [](const Vector2d& x) {
    return Vector2d(x[1] - x[0] * x[0], x[0] * x[1] - 2 * std::pow(x[0], 3));
  };
  const PlanarReduction plane = reduced(field);
  CHECK(plane.form() == "scaling");
  for (const Vector2d& x : {Vector2d(1, 0.4), Vector2d(-0.7, 1.3), Vector2d(0.2, -2)}) {
    const auto slope = [&](const auto& of, int i) {
      constexpr double h = 1e-3;
      const Vector2d step = h * Vector2d::Unit(i);
      return (8 * (of(x + step) - of(x - step)) - of(x + 2 * step) + of(x - 2 * step)) / (12 * h);
    };
    const auto factor = [&](const Vector2d& at) { return plane.factor(at); };
    const Vector2d f = field(x), gradient(slope(factor, 0), slope(factor, 1));
    const double divergence = slope([&](const Vector2d& at) { return field(at)[0]; }, 0) +
                              slope([&](const Vector2d& at) { return field(at)[1]; }, 1);
    CHECK(std::abs(f.dot(gradient) - plane.factor(x) * divergence) < 1e-9 * f.norm() * gradient.norm());
  }
}

TEST_CASE("conservative oscillators of every power are centers with the period of the closed form", "[planar][exact]") {
  // u'' = -sign(u) |u|^a from (A, 0): v^2/2 + |u|^(a+1)/(a+1) is constant. The period is a beta function.
  std::mt19937 random(57);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  WorstCase periods("period");
  // The damping has the power n of v with which the system still admits a scaling.
  const auto oscillator = [](double a, double damping) {
    const double n = 2 * a / (a + 1);
    return SmoothField(
        [=](const Vector2d& x) {
          return Vector2d(x[1], -std::copysign(std::pow(std::abs(x[0]), a), x[0]) -
                                    damping * std::copysign(std::pow(std::abs(x[1]), n), x[1]));
        },
        [=](const Vector2d& x) {
          return Matrix2d{{0, 1},
                          {-a * std::pow(std::abs(x[0]), a - 1), -damping * n * std::pow(std::abs(x[1]), n - 1)}};
        });
  };
  for (int i = 0; i < (CONTENSOU_FULL_TESTS ? 100 : 20); ++i) {
    const double a = i % 4 == 0 ? uniform(0.1, 0.4) : i % 4 == 1 ? uniform(0.4, 0.9) : uniform(1.05, 3.5);
    const double amplitude = std::pow(10, uniform(-2, 2));
    CAPTURE(a, amplitude);
    const PlanarReduction plane = reduced(oscillator(a, 0), {amplitude, std::pow(amplitude, (a + 1) / 2)});
    CHECK(plane.kind() == "center");
    const PlanarOrbit orbit = plane.orbit({amplitude, 0});
    REQUIRE(orbit.end() == PlanarEnd::periodic);
    const double n = a + 1;
    const double wanted = 4 * std::sqrt(n / 2) * std::pow(amplitude, (1 - a) / 2) * std::sqrt(pi) / n *
                          std::tgamma(1 / n) / std::tgamma(1 / n + 0.5);
    periods.add(wanted, orbit.period().value(), fmt::format("a = {}", a));
    // A damping of 1e-6 must not be taken for none.
    const PlanarReduction damped = reduced(oscillator(a, 1e-6), {amplitude, std::pow(amplitude, (a + 1) / 2)});
    CHECK(damped.kind() == "stable focus");
  }
  INFO(periods.sentence());
  CHECK(periods.worst() < 1e4);
}

TEST_CASE("a motion leaves a centre at which the field is not 0", "[planar][exact]") {
  // u' = a, v' = b u^m has the orbit (a t, b a^m t^(m+1)/(m+1)) from the origin, the centre of its scaling.
  std::mt19937 random(58);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  for (int m = 1; m <= 6; ++m) {
    const double a = (m % 2 == 0 ? -1 : 1) * uniform(0.3, 3), b = (m % 3 == 0 ? -1 : 1) * uniform(0.3, 3);
    CAPTURE(m, a, b);
    const PlanarReduction plane = reduced([=](const Vector2d& x) { return Vector2d(a, b * std::pow(x[0], m)); });
    CHECK(plane.kind() == "regular point");
    const PlanarOrbit orbit = plane.orbit({0, 0});
    CHECK(orbit.end() == PlanarEnd::infinity);
    CHECK(std::isinf(orbit.end_time()));
    CHECK(orbit.at(0) == Vector2d(0, 0));
    for (const double t : {1e-3, 0.7, 12.0}) {
      const Vector2d wanted(a * t, b * std::pow(a, m) * std::pow(t, m + 1) / (m + 1));
      CHECK((orbit.at(t) - wanted).norm() < 1e-12 * wanted.norm());
    }
  }
  // At rest where the field is 0, and where it has no value.
  CHECK(reduced(linear(-Matrix2d::Identity())).orbit({0, 0}).end() == PlanarEnd::centre);
}

TEST_CASE("a turn by 1 without a proof is a center or a focus", "[planar]") {
  // In polar coordinates r' = r R(angle), angle' = 1. The integral of R over a turn is 0, and R has no symmetry, so
  // that no reversor among the known ones exists. Values alone do not tell a center from a focus.
  const PlanarReduction plane = reduced([](const Vector2d& x) -> Vector2d {
    const double q = std::atan2(x[1], x[0]), radial = 0.3 * std::sin(q + 0.4) + 0.2 * std::sin(2 * q + 1.1);
    return radial * x + Vector2d(-x[1], x[0]);
  });
  CHECK(plane.kind() == "center or focus");
  const PlanarOrbit orbit = plane.orbit({1, 0.5});
  CHECK(orbit.end() == PlanarEnd::undecided);
  CHECK_THAT(orbit.undecided(), Contains("no reversor proves"));
  CHECK(!orbit.period());
  CHECK(orbit.at(1.5).allFinite());
}
