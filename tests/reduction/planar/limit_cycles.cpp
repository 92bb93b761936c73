#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "contensou/reduction/planar_reduction.hpp"

using namespace contensou::reduction;
using Eigen::Matrix2d;
using Eigen::Vector2d;
using std::numbers::pi;

namespace {

std::vector<LimitCycle> cycles_of(const PlanarField& field, double half, double reach = 1.5) {
  const Vector2d corner(half, half);
  return find_limit_cycles(field, find_equilibria(field, -corner, corner), reach);
}

PlanarField van_der_pol(double mu) {
  return [=](const Vector2d& x) { return Vector2d(x[1], mu * (1 - x[0] * x[0]) * x[1] - x[0]); };
}

}  // namespace

TEST_CASE("limit cycles have the periods and multipliers of an independent integration", "[planar]") {
  struct Case {
    const char* name;
    PlanarField field;
    double period, exponent;
  };
  // Periods and integrals of the divergence by SciPy's DOP853 with the relative tolerance 3e-14.
  const Case cases[] = {
      {"van der Pol 0.1", van_der_pol(0.1), 6.287111272288722, -0.629103921025971},
      {"van der Pol 1", van_der_pol(1), 6.663286859323127, -7.058932808798904},
      {"van der Pol 10", van_der_pol(10), 19.078369566939017, -311.84421928622817},
      {"the reversed van der Pol 1", van_der_pol(-1), 6.663286859323127, 7.058932808798904},
      {"Selkov",
       [](const Vector2d& x) {
         const double rate = (0.08 + x[0] * x[0]) * x[1];
         return Vector2d(rate - x[0], 0.6 - rate);
       },
       9.622607779046984, -1.9570636258201164},
      {"Brusselator",
       [](const Vector2d& x) {
         const double rate = x[0] * x[0] * x[1];
         return Vector2d(1 + rate - 4 * x[0], 3 * x[0] - rate);
       },
       7.156919921179872, -8.287520680265558},
      {"FitzHugh-Nagumo",
       [](const Vector2d& x) {
         return Vector2d(x[0] - std::pow(x[0], 3) / 3 - x[1] + 0.5, 0.08 * (x[0] + 0.7 - 0.8 * x[1]));
       },
       39.47441498024074, -38.31126399676384},
      {"chlorine dioxide and iodine",
       [](const Vector2d& x) {
         const double rate = x[0] * x[1] / (1 + x[0] * x[0]);
         return Vector2d(10 - x[0] - 4 * rate, 2 * (x[0] - rate));
       },
       3.2631281000188386, -3.68409851097546},
  };
  for (const Case& each : cases) {
    INFO(each.name);
    const std::vector<LimitCycle> found = cycles_of(each.field, 6);
    REQUIRE(found.size() == 1);
    CHECK(found[0].period == Approx(each.period).epsilon(1e-9));
    CHECK(std::log(found[0].multiplier) == Approx(each.exponent).epsilon(1e-8));
    CHECK(found[0].stable == (each.exponent < 0));
    // The points of the line follow each other in the direction of the motion.
    const std::vector<Vector2d>& line = found[0].line;
    CHECK(line.front() == line.back());
    for (std::size_t i = 1; i < line.size(); ++i) {
      CHECK((line[i] - line[i - 1]).dot(each.field((line[i] + line[i - 1]) / 2)) > 0);
    }
  }
}

TEST_CASE("all limit cycles of a radial equation are found, in any coordinates", "[planar]") {
  // r' = c r (r^2 - a) (r^2 - b) ..., theta' = w. The radius of a cycle has the rate 2 c a (a - b) ... of growth.
  std::mt19937_64 random(20260719);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 48; ++i) {
    std::vector<double> squares;
    const int count = i % 4;
    for (double last = 0.1; static_cast<int>(squares.size()) < count;) {
      const bool closest = i % 8 == 3 && squares.size() == 2;
      squares.push_back(last += 0.05 + (closest ? 0.03 : 0.5) * uniform(random));
    }
    const double c = (i % 2 == 0 ? 1 : -1) * (0.2 + uniform(random)),
                 w = (i % 3 == 0 ? -1 : 1) * (0.5 + uniform(random));
    const Vector2d centre(uniform(random) - 0.5, uniform(random) - 0.5);
    Matrix2d mixed = Matrix2d::Identity();
    for (double& each : mixed.reshaped()) each += 0.6 * uniform(random) - 0.3;
    const Matrix2d back = mixed.inverse();
    const PlanarField field = [=](const Vector2d& x) -> Vector2d {
      // Written out, because expressions of matrices are slow without optimization.
      const double u = x[0] - centre[0], v = x[1] - centre[1];
      const double p = back(0, 0) * u + back(0, 1) * v, q = back(1, 0) * u + back(1, 1) * v;
      double rate = c;
      for (const double square : squares) rate *= p * p + q * q - square;
      const double p_rate = rate * p - w * q, q_rate = w * p + rate * q;
      return {mixed(0, 0) * p_rate + mixed(0, 1) * q_rate, mixed(1, 0) * p_rate + mixed(1, 1) * q_rate};
    };
    INFO("system " << i);
    const std::vector<LimitCycle> found = cycles_of(field, 2);
    REQUIRE(found.size() == squares.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      CHECK((back * (found[k].x - centre)).squaredNorm() == Approx(squares[k]).epsilon(1e-8));
      CHECK(found[k].period == Approx(2 * pi / std::abs(w)).epsilon(1e-9));
      double rate = 2 * c * squares[k];
      for (std::size_t l = 0; l < squares.size(); ++l) rate *= l == k ? 1 : squares[k] - squares[l];
      CHECK(std::log(found[k].multiplier) == Approx(rate * 2 * pi / std::abs(w)).epsilon(1e-6).margin(1e-8));
      CHECK(found[k].stable == rate < 0);
    }
  }
}

TEST_CASE("systems without limit cycles have none", "[planar]") {
  const PlanarField fields[] = {
      [](const Vector2d& x) { return Vector2d(x[1], -x[0]); },                                  // a center
      [](const Vector2d& x) { return Vector2d(x[1], -std::sin(x[0])); },                        // a pendulum
      [](const Vector2d& x) { return Vector2d(x[1], x[0] - std::pow(x[0], 3)); },               // Duffing
      [](const Vector2d& x) { return Vector2d(x[1], x[0] - std::pow(x[0], 3) - 0.2 * x[1]); },  // damped
      [](const Vector2d& x) { return Vector2d(x[0] * (1 - x[1]), x[1] * (x[0] - 1)); },         // Lotka-Volterra
      [](const Vector2d& x) {
        return Vector2d(x[0] * (3 - x[0] - 2 * x[1]), x[1] * (2 - x[0] - x[1]));
      },                                   // competition
      [](const Vector2d& x) -> Vector2d {  // two radii just do not exist
        const double square = x.squaredNorm(), rate = -0.2501 + square - square * square;
        return rate * x + Vector2d(-x[1], x[0]);
      },
      [](const Vector2d& x) -> Vector2d {  // closed orbits for r <= 1 and a growth outside
        return std::max(0., x.squaredNorm() - 1) * x + Vector2d(-x[1], x[0]);
      },
      [](const Vector2d& x) -> Vector2d {  // closed orbits for 1 <= r <= 1.2, between orbits that near them
        const double r = x.norm(), rate = r < 1 ? 1 - r : r > 1.2 ? 1.2 - r : 0;
        return rate * x + Vector2d(-x[1], x[0]);
      },
  };
  for (const PlanarField& field : fields) {
    INFO("field " << &field - fields);
    CHECK(cycles_of(field, 4).empty());
  }
}

TEST_CASE("a limit cycle beside a loop of a saddle is found", "[planar]") {
  // The unstable cycle of Bogdanov and Takens exists for 0.714 < b < 1; near 0.714 it is the loop of the saddle.
  // Period and exponent for b = 0.85 by SciPy's DOP853 with the relative tolerance 3e-14, in reversed time.
  const std::vector<LimitCycle> found =
      cycles_of([](const Vector2d& x) { return Vector2d(x[1], -1 + x[0] * x[0] + x[1] * (x[0] + 0.85)); }, 2);
  REQUIRE(found.size() == 1);
  CHECK(found[0].period == Approx(5.446335403234571).epsilon(1e-9));
  CHECK(std::log(found[0].multiplier) == Approx(1.1584079841648676).epsilon(1e-8));
  CHECK_FALSE(found[0].stable);
}

TEST_CASE("equal limit cycles about two foci are both found, also beside a loop of the saddle between them",
          "[planar]") {
  // x'' = x - x^3 + 0.1 (c - x^2) x'. The loops of the saddle are near c = 0.8, and at c = 1 both small cycles vanish.
  std::mt19937_64 random(5);
  for (int i = 0; i < 12; ++i) {
    const double c = i == 0   ? 0.8005
                     : i == 1 ? 0.81
                              : 0.8 + std::pow(10, std::uniform_real_distribution(-3., -1.)(random));
    CAPTURE(c);
    const PlanarField field = [=](const Vector2d& x) {
      return Vector2d(x[1], x[0] - std::pow(x[0], 3) + 0.1 * (c - x[0] * x[0]) * x[1]);
    };
    std::vector<LimitCycle> found = cycles_of(field, 1.6, 3);
    REQUIRE(found.size() == 3);
    std::ranges::sort(found, {}, [](const LimitCycle& cycle) { return cycle.stable; });
    CHECK(found[2].stable);
    CHECK(found[0].period == Approx(found[1].period).epsilon(1e-9));
    // Steps in time return, backwards for the unstable cycles.
    for (const LimitCycle& cycle : found) {
      const PlanarReduction steps = cycle.stable ? by_steps(field) : by_steps(field).reversed();
      CHECK((steps.orbit(cycle.x).at(cycle.period) - cycle.x).norm() < 1e-8);
    }
  }
}

TEST_CASE("a stable and an unstable cycle about two foci are both found", "[planar]") {
  // x' = y + y^2, y' = -x/2 + c y - x y + (1 + c) y^2 is reversed by (x, y) -> (-2 - x, -1 - y). From outside the
  // unstable cycle motions run to the stable one and turn about the other focus.
  std::mt19937_64 random(8);
  for (int i = 0; i < 8; ++i) {
    const double c = std::uniform_real_distribution(0.19, 0.21)(random), sense = i % 2 == 0 ? 1 : -1;
    CAPTURE(c, sense);
    const PlanarField field = [=](const Vector2d& x) -> Vector2d {
      return sense * Vector2d(x[1] + x[1] * x[1], -x[0] / 2 + c * x[1] - x[0] * x[1] + (1 + c) * x[1] * x[1]);
    };
    const std::vector<LimitCycle> found = cycles_of(field, 2.5, 3);
    REQUIRE(found.size() == 2);
    CHECK(found[0].stable != found[1].stable);
    CHECK(found[0].period == Approx(found[1].period).epsilon(1e-9));
    CHECK(found[0].multiplier * found[1].multiplier == Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("a limit cycle that sticks has the multiplier 0", "[planar]") {
  // A block on a belt. It leaves the belt at x = 0.4 and sticks again at x = -0.335058894593 (SciPy's DOP853).
  const auto on_side = [](double sign) {
    SmoothField field;
    field.value = [=](const Vector2d& x) { return Vector2d(x[1], -x[0] - (0.4 - 0.2 * sign * (x[1] - 0.5)) * sign); };
    return field;
  };
  SmoothField belt;
  belt.value = [=](const Vector2d& x) { return on_side(x[1] > 0.5 ? 1 : -1)(x); };
  belt.branch = [=](const Vector2d& x) { return on_side(x[1] > 0.5 ? 1 : -1); };
  belt.switches = [](const Vector2d& x) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> rows(1, 3);
    rows << x[1] - 0.5, 0, 1;
    return rows;
  };
  const Vector2d corner(1.5, 1.5);
  const std::vector<LimitCycle> found = find_limit_cycles(belt, find_equilibria(belt, -corner, corner), 1);
  REQUIRE(found.size() == 1);
  CHECK(found[0].period == Approx(6.736837191765).epsilon(1e-9));
  CHECK(found[0].multiplier == 0);
  CHECK(found[0].stable);
  double left = 0, right = 0;
  for (const Vector2d& x : found[0].line) {
    if (std::abs(x[1] - 0.5) > 1e-9) continue;
    left = std::min(left, x[0]);
    right = std::max(right, x[0]);
  }
  CHECK(left == Approx(-0.335058894593).margin(0.05));
  CHECK(right == Approx(0.4).margin(0.05));
}
