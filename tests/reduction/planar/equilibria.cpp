#include "contensou/reduction/planar_reduction.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace contensou::reduction;
using Eigen::Matrix2d;
using Eigen::Vector2d;

TEST_CASE("equilibria are found with their types", "[planar]") {
  // The field is a matrix times the distance from its zero. The type of the zero follows from the matrix.
  const auto at_zero = [](double a, double b, double c, double d) {
    const Matrix2d matrix = (Matrix2d() << a, b, c, d).finished();
    const Equilibria found =
        find_equilibria({[=](const Vector2d& x) -> Vector2d { return matrix * x; }}, Vector2d(1, 1));
    REQUIRE(found.points.size() == 1);
    return found.points[0];
  };
  const auto kind = [&](double a, double b, double c, double d) { return at_zero(a, b, c, d).kind; };
  CHECK(kind(1, 0, 0, -1) == "saddle");
  CHECK(kind(-1, 0, 3, -2) == "stable node");
  CHECK(kind(1, 0, 3, 2) == "unstable node");
  CHECK(kind(-1, 1, -1, -1) == "stable focus");
  CHECK(kind(1, 1, -1, 1) == "unstable focus");
  CHECK(kind(1, 2, -1, -1) == "center or focus");
  CHECK(kind(-1e-11, 1, -1, 0) == "stable focus");
  CHECK(kind(-1, 1, 0, -1) == "stable node");
  const auto [first, second] = at_zero(-1, 2, -2, -1).eigenvalues.value();
  CHECK(std::abs(first - std::complex<double>(-1, -2)) < 1e-15);
  CHECK(std::abs(second - std::complex<double>(-1, 2)) < 1e-15);

  // Two fields: one with an exact Jacobian, one without.
  const SmoothField rabbits{
      [](const Vector2d& x) { return Vector2d(x[0] * (3 - x[0] - 2 * x[1]), x[1] * (2 - x[0] - x[1])); },
      [](const Vector2d& x) {
        return (Matrix2d() << 3 - 2 * x[0] - 2 * x[1], -2 * x[0], -x[1], 2 - x[0] - 2 * x[1]).finished();
      }};
  for (const SmoothField& field : {rabbits, SmoothField{rabbits.value}}) {
    const std::vector<Equilibrium> found = find_equilibria(field, {-0.5, -0.5}, {4, 4}).points;
    REQUIRE(found.size() == 4);
    const Vector2d places[] = {{0, 0}, {0, 2}, {1, 1}, {3, 0}};
    const std::string_view kinds[] = {"unstable node", "stable node", "saddle", "stable node"};
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK((found[i].x - places[i]).norm() < 1e-12);
      CHECK(found[i].kind == kinds[i]);
    }
  }
  CHECK(find_equilibria(rabbits, {0.5, 1.5}, {0.8, 1.9}).points.empty());
  // The field u' = 1, v' = u - v^2 has a singular Jacobian everywhere, but no equilibria.
  CHECK(find_equilibria({[](const Vector2d& x) { return Vector2d(1, x[0] - x[1] * x[1]); }}, {-2, -3}, {6, 3})
            .points.empty());
  // This field has no value in a part of the rectangle.
  const std::vector<Equilibrium> half =
      find_equilibria({[](const Vector2d& x) { return Vector2d(std::log(x[0]), x[1]); }}, {-2, -1}, {2, 1}).points;
  REQUIRE(half.size() == 1);
  CHECK((half[0].x - Vector2d(1, 0)).norm() < 1e-12);
}

TEST_CASE("equilibria that are not isolated are left out", "[planar]") {
  const auto count = [](auto f) { return find_equilibria({f}, {-3, -2}, {2, 3}).points.size(); };
  // Zeros on a line or circle do not count. A multiple zero is isolated and counts.
  CHECK(count([](const Vector2d& x) { return Vector2d(x[1], 0); }) == 0);
  CHECK(count([](const Vector2d& x) { return Vector2d(x * (1 - x.squaredNorm())); }) == 1);
  CHECK(count([](const Vector2d& x) { return Vector2d(x[0] * x[0], -x[1]); }) == 1);
  CHECK(count([](const Vector2d& x) { return Vector2d(x[1], -std::pow(x[0], 3)); }) == 1);
}

TEST_CASE("a curve of equilibria is named by one of its points", "[planar]") {
  const auto curve = [](auto f) { return find_equilibria({f}, {-3, -2}, {2, 3}).on_curve; };
  CHECK_FALSE(curve([](const Vector2d& x) { return Vector2d(x[1], -x[0]); }));
  CHECK_FALSE(curve([](const Vector2d& x) { return Vector2d(x[0] * x[0], -x[1]); }));
  // The factor g vanishes on the curve; its power is the multiplicity of the zeros.
  for (const int power : {1, 2}) {
    const auto check = [&](const auto& g) {
      const auto point =
          curve([&](const Vector2d& x) -> Vector2d { return std::pow(g(x), power) * Vector2d(1, x[0] - 2 * x[1]); });
      REQUIRE(point);
      CHECK(std::abs(g(*point)) < 1e-6);
    };
    CAPTURE(power);
    check([](const Vector2d& x) { return x[1]; });
    check([](const Vector2d& x) { return 0.3 * x[0] - x[1] + 0.7; });
    check([](const Vector2d& x) { return 1 - x.squaredNorm(); });
    check([](const Vector2d& x) { return std::sin(x[0]) - x[1]; });
  }
}

TEST_CASE("a reflection that turns motions back proves a center, alone it proves nothing", "[planar]") {
  const auto names = [](auto f, const Vector2d& around) {
    std::vector<std::string_view> found;
    for (const Reversor& each : find_reversors({f}, around)) found.push_back(each.name);
    return found;
  };
  using Names = std::vector<std::string_view>;
  const auto kinds = [](auto f) {
    std::vector<std::string_view> found;
    for (const Equilibrium& each : find_equilibria({f}, {-2, -2}, {2, 2}).points) found.push_back(each.kind);
    return found;
  };
  const auto swap = [](const Vector2d& x) { return Vector2d(x[1], x[0]); };
  CHECK(names(swap, {1, 2}) == Names{"(u, -v)", "(-u, v)"});
  CHECK(kinds(swap) == Names{"saddle"});
  const auto pendulum = [](const Vector2d& x) { return Vector2d(x[1], -std::sin(x[0])); };
  CHECK(names(pendulum, {1, 0}) == Names{"(u, -v)", "(-u, v)"});
  CHECK(kinds(pendulum) == Names{"center"});
  const auto rabbits = [](const Vector2d& x) { return Vector2d(x[0] * (1 - x[1]), x[1] * (x[0] - 1)); };
  CHECK(names(rabbits, {0.5, 2}) == Names{"(v, u)"});
  CHECK(kinds(rabbits) == Names{"saddle", "center"});
  CHECK(names([](const Vector2d& x) { return Vector2d(x[0] * x[1], 1 + x[0] * x[0]); }, {1, 1}) ==
        Names{"(u, -v)", "(-u, -v)"});
  CHECK(names([](const Vector2d& x) { return Vector2d(-x[0] + x[1], x[0] - x[1]); }, {1, 1}).empty());
  CHECK(
      names([](const Vector2d& x) { return Vector2d(x[0] - x[1] + x[0] * x[1] * x[1], x[0] - x[1]); }, {1, 1}).empty());
  CHECK(names([](const Vector2d& x) { return Vector2d(x[0] + x[1] * x[1], -x[1] - x[0] * x[0]); }, {1, 1}) ==
        Names{"(v, u)"});
  // Without a reversor the cubic terms decide: the square of the distance falls at the rate 2 u^2 |x|^2.
  const auto turning = [](const Vector2d& x) { return Vector2d(-x[1] - x[0] * x.squaredNorm(), x[0]); };
  CHECK(kinds(turning) == Names{"stable focus"});
  // The damping is small compared with the other terms of the field, but it is not 0.
  CHECK(names([](const Vector2d& x) { return Vector2d(x[1], -std::sin(x[0]) - 1e-11 * x[1]); }, {1, 1}).empty());
  // The field has values on one side of u = 0 only.
  CHECK(names([](const Vector2d& x) { return Vector2d(x[1], -std::log(x[0])); }, {1, 1}) == Names{"(u, -v)"});
}
