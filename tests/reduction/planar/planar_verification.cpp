#include "contensou/reduction/verification.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/planar_reduction.hpp"

using namespace contensou::reduction;
using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

/// Returns the field of y' = F(x, y) from F and its derivatives.
template <class Function>
SmoothField first_order(Function f) {
  return SmoothField([=](const Vector2d& x) { return Vector2d(1, f(x[0], x[1])[0]); },
                     [=](const Vector2d& x) {
                       const Eigen::Vector3d at = f(x[0], x[1]);
                       return Matrix2d{{0, 0}, {at[1], at[2]}};
                     });
}

const SmoothField predators([](const Vector2d& x) { return Vector2d(x[0] - x[0] * x[1], x[0] * x[1] - x[1]); },
                            [](const Vector2d& x) {
                              return Matrix2d{{1 - x[1], -x[0]}, {x[1], x[0] - 1}};
                            });

const Check& row_of(const std::vector<Check>& checks, const std::string& name) {
  const auto row = std::ranges::find_if(checks, [&](const Check& check) { return check.name.starts_with(name); });
  REQUIRE(row != checks.end());
  return *row;
}

std::vector<Check> checks_of(const SmoothField& field, const Vector2d& start) {
  const PlanarSymmetries found = find_symmetries(field, sampled_about(field, start));
  return verify(reduce(field, start, found), found, start);
}

}  // namespace

TEST_CASE("the first integral is continued along a path, far from the box of V", "[planar]") {
  const Vector2d start(1, 2);
  const PlanarReduction plane = by_factor(predators, start);
  REQUIRE(plane.solved());
  const std::vector<Vector2d> path{{1.5, 1}, {3, 0.5}, {5, 3}, {0.2, 4}, start};
  const std::vector<LevelPoint> levels = plane.levels(path);
  // V = u v/2 is 1 at the start, and dH = (u' dv - v' du)/V.
  const auto h = [](const Vector2d& x) { return 2 * std::log(x[0] * x[1]) - 2 * (x[0] + x[1]); };
  for (std::size_t i = 0; i < path.size(); ++i) {
    CHECK(levels[i].integral == Approx(h(path[i]) - h(start)).epsilon(1e-10).margin(1e-10));
    CHECK(levels[i].factor == Approx(path[i][0] * path[i][1] / 2).epsilon(1e-10));
  }
  // V = 0 on the axis, beyond which H has no value.
  CHECK(std::isnan(plane.levels({{-1, 2}})[0].integral));
}

TEST_CASE("orbits in which x grows for ever are known to do so", "[planar]") {
  const auto end_of = [](const SmoothField& field, const Vector2d& start) {
    return by_factor(field, start).orbit(start);
  };
  // y' = 3 - 2 y^2: y tends to sqrt(3/2).
  const PlanarOrbit riccati =
      end_of(first_order([](double, double y) { return Eigen::Vector3d(3 - 2 * y * y, 0, -4 * y); }), {1.3, 0.7});
  CHECK(riccati.end() == PlanarEnd::infinity);
  CHECK(std::isinf(riccati.end_time()));
  CHECK(riccati.limit()[0] > 1e300);
  CHECK(riccati.limit()[1] == Approx(std::sqrt(1.5)).epsilon(1e-9));
  // y' = 3 sin x - 2 y has no limit.
  const PlanarOrbit linear = end_of(
      first_order([](double x, double y) { return Eigen::Vector3d(3 * std::sin(x) - 2 * y, 3 * std::cos(x), -2); }),
      {1.3, 0.7});
  CHECK(linear.end() == PlanarEnd::infinity);
  CHECK(std::isnan(linear.limit()[1]));
  // y' = 2 cos y - 3 is bounded. y falls for ever.
  const PlanarOrbit bounded = end_of(
      first_order([](double, double y) { return Eigen::Vector3d(2 * std::cos(y) - 3, 0, -2 * std::sin(y)); }), {1, 1});
  CHECK(bounded.end() == PlanarEnd::infinity);
  CHECK(std::isinf(bounded.end_time()));
  // u' = u^2, v' = u^2 v (v + 2) - 2 u - 2: u is infinite at t = 1/u0, and v tends to -2.
  const PlanarOrbit finite = end_of(SmoothField(
                                        [](const Vector2d& x) {
                                          const double u = x[0], v = x[1];
                                          return Vector2d(u * u, u * u * v * (v + 2) - 2 * u - 2);
                                        },
                                        [](const Vector2d& x) {
                                          const double u = x[0], v = x[1];
                                          return Matrix2d{{2 * u, 0}, {2 * u * v * (v + 2) - 2, u * u * (2 * v + 2)}};
                                        }),
                                    {1.3, 0.7});
  CHECK(finite.end() == PlanarEnd::infinity);
  CHECK(finite.end_time() == Approx(1 / 1.3).epsilon(1e-12));
  CHECK(finite.limit()[1] == Approx(-2).epsilon(1e-8));
  // u' = 2 v - 6 u, v' = v - 3 u - 2: without an equilibrium, along the line v = 3 u.
  const PlanarOrbit drift =
      end_of(SmoothField([](const Vector2d& x) { return Vector2d(2 * x[1] - 6 * x[0], x[1] - 3 * x[0] - 2); },
                         [](const Vector2d&) {
                           return Matrix2d{{-6, 2}, {-3, 1}};
                         }),
             {1.3, 0.7});
  CHECK(drift.end() == PlanarEnd::infinity);
}

TEST_CASE("an orbit that a far pole or growth could end is not said to last for ever", "[planar]") {
  // y' = sin x - y + 1/(1e5 - x): V exists, and there is a pole far ahead. The denominator changes its sign there.
  SmoothField pole = first_order([](double x, double y) {
    const double d = 1e5 - x;
    return Eigen::Vector3d(std::sin(x) - y + 1 / d, std::cos(x) + 1 / (d * d), -1);
  });
  pole.denominator = [](const Vector2d& x) { return Eigen::RowVector3d(1e5 - x[0], -1, 0); };
  const PlanarReduction plane = by_factor(pole, {1, 0.5});
  REQUIRE(plane.solved());
  CHECK(plane.orbit({1, 0.5}).end() != PlanarEnd::infinity);
  // y' = -y cos x + 1e-4 y^2 ends in a finite time, after many periods.
  const PlanarReduction bernoulli =
      by_factor(first_order([](double x, double y) {
                  return Eigen::Vector3d(1e-4 * y * y - y * std::cos(x), y * std::sin(x), 2e-4 * y - std::cos(x));
                }),
                {0, 1});
  REQUIRE(bernoulli.solved());
  const PlanarOrbit orbit = bernoulli.orbit({0, 1});
  CHECK((orbit.end() == PlanarEnd::undecided || std::isfinite(orbit.end_time())));
}

TEST_CASE("an orbit whose small coordinate is rounding does not end in a finite time", "[planar]") {
  // v falls like exp(-2 t) and u grows like exp(t): from t = 15 on, v is smaller than the rounding of u.
  const SmoothField field(
      [](const Vector2d& x) {
        const double u = x[0], v = x[1], sum = u + v;
        return Vector2d(u + v * v + 2 * v, -v * v * sum * sum - v * v - v);
      },
      [](const Vector2d& x) {
        const double u = x[0], v = x[1], sum = u + v;
        return Matrix2d{{1, 2 * v + 2}, {-2 * v * v * sum, -2 * v * sum * sum - 2 * v * v * sum - 2 * v - 1}};
      });
  const PlanarReduction plane = by_factor(field, {1.3, 0.7});
  REQUIRE(plane.solved());
  CHECK(plane.orbit({1.3, 0.7}).end() == PlanarEnd::undecided);
}

TEST_CASE("every statement about a typed system holds, and each that applies is made", "[verification]") {
  const SmoothField pendulum([](const Vector2d& x) { return Vector2d(x[1], -std::sin(x[0])); },
                             [](const Vector2d& x) {
                               return Matrix2d{{0, 1}, {-std::cos(x[0]), 0}};
                             });
  const SmoothField node(
      [](const Vector2d& x) { return Vector2d(-x[0] * std::abs(x[0]) - x[1] * x[1], -2 * x[1] * x[1]); });
  for (const auto& [field, start, rows] :
       {std::tuple{pendulum, Vector2d(0, 1), 15}, {predators, {1, 2}, 14}, {node, {1, 2}, 8}}) {
    const std::vector<Check> checks = checks_of(field, start);
    CHECK(std::ssize(checks) >= rows);
    for (const Check& check : checks) {
      CAPTURE(check.name, check.measured, check.allowed);
      CHECK(check.passed());
      CHECK(check.allowed < 1e-6);
    }
  }
  // A system that is not solved has no quadrature to compare.
  for (const Check& check :
       checks_of(SmoothField([](const Vector2d& x) { return Vector2d(x[1] + 0.1, x[1] * std::exp(x[0]) - x[0]); }),
                 {0.3, 0.2})) {
    CAPTURE(check.name);
    CHECK(check.passed());
    CHECK(check.name.find("quadrature") == std::string::npos);
  }
  CHECK_THROWS_AS(checks_of(predators, {1, 1}), std::domain_error);
}

TEST_CASE("a false statement about a typed system fails", "[verification]") {
  const Vector2d start(1, 2);
  PlanarSymmetries found = find_symmetries(predators, start);
  const PlanarReduction plane = reduce(predators, start, found);
  found.generators.push_back({0, Matrix2d::Identity(), Vector2d::Zero()});
  const std::vector<Check> checks = verify(plane, found, start);
  CHECK(!row_of(checks, "symmetry: field").passed());
  CHECK(!row_of(checks, "symmetry: orbit").passed());
  CHECK(row_of(checks, "state").passed());

  // A Jacobian that is off by 1e-6 gives a false V, or none.
  SmoothField off = predators;
  off.jacobian = [](const Vector2d& x) { return Matrix2d{{1 - x[1], -x[0] * (1 + 1e-6)}, {x[1], x[0] - 1}}; };
  CHECK(!row_of(checks_of(off, start), "derivatives").passed());
}
