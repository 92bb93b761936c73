// Fields with a multiple zero, a kink or a jump of known kind. Each is a normal form in coordinates (X, Y) that are
// random quadratic functions of (u, v). The tests run with and without exact Jacobians, in units from 1e-6 to 1e6.
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/planar_reduction.hpp"
#include "planar/dual.hpp"

// A namespace of its own, because other tests have functions of these names.
namespace contensou::reduction::multiple_zeros {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using tests::Dual;

namespace {

double sign_of(Dual a) { return a.value > 0 ? 1 : a.value < 0 ? -1 : 0; }
Dual abs(Dual a) { return sign_of(a) * a; }
Dual sign(Dual a) { return sign_of(a); }
Dual power(Dual a, int n) { return n == 0 ? Dual(1) : a * power(a, n - 1); }
Dual hypot(Dual a, Dual b) { return sqrt(a * a + b * b); }

using Pair = std::pair<Dual, Dual>;
using Formulas = std::function<Pair(Dual, Dual)>;

/// Returns the field S f(u/S, v/S).
SmoothField field_of(const Formulas& f, double size, bool with_jacobian) {
  const auto at = [=](Dual u, Dual v) {
    const auto [a, b] = f(u / size, v / size);
    return Pair(size * a, size * b);
  };
  SmoothField field{[=](const Vector2d& x) {
    const auto [a, b] = at(x[0], x[1]);
    return Vector2d(a.value, b.value);
  }};
  if (with_jacobian) {
    field.jacobian = [=](const Vector2d& x) {
      const auto [a, b] = at({x[0], 1, 0}, {x[1], 0, 1});
      return (Matrix2d() << a.by_u, a.by_v, b.by_u, b.by_v).finished();
    };
  }
  return field;
}

/// Expected equilibrium.
struct Expected {
  double u, v;
  std::string_view kind;
  std::optional<int> index;
};

struct Case {
  std::string name;
  Formulas formulas;
  std::vector<Expected> points;
};

void check(const Case& given, double size, bool with_jacobian, const Vector2d& low, const Vector2d& high,
           double accurate) {
  CAPTURE(given.name, size, with_jacobian);
  const Equilibria found = find_equilibria(field_of(given.formulas, size, with_jacobian), size * low, size * high);
  REQUIRE(found.points.size() == given.points.size());
  for (std::size_t i = 0; i < given.points.size(); ++i) {
    const Equilibrium& point = found.points[i];
    const Expected& expected = given.points[i];
    CAPTURE(point.x[0], point.x[1], point.kind);
    CHECK((point.x / size - Vector2d(expected.u, expected.v)).norm() <= accurate);
    CHECK(point.kind == expected.kind);
    CHECK(point.index == expected.index);
    CHECK(point.eigenvalues.has_value() == (expected.kind != "not smooth"));
  }
}

/// A normal form with the kind of its zero X = Y = 0; without a kind the zero is none, or is not isolated.
struct Normal {
  std::string name;
  Formulas formulas;
  std::string_view kind;
  std::optional<int> index;
};

std::vector<Normal> normal_forms() {
  return {
      {"saddle-node", [](Dual x, Dual y) { return Pair(x * x, -y); }, "saddle-node", 0},
      {"saddle-node of order 4", [](Dual x, Dual y) { return Pair(-power(x, 4), y + x * y); }, "saddle-node", 0},
      {"stable node", [](Dual x, Dual y) { return Pair(-power(x, 3), -2 * y); }, "stable node", 1},
      {"unstable node", [](Dual x, Dual y) { return Pair(power(x, 3) + x * y * y, y); }, "unstable node", 1},
      {"saddle", [](Dual x, Dual y) { return Pair(power(x, 3), -y); }, "saddle", -1},
      {"saddle of order 5", [](Dual x, Dual y) { return Pair(-power(x, 5), y); }, "saddle", -1},
      {"cusp", [](Dual x, Dual y) { return Pair(y, x * x + 0.7 * x * y); }, "cusp", 0},
      {"dipole", [](Dual x, Dual y) { return Pair(x * x - y * y, 2 * x * y); }, "mixed", 2},
      {"cusp of squares", [](Dual x, Dual y) { return Pair(y * y, x * x); }, "cusp", 0},
      {"node of cubes", [](Dual x, Dual y) { return Pair(power(x, 3), power(y, 3)); }, "unstable node", 1},
      {"nilpotent focus", [](Dual x, Dual y) { return Pair(y, x * x * y - power(x, 5)); }, "unstable focus", 1},
      {"stable focus", [](Dual x, Dual y) { return Pair(y, -2 * x * x * y - power(x, 5)); }, "stable focus", 1},
      {"nilpotent saddle", [](Dual x, Dual y) { return Pair(y, power(x, 3)); }, "saddle", -1},
      {"nilpotent node", [](Dual x, Dual y) { return Pair(y, -4 * x * x * y - power(x, 5)); }, "stable node", 1},
      {"elliptic sector", [](Dual x, Dual y) { return Pair(y, -3 * x * y - power(x, 3)); }, "mixed", 1},
      {"weak focus", [](Dual x, Dual y) { return Pair(y, -x * x * y - power(x, 3)); }, "center or focus", 1},
      {"nilpotent center", [](Dual x, Dual y) { return Pair(y, -power(x, 3)); }, "center or focus", 1},
      {"turning", [](Dual x, Dual y) { return Pair(y, -x); }, "center or focus", 1},
      {"two edges", [](Dual x, Dual y) { return Pair(y, power(x, 4) - x * y); }, "degenerate", 0},
      {"line of zeros", [](Dual x, Dual y) { return Pair(x * y, x * (1 + y)); }, "", {}},
      {"double line of zeros", [](Dual x, Dual y) { return Pair(x * x * (1 + y * y), x * x); }, "", {}},
      {"kink on a line of zeros", [](Dual x, Dual y) { return Pair(abs(x), x * (1 + y)); }, "", {}},
      {"lines of zeros", [](Dual x, Dual y) { return Pair(x * cos(y / x), y * cos(y / x)); }, "", {}},
      {"kink", [](Dual x, Dual y) { return Pair(y - 1.81 * abs(x), -x); }, "not smooth", 1},
      {"kinks", [](Dual x, Dual y) { return Pair(2 * x + abs(y), 2 * y - abs(x)); }, "not smooth", 1},
      {"direction", [](Dual x, Dual y) { return Pair(x * cos(y / hypot(x, y)), y * cos(x / hypot(x, y))); }, "", {}},
      {"jump", [](Dual x, Dual y) { return Pair(y, -x - 0.2 * sign(y)); }, "", {}},
  };
}

}  // namespace

TEST_CASE("random fields with multiple zeros have the kinds by construction", "[planar]") {
  std::mt19937_64 random(20261127);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const std::vector<Normal> forms = normal_forms();
  constexpr std::size_t fields = 216;
  for (std::size_t i = 0; i < fields; ++i) {
    const Normal& form = forms[i % forms.size()];
    const double a = between(0, 7), b = between(0, 7), wide = between(0.6, 1.7), narrow = between(0.6, 1.7);
    const double side = between(0, 1) < 0.5 ? -1 : 1, rate = between(0.3, 3);
    const Matrix2d m = (Matrix2d() << std::cos(a), -std::sin(a), std::sin(a), std::cos(a)).finished() *
                       Vector2d(wide, side * narrow).asDiagonal() *
                       (Matrix2d() << std::cos(b), -std::sin(b), std::sin(b), std::cos(b)).finished();
    double bend[6];
    for (double& each : bend) each = between(-0.08, 0.08);
    // Only at a place without rounding the field has no value at the zero.
    const double aside = form.name == "direction" ? 0 : 0.5;
    const double u = aside * between(-1, 1), v = aside * between(-1, 1);
    const Formulas formulas = [=](Dual x, Dual y) {
      const Dual p = x - u, q = y - v;
      const Dual first = m(0, 0) * p + m(0, 1) * q + bend[0] * p * p + bend[1] * p * q + bend[2] * q * q;
      const Dual second = m(1, 0) * p + m(1, 1) * q + bend[3] * p * p + bend[4] * p * q + bend[5] * q * q;
      const Dual d00 = m(0, 0) + 2 * bend[0] * p + bend[1] * q, d01 = m(0, 1) + bend[1] * p + 2 * bend[2] * q;
      const Dual d10 = m(1, 0) + 2 * bend[3] * p + bend[4] * q, d11 = m(1, 1) + bend[4] * p + 2 * bend[5] * q;
      const auto [f, g] = form.formulas(first, second);
      const Dual determinant = d00 * d11 - d01 * d10;
      return Pair(rate * (d11 * f - d01 * g) / determinant, rate * (d00 * g - d10 * f) / determinant);
    };
    Case expected{form.name, formulas, {}};
    if (!form.kind.empty()) expected.points = {{u, v, form.kind, form.index}};
    check(expected, std::pow(10, static_cast<int>(i % 13) - 6), i % 2 == 0, {-1, -1}, {1, 1}, 1e-8);
  }
}

TEST_CASE("multiple zeros, kinks and jumps at simple places, in every unit", "[planar]") {
  const double third = std::acos(-1) / 5;
  const std::vector<Case> cases{
      {"v, u^2", [](Dual u, Dual v) { return Pair(v, u * u); }, {{0, 0, "cusp", 0}}},
      {"v, u^2 (1-u)",
       [](Dual u, Dual v) { return Pair(v, u * u * (1 - u)); },
       {{0, 0, "cusp", 0}, {1, 0, "center", 1}}},
      {"v, (u-0.3)^2 (u+0.7)",
       [](Dual u, Dual v) { return Pair(v, power(u - 0.3, 2) * (u + 0.7)); },
       {{-0.7, 0, "saddle", -1}, {0.3, 0, "cusp", 0}}},
      {"1 - cos",
       [](Dual u, Dual v) { return Pair(v, 1 - cos(10 * u)); },
       {{-2 * third, 0, "cusp", 0},
        {-third, 0, "cusp", 0},
        {0, 0, "cusp", 0},
        {third, 0, "cusp", 0},
        {2 * third, 0, "cusp", 0}}},
      {"Bogdanov-Takens", [](Dual u, Dual v) { return Pair(v, -u * u - u * v); }, {{0, 0, "cusp", 0}}},
      {"dipole", [](Dual u, Dual v) { return Pair(u * u - v * v, 2 * u * v); }, {{0, 0, "mixed", 2}}},
      {"v^2, u^2", [](Dual u, Dual v) { return Pair(v * v, u * u); }, {{0, 0, "cusp", 0}}},
      {"-u v, u - v^2", [](Dual u, Dual v) { return Pair(-u * v, u - v * v); }, {{0, 0, "mixed", 1}}},
      {"v, -u^5 + u^2 v",
       [](Dual u, Dual v) { return Pair(v, u * u * v - power(u, 5)); },
       {{0, 0, "unstable focus", 1}}},
      {"v, u^4 - u v", [](Dual u, Dual v) { return Pair(v, power(u, 4) - u * v); }, {{0, 0, "degenerate", 0}}},
      {"v, -u^3 - u^2 v",
       [](Dual u, Dual v) { return Pair(v, -power(u, 3) - u * u * v); },
       {{0, 0, "center or focus", 1}}},
      {"v, -u^3", [](Dual u, Dual v) { return Pair(v, -power(u, 3)); }, {{0, 0, "center", 1}}},
      {"u^2, -v", [](Dual u, Dual v) { return Pair(u * u, -v); }, {{0, 0, "saddle-node", 0}}},
      {"u^2 (u - 0.01), -v",
       [](Dual u, Dual v) { return Pair(u * u * (u - 0.01), -v); },
       {{0, 0, "saddle-node", 0}, {0.01, 0, "saddle", -1}}},
      {"the line u = 0", [](Dual u, Dual v) { return Pair(sin(u) * sin(v), cos(u) - 1); }, {}},
      {"dry friction", [](Dual u, Dual v) { return Pair(v, -u - 0.2 * sign(v)); }, {{0, 0, "not smooth", {}}}},
      {"kink", [](Dual u, Dual v) { return Pair(v - 1.81 * abs(u), -u); }, {{0, 0, "not smooth", 1}}},
      {"linear parts agree", [](Dual u, Dual v) { return Pair(v, -u - u * abs(u)); }, {{0, 0, "center", 1}}},
      {"no value", [](Dual u, Dual v) { return Pair(v, 0.75 * v * v / u - 0.21 * u); }, {}},
      {"0/0", [](Dual u, Dual v) { return Pair(u * v / hypot(u, v), -u * u / hypot(u, v)); }, {}},
      {"circles",
       [](Dual u, Dual v) {
         const Dual rate = hypot(u, v) / (abs(u) + abs(v));
         return Pair(v * rate, -u * rate);
       },
       {}},
      {"y/x", [](Dual u, Dual v) { return Pair(u * cos(v / u), v * cos(v / u)); }, {}},
  };
  for (const Case& each : cases) {
    for (int power_of_ten = -6; power_of_ten <= 6; power_of_ten += 3) {
      for (const bool with_jacobian : {true, false}) {
        check(each, std::pow(10, power_of_ten), with_jacobian, {-1.75, -1.75}, {1.75, 1.75}, 1e-12);
      }
    }
  }
}

// The motion along the flat direction is s (x-a)^m or s exp(-1/(x-a)^2), so exact knowledge is the sign of s and the
// parity of m. Rounding hides the place of a zero in an expanded power, in turned coordinates, and without a Jacobian.
TEST_CASE("zeros of high order have the kind by construction, or none", "[planar]") {
  std::mt19937_64 random(20261128);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  enum class Writing { power, turned, expanded, flat };
  int found_known = 0, all_known = 0;
  constexpr int fields = 80;
  for (int i = 0; i < fields; ++i) {
    const int m = 8 + static_cast<int>(random() % 13), cell = static_cast<int>(random() % 3);
    const Writing writing = static_cast<Writing>(i % 4);
    const bool nilpotent = random() % 3 == 0, odd = writing != Writing::flat && m % 2 == 1;
    const double s = between(0.3, 2) * (random() % 2 == 0 ? 1 : -1), r = between(0.3, 2) * (random() % 2 == 0 ? 1 : -1);
    const double a = cell == 0 ? 0 : cell == 1 ? 0.25 : between(-0.5, 0.5), b = cell == 0 ? 0 : between(-0.5, 0.5);
    const double c = between(-0.3, 0.3), d = between(-0.3, 0.3), bend = between(-0.5, 0.5), turn = between(0.2, 1.3);
    const auto along = [=](Dual x) {
      if (writing == Writing::flat) {
        const double p = x.value - a, value = std::exp(-1 / (p * p));
        return p == 0 ? Dual(0) : (x - a).chain(value, 2 * value / (p * p * p));
      }
      if (writing != Writing::expanded) return power(x - a, m);
      Dual sum = 0;
      double binomial = 1;
      for (int k = 0; k <= m; ++k) {
        sum = sum + binomial * power(-a, m - k) * power(x, k);
        binomial = binomial * (m - k) / (k + 1);
      }
      return sum;
    };
    const Formulas straight = [=](Dual x, Dual y) {
      const Dual p = x - a, q = y - b, slow = s * along(x) * (1 + c * p + d * q);
      return nilpotent ? Pair(q, slow) : Pair(slow, r * q + bend * p * p);
    };
    // Turned coordinates have their zero at (a, b), too.
    const Dual e = std::cos(turn), f = std::sin(turn);
    const Formulas turned = [=](Dual x, Dual y) {
      const Dual p = x - a, q = y - b;
      const auto [first, second] = straight(a + (e * p + f * q), b + (e * q - f * p));
      return Pair(e * first - f * second, f * first + e * second);
    };
    const bool with_jacobian = random() % 2 == 0;
    const double size = std::pow(10, static_cast<int>(random() % 7) - 3);
    const SmoothField field = field_of(writing == Writing::turned ? turned : straight, size, with_jacobian);
    const Equilibria found = find_equilibria(field, Vector2d(-size, -size), Vector2d(size, size));
    CAPTURE(i, m, static_cast<int>(writing), nilpotent, s, r, a, b, c, d, bend, turn, with_jacobian, size);
    CHECK_FALSE(found.on_curve);
    CHECK((found.points.size() == 1 || !found.complete));
    CHECK(found.points.size() <= 1);
    const bool known = writing == Writing::power && with_jacobian;
    all_known += known;
    for (const Equilibrium& point : found.points) {
      CAPTURE(point.x[0] / size, point.x[1] / size, point.kind, point.index.value_or(9));
      CHECK((point.x / size - Vector2d(a, b)).norm() < 1e-5);
      const std::string_view node = r < 0 ? "stable node" : "unstable node";
      const int index = !odd ? 0 : (nilpotent ? -s : s * r) > 0 ? 1 : -1;
      if (point.index) CHECK(*point.index == index);
      if (nilpotent && index == 1) {
        CHECK((point.kind == "degenerate" || point.kind.starts_with("center")));
      } else if (point.kind != "degenerate") {
        CHECK(point.kind == (index == -1 ? "saddle" : index == 1 ? node : nilpotent ? "cusp" : "saddle-node"));
      }
      found_known += known && found.complete && (nilpotent || point.kind != "degenerate");
    }
  }
  CHECK(found_known == all_known);
}

TEST_CASE("flat zeros beside each other and in two flat components have no wrong place or kind", "[planar]") {
  std::mt19937_64 random(1);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int i = 0; i < 120; ++i) {
    const int m = 3 + static_cast<int>(random() % 15), n = 1 + static_cast<int>(random() % 12);
    const double s = between(0.3, 2) * (random() % 2 == 0 ? 1 : -1), r = between(0.3, 2) * (random() % 2 == 0 ? 1 : -1);
    const double a = between(-0.6, 0.6), b = between(-0.6, 0.6), a2 = a + std::pow(10, between(-1.3, 0));
    const bool two = i % 2 == 0;
    const Formulas formulas = [=](Dual x, Dual y) {
      return two ? Pair(s * power(x - a, m) * power(x - a2, n), r * (y - b))
                 : Pair(s * power(x - a, m), r * power(y - b, n));
    };
    const Vector2d low(a - between(0.1, 1), b - between(0.1, 1)), high(a + between(0.1, 1), b + between(0.1, 1));
    const Equilibria found = find_equilibria(field_of(formulas, 1, true), low, high);
    CAPTURE(i, m, n, s, r, a, b, a2, two);
    CHECK_FALSE(found.on_curve);
    const std::size_t all = two && a2 < high[0] ? 2 : 1;
    CHECK((found.points.size() == all || (found.points.size() < all && !found.complete)));
    for (const Equilibrium& point : found.points) {
      CAPTURE(point.x[0], point.x[1], point.kind);
      const bool second = two && std::abs(point.x[0] - a2) < std::abs(point.x[0] - a);
      CHECK((point.x - Vector2d(second ? a2 : a, b)).norm() < 1e-5);
      const double factor = !two ? 1 : std::pow(second ? a2 - a : a - a2, second ? m : n);
      const bool even = (second ? n : m) % 2 == 0 || (!two && n % 2 == 0);
      const int index = even ? 0 : s * r * factor > 0 ? 1 : -1;
      if (point.index) CHECK(*point.index == index);
      if ((!two && n > 1) || point.kind == "degenerate") continue;
      const std::string_view node = r < 0 ? "stable node" : "unstable node";
      CHECK(point.kind == (even ? "saddle-node" : index < 0 ? "saddle" : node));
    }
  }
}

// The reference follows a motion for one turn by Runge-Kutta steps, in coordinates in which the linear part is a
// rotation. The library gets the field in other coordinates.
TEST_CASE("the first Lyapunov coefficient decides between the foci", "[planar]") {
  std::mt19937_64 random(20261129);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int i = 0; i < 60; ++i) {
    double terms[2][7];
    for (auto& of_component : terms) {
      for (double& each : of_component) each = between(-1, 1);
    }
    const auto nonlinear = [=](int c, Dual x, Dual y) {
      const auto& [a, b, d, e, f, g, h] = terms[c];
      return x * x * a + x * y * b + y * y * d + power(x, 3) * e + x * x * y * f + x * y * y * g + power(y, 3) * h;
    };
    const Formulas plain = [=](Dual x, Dual y) { return Pair(nonlinear(0, x, y) - y, nonlinear(1, x, y) + x); };
    // The trace stays 0 without rounding: axes are scaled by a power of 2 and exchanged.
    const double wide = std::pow(2, static_cast<int>(random() % 3) - 1);
    const bool exchanged = i % 2 == 0;
    const Formulas scaled = [=](Dual u, Dual v) {
      const auto [a, b] = exchanged ? plain(v * wide, u) : plain(u * wide, v);
      return exchanged ? Pair(b, a / wide) : Pair(a / wide, b);
    };
    const auto rate = [&](const Vector2d& x) {
      const auto [a, b] = plain(x[0], x[1]);
      return Vector2d(a.value, b.value);
    };
    constexpr double radius = 0.01, step = 2e-3;
    Vector2d x(radius, 0), before = x;
    for (double t = 0; t < 3 || !(before[1] < 0 && x[1] >= 0); t += step) {
      before = x;
      const Vector2d k1 = rate(x), k2 = rate(x + step / 2 * k1), k3 = rate(x + step / 2 * k2), k4 = rate(x + step * k3);
      x += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    const double grown = (before[0] * x[1] - x[0] * before[1]) / (x[1] - before[1]) / radius - 1;
    CAPTURE(i, grown, wide, exchanged);
    for (const double size : {1e-3, 1., 1e3}) {
      const Vector2d corner = Vector2d::Constant(0.1 * size);
      const Equilibria found = find_equilibria(field_of(scaled, size, true), -corner, corner);
      REQUIRE(found.points.size() == 1);
      if (std::abs(grown) > 1e-5) CHECK(found.points[0].kind == (grown < 0 ? "stable focus" : "unstable focus"));
    }
  }
  // Damping that is smaller than rounding is not 0, and cubic terms do not outweigh it at the point.
  const Formulas damped = [](Dual u, Dual v) { return Pair(v, 1e-17 * v - u - power(v, 3)); };
  const auto tiny = find_equilibria(field_of(damped, 1, true), Vector2d(-1, -1), Vector2d(1, 1));
  REQUIRE(tiny.points.size() == 1);
  CHECK(tiny.points[0].kind == "center or focus");
}

TEST_CASE("the search says how far its list goes", "[planar]") {
  const auto count = [](double start) {
    const Formulas pendulum = [](Dual u, Dual v) { return Pair(v, -sin(u)); };
    return find_equilibria(field_of(pendulum, 1, true), Vector2d(start, 0.1));
  };
  for (const double start : {20., 60.}) {
    const Equilibria found = count(start);
    CHECK(found.points.size() == 1 + 2 * static_cast<std::size_t>(2.5 * start / std::acos(-1)));
    CHECK(found.complete);
    CHECK(found.high == Vector2d(2.5 * start, 2.5 * start));
  }
  CHECK_FALSE(count(600).complete);
  const Formulas rabbits = [](Dual x, Dual y) { return Pair((1 - x - y) * x, (4 - 7 * x - 3 * y) * y); };
  const Equilibria four = find_equilibria(field_of(rabbits, 1, true), Vector2d(1, 0.5));
  CHECK(four.points.size() == 4);
  CHECK(four.complete);
  const Formulas line = [](Dual u, Dual v) { return Pair(-u * v, u * v - 0.5 * v); };
  CHECK(find_equilibria(field_of(line, 1, true), Vector2d(1, 0.5)).complete);
}

}  // namespace contensou::reduction::multiple_zeros
