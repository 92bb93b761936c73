#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string_view>
#include <vector>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "contensou/reduction/planar_reduction.hpp"

using namespace contensou::reduction;
using Catch::Contains;
using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using std::numbers::pi;

namespace {

/// A monomial a u^i v^j of a component of a field.
struct Monomial {
  int component;
  double a;
  int i, j;
};

SmoothField field_of(const std::vector<Monomial>& monomials) {
  SmoothField field(
      [=](const Vector2d& x) {
        Vector2d f(0, 0);
        for (const auto& [c, a, i, j] : monomials) f[c] += a * std::pow(x[0], i) * std::pow(x[1], j);
        return f;
      },
      [=](const Vector2d& x) {
        Matrix2d slopes = Matrix2d::Zero();
        for (const auto& [c, a, i, j] : monomials) {
          if (i > 0) slopes(c, 0) += a * i * std::pow(x[0], i - 1) * std::pow(x[1], j);
          if (j > 0) slopes(c, 1) += a * j * std::pow(x[0], i) * std::pow(x[1], j - 1);
        }
        return slopes;
      });
  constexpr int most = 12;
  field.polynomials.assign(2, MatrixXd::Zero(most, most));
  for (const auto& [c, a, i, j] : monomials) field.polynomials[static_cast<std::size_t>(c)](i, j) += a;
  return field;
}

/// The terms of the highest degree d: their part along the direction of the angle, and their part across.
struct Leading {
  std::vector<Monomial> monomials;
  int degree;

  Vector2d operator()(double angle) const {
    Vector2d f(0, 0);
    for (const auto& [c, a, i, j] : monomials) {
      if (i + j == degree) f[c] += a * std::pow(std::cos(angle), i) * std::pow(std::sin(angle), j);
    }
    return {std::cos(angle) * f[0] + std::sin(angle) * f[1], std::cos(angle) * f[1] - std::sin(angle) * f[0]};
  }
  /// Returns the slope of the part across, by a difference that is exact to 1e-9.
  double slope(double angle) const {
    constexpr double h = 1e-3;
    const auto across = [&](double at) { return (*this)(at)[1]; };
    return (8 * (across(angle + h) - across(angle - h)) - across(angle + 2 * h) + across(angle - 2 * h)) / (12 * h);
  }
};

double angle_of(const Equilibrium& each) { return std::atan2(each.x[1], each.x[0]); }

}  // namespace

TEST_CASE("equilibria at infinity have the kinds of the textbooks", "[planar]") {
  struct Point {
    double degrees;
    std::string_view kind;
  };
  struct Case {
    const char* name;
    std::vector<Monomial> field;
    std::vector<Point> at_infinity;
  };
  const double steep = std::atan(2) * 180 / pi;
  const Case cases[] = {
      // Perko, section 3.10, examples 1 and 3
      {"linear saddle",
       {{0, 1, 1, 0}, {1, -1, 0, 1}},
       {{-180, "stable node"}, {-90, "unstable node"}, {0, "stable node"}, {90, "unstable node"}}},
      {"no equilibrium in the plane",
       {{0, 1, 2, 0}, {0, 1, 0, 2}, {0, -1, 0, 0}, {1, 5, 1, 1}, {1, -5, 0, 0}},
       {{-180, "saddle"},
        {steep - 180, "unstable node"},
        {-steep, "stable node"},
        {0, "saddle"},
        {steep, "stable node"},
        {180 - steep, "unstable node"}}},
      {"van der Pol",
       {{0, 1, 0, 1}, {1, 1, 0, 1}, {1, -1, 2, 1}, {1, -1, 1, 0}},
       {{-180, "saddle"}, {-90, "unstable node"}, {0, "saddle"}, {90, "unstable node"}}},
      {"uniform motion", {{0, 1, 0, 0}, {1, 2, 0, 0}}, {{steep - 180, "unstable node"}, {steep, "stable node"}}},
      {"center", {{0, 1, 0, 1}, {1, -1, 1, 0}}, {}},
  };
  for (const Case& each : cases) {
    INFO(each.name);
    const PoincareDisc disc = poincare_disc(field_of(each.field), 1);
    CHECK(disc.equilibria.complete);
    REQUIRE(disc.at_infinity.size() == each.at_infinity.size());
    for (std::size_t i = 0; i < each.at_infinity.size(); ++i) {
      CHECK(angle_of(disc.at_infinity[i]) * 180 / pi == Approx(each.at_infinity[i].degrees).margin(1e-12));
      CHECK(disc.at_infinity[i].kind == each.at_infinity[i].kind);
    }
  }
}

TEST_CASE("equilibria of random polynomial fields on the disc agree with the leading terms and the plane", "[planar]") {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> coefficient(-2, 2), place(-0.9, 0.9);
  int finite = 0, infinite = 0;
  for (int run = 0; run < 60; ++run) {
    INFO("field " << run);
    const int degree = 1 + run % 4;
    std::vector<Monomial> monomials;
    for (int c : {0, 1}) {
      for (int n = 0; n <= degree; ++n) {
        for (int j = 0; j <= n; ++j) monomials.push_back({c, coefficient(engine), n - j, j});
      }
    }
    const SmoothField field = field_of(monomials);
    const PoincareDisc disc = poincare_disc(field, 1.5);
    CHECK(disc.degree == degree);
    CHECK(disc.equilibria.complete);

    // On the circle the part across of the leading terms changes its sign, with the slopes of both eigenvalues.
    const Leading leading{monomials, degree};
    constexpr int samples = 2000;
    int changes = 0;
    for (int i = 0; i < samples; ++i) {
      changes += leading(2 * pi * i / samples)[1] * leading(2 * pi * (i + 1) / samples)[1] < 0 ? 1 : 0;
    }
    CHECK(static_cast<int>(disc.at_infinity.size()) == changes);
    for (const Equilibrium& each : disc.at_infinity) {
      ++infinite;
      const double angle = angle_of(each);
      CHECK(each.x.norm() == Approx(1).epsilon(1e-15));
      const double scale = std::pow(disc.radius, degree - 1), along = leading(angle)[0], slope = leading.slope(angle);
      CHECK(std::abs(leading(angle)[1]) < 1e-9);
      REQUIRE(each.eigenvalues);
      const auto [low, high] = std::minmax({-scale * along, scale * slope});
      CHECK(each.eigenvalues->first.real() == Approx(low).epsilon(1e-8).margin(1e-8));
      CHECK(each.eigenvalues->second.real() == Approx(high).epsilon(1e-8).margin(1e-8));
      // The same slopes come from the field of the disc.
      CHECK((each.slopes - disc.field.jacobian(each.x)).norm() < 1e-9 * (1 + each.slopes.norm()));
    }
    for (const Equilibrium& each : disc.equilibria.points) {
      ++finite;
      const Vector2d x = disc.from(each.x);
      REQUIRE(each.eigenvalues);
      const auto [first, second] = *each.eigenvalues;
      const Matrix2d slopes = field.jacobian(x);
      const double size = slopes.norm();
      CHECK(std::abs(first + second - slopes.trace()) < 1e-7 * size);
      CHECK(std::abs(first * second - slopes.determinant()) < 1e-7 * size * size);
    }
    // The field of the disc is the motion of X(x(t)), at another speed.
    for (int i = 0; i < 5; ++i) {
      const Vector2d X(place(engine) / 1.4, place(engine) / 1.4), x = disc.from(X);
      CHECK((disc.onto(x) - X).norm() < 1e-14);
      constexpr double h = 1e-6;
      const Vector2d f = field(x), moved = (disc.onto(x + h * f) - disc.onto(x - h * f)) / (2 * h);
      const double rate = std::pow(1 - X.squaredNorm(), degree - 1);
      CHECK((disc.field(X) - rate * moved).norm() < 1e-6 * (1 + disc.field(X).norm()));
      Matrix2d slopes;
      for (int j : {0, 1}) {
        const Vector2d step = h * Vector2d::Unit(j);
        slopes.col(j) = (disc.field(X + step) - disc.field(X - step)) / (2 * h);
      }
      CHECK((disc.field.jacobian(X) - slopes).norm() < 1e-6 * (1 + slopes.norm()));
    }
  }
  CHECK(finite > 60);
  CHECK(infinite > 150);
}

TEST_CASE("motions that start beside the circle begin with short steps", "[planar]") {
  // Backwards, the distance from the saddle at (1, 0) grows like exp(r s) at first. A first step in proportion to 1/|f|
  // would be so long that the step overflows, and an error relative to infinity is none for the controlled stepper.
  constexpr double radius = 2;
  const PoincareDisc disc =
      poincare_disc(field_of({{0, 1, 2, 0}, {0, 1, 0, 2}, {0, -1, 0, 0}, {1, 5, 1, 1}, {1, -5, 0, 0}}), radius);
  for (const double away : {1e-5, 1e-6, 1e-7}) {
    INFO(away);
    const PlanarOrbit orbit = by_steps(disc.field).reversed().orbit({1 - away, 0});
    for (const double s : {0.4, 1., 2.}) {
      const double grown = away * std::exp(radius * s);
      CHECK(1 - orbit.at(s)[0] == Approx(grown).epsilon(2 * grown + 1e-12 / away));
    }
  }
}

TEST_CASE("a field that is small is no curve of equilibria", "[planar]") {
  // u' = u^11, v' = -v: next to the circle the field of the disc is below 1e-6 of its largest value.
  const PoincareDisc small = poincare_disc(field_of({{0, 1, 11, 0}, {1, -1, 0, 1}}), 2);
  CHECK_FALSE(small.rests);
  CHECK_FALSE(small.equilibria.on_curve);
  CHECK_FALSE(small.equilibria.complete);
  // u' = u v, v' = u^2: the axis u = 0 consists of equilibria, the circle does not.
  const PoincareDisc axis = poincare_disc(field_of({{0, 1, 1, 1}, {1, 1, 2, 0}}), 2);
  CHECK_FALSE(axis.rests);
  CHECK(axis.equilibria.on_curve);
  // u' = u + u^2, v' = v + u v: the leading terms u (u, v) have no part across.
  const PoincareDisc circle = poincare_disc(field_of({{0, 1, 1, 0}, {0, 1, 2, 0}, {1, 1, 0, 1}, {1, 1, 1, 1}}), 2);
  CHECK(circle.rests);
  CHECK(poincare_disc(field_of({{0, 1, 1, 0}, {1, 1, 0, 1}}), 2).rests);
}

TEST_CASE("motions that turn away like a logarithm hide separatrices", "[planar]") {
  // u' = u^2, v' = -v: near the end (0, inf) of the axis u = 0, the chart (u/v, 1/v) has p' = p^2 + p z, z' = z^2. The
  // axis is the only separatrix there. Beside it 1/u = c + ln v, so that motions turn away slowly.
  const PoincareDisc disc = poincare_disc(field_of({{0, 1, 2, 0}, {1, -1, 0, 1}}), 2);
  int ends = 0;
  for (const Equilibrium& each : disc.at_infinity) {
    if (std::abs(each.x[0]) > 0.5) continue;
    ++ends;
    for (const SeparatrixPoint& point : degenerate_separatrices(disc.field, each.x, {1, 1})) {
      CHECK(std::abs(point.x[0]) < 1e-5);
    }
  }
  CHECK(ends == 2);
}

TEST_CASE("the disc needs a polynomial field and a radius", "[planar]") {
  CHECK_THROWS_WITH(poincare_disc(SmoothField([](const Vector2d& x) { return x; }), 1), Contains("polynomials"));
  CHECK_THROWS_WITH(poincare_disc(field_of({{0, 1, 1, 0}}), 0), Contains("positive and finite, got 0"));
  CHECK_THROWS_WITH(poincare_disc(field_of({}), 1), Contains("a field that is not 0"));
}
