#include "contensou/reduction/symmetries.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "constants.hpp"
#include "contensou/reduction/laws.hpp"

using namespace contensou::reduction;
using Catch::Matchers::Contains;
using Eigen::Matrix2d;
using Eigen::Vector2d;
using Verdict = PlanarSymmetries::Verdict;

namespace {

const Vector2d around{1, 1};

PlanarSymmetries symmetries(const PlanarField& field) { return find_symmetries(field, around); }

/// Checks that there is exactly one generator and that it is the given one.
void check_one(const PlanarSymmetries& found, double time, const Matrix2d& matrix,
               const Vector2d& shift = Vector2d::Zero()) {
  CAPTURE(found.singular_values, found.level, found.gap, found.residual);
  REQUIRE(found.verdict == Verdict::found);
  REQUIRE(found.generators.size() == 1);
  const Generator& x = found.generators.front();
  CAPTURE(x.time, x.matrix, x.shift);
  CHECK(x.time == Approx(time).epsilon(1e-13));
  CHECK((x.matrix - matrix).norm() < 1e-13);
  CHECK((x.shift - shift).norm() < 1e-13);
  CHECK(found.scaling);
  CHECK(found.residual < 1e-13);
  CHECK(found.gap > 1e5);
}

Matrix2d diagonal(double a, double b) { return Vector2d(a, b).asDiagonal(); }

}  // namespace

TEST_CASE("the symmetry of (2.6) is found for every law and body, and is the one that is typed in elsewhere",
          "[planar][symmetry]") {
  for (const Law& law : named_laws()) {
    for (double mu : {1e-4, 0.05, 0.8}) {
      for (const Inertia body : {homogeneous_ball, Inertia{1, 2}}) {
        CAPTURE(law.name(), mu, body.chi);
        check_one(symmetries(planar_field({law, mu, body})), 1, Matrix2d::Identity());
      }
    }
  }
}

TEST_CASE("the symmetry of (2.7): beta -> beta/a", "[planar][symmetry]") {
  for (const Law& law : paper_laws()) {
    const ReducedSystem system(law, 0.3);
    const PlanarSymmetries found = symmetries([&](const Vector2d& x) {
      const Rate rate = system.regularised_field({x[0], std::abs(x[1])});
      return Vector2d(rate.u, std::copysign(1, x[1]) * rate.v);
    });
    check_one(found, -1, Matrix2d::Identity());
  }
}

TEST_CASE("friction with a constant force, of another degree, about another point", "[planar][symmetry]") {
  const PlanarField friction = planar_field({PadeLaw{}, 0.3});
  check_one(symmetries([&](const Vector2d& x) -> Vector2d { return friction(x) + Vector2d(0, 0.4); }), 1,
            Matrix2d::Identity());
  check_one(symmetries([&](const Vector2d& x) -> Vector2d { return friction(x) / std::sqrt(x.norm()); }), 1,
            diagonal(2. / 3, 2. / 3));
  const Vector2d centre(0.25, -2);
  check_one(symmetries([&](const Vector2d& x) { return friction(x - centre); }), 0.5, diagonal(0.5, 0.5), -centre / 2);
}

TEST_CASE("the weights of a scaling are found", "[planar][symmetry]") {
  // Computed by hand: the scaling is u -> c u, v -> c^(2/3) v, t -> c^(1/3) t.
  check_one(symmetries([](const Vector2d& x) {
              const double r = std::sqrt(x[0] * x[0] + std::pow(std::abs(x[1]), 3));
              return Vector2d(-x[0] * std::pow(r, -1. / 3), -x[1] * std::pow(r, -1. / 3) - 0.3 * std::cbrt(r));
            }),
            1. / 3, diagonal(1, 2. / 3));
}

TEST_CASE("linear fields have several, and a plain scaling among them", "[planar][symmetry]") {
  for (const Matrix2d& m :
       {Matrix2d{{-0.3, -1}, {1, -0.3}}, Matrix2d{{-1, 0.2}, {0.1, -3}}, Matrix2d{{1, 2}, {2, -1}}}) {
    const PlanarSymmetries found = symmetries([m](const Vector2d& x) -> Vector2d { return m * x; });
    CAPTURE(m, found.singular_values, found.level);
    REQUIRE(found.generators.size() == 2);
    REQUIRE(found.scaling);
    CHECK(found.scaling->matrix == Matrix2d::Identity());
    CHECK(found.scaling->time == Approx(0).margin(1e-13));
    // The second generator commutes with m and is no multiple of the identity.
    const Matrix2d& other = found.generators[1].matrix;
    CHECK((other * m - m * other).norm() < 1e-11);
    CHECK((other - other.trace() / 2 * Matrix2d::Identity()).norm() > 0.1);
  }
}

TEST_CASE("a constant field has five", "[planar][symmetry]") {
  const PlanarSymmetries found = symmetries([](const Vector2d&) { return Vector2d(0, -1); });
  CAPTURE(found.singular_values, found.level);
  CHECK(found.generators.size() == 5);
  REQUIRE(found.scaling);
  CHECK(found.scaling->time == Approx(1).epsilon(1e-14));
  for (const Generator& g : found.generators) {
    CHECK((g.matrix * Vector2d(0, -1) - g.time * Vector2d(0, -1)).norm() < 1e-12);
  }
}

TEST_CASE("the elliptic law at r C^2 = 1 has a rotation, too", "[planar][symmetry]") {
  const double c = 0.5;
  const PlanarSymmetries found = symmetries(planar_field({EllipticLaw{c}, 2, {1, 1}}));
  CAPTURE(found.singular_values, found.level);
  CHECK(found.generators.size() == 2);
  CHECK(found.scaling->time == Approx(1).epsilon(1e-13));
}

TEST_CASE("no symmetry: viscous drag beside dry friction", "[planar][symmetry]") {
  const PlanarField friction = planar_field({PadeLaw{}, 0.3});
  for (double drag : {1.0, 1e-3, 1e-6}) {
    const PlanarSymmetries found =
        symmetries([&](const Vector2d& x) -> Vector2d { return friction(x) - Vector2d(0, drag * x[1]); });
    CAPTURE(drag, found.singular_values, found.level);
    CHECK(found.verdict == Verdict::none);
    CHECK(found.generators.empty());
    CHECK_FALSE(found.scaling);
    CHECK(found.gap > 1);
  }
}

TEST_CASE("a symmetry that is no scaling", "[planar][symmetry]") {
  // The symmetry of u' = 1.5 + sin 3 v, v' = cos 3 v is a translation along u.
  const PlanarSymmetries found =
      symmetries([](const Vector2d& x) { return Vector2d(1.5 + std::sin(3 * x[1]), std::cos(3 * x[1])); });
  CAPTURE(found.singular_values, found.level);
  REQUIRE(found.generators.size() == 1);
  CHECK(found.generators[0].shift == Vector2d(1, 0));
  CHECK_FALSE(found.scaling);
}

TEST_CASE("noise: what it hides is not claimed", "[planar][symmetry][noise]") {
  const PlanarField friction = planar_field({PadeLaw{}, 0.3});
  const auto noisy = [&](double size, double drag) {
    return symmetries([&, random = std::mt19937(7)](const Vector2d& x) mutable -> Vector2d {
      std::normal_distribution<double> normal(0, size);
      return friction(x) - Vector2d(0, drag * x[1]) + Vector2d(normal(random), normal(random));
    });
  };
  for (double size : {1e-12, 1e-9, 1e-7}) {
    const PlanarSymmetries found = noisy(size, 0), none = noisy(size, 1);
    CAPTURE(size, found.singular_values, found.level, none.singular_values, none.level);
    REQUIRE(found.verdict == Verdict::found);
    CHECK(found.scaling);
    CHECK(found.scaling->time == Approx(1).epsilon(1e3 * size));
    CHECK(none.verdict == Verdict::none);
  }
  CHECK(noisy(0.1, 0).verdict == Verdict::undecided);
  CHECK(noisy(0.1, 1).verdict == Verdict::undecided);
}

TEST_CASE("fields without values", "[planar][domain]") {
  const PlanarField friction = planar_field({PadeLaw{}, 0.3});
  CHECK_THROWS_WITH(symmetries([](const Vector2d&) -> Vector2d { throw std::runtime_error("no u here"); }),
                    Contains("0 of 128 points") && Contains("no u here"));
  CHECK_THROWS_WITH(symmetries([](const Vector2d&) { return Vector2d(not_a_number, 0); }),
                    Contains("the field has no value at ("));
  CHECK_THROWS_WITH(symmetries([](const Vector2d&) { return Vector2d(0, 0); }), Contains("the field is 0"));
  CHECK_THROWS_AS(find_symmetries(friction, Vector2d(0, 0)), std::domain_error);
  CHECK_THROWS_AS(find_symmetries(friction, Vector2d(1, infinity)), std::domain_error);
  // Values in a quarter of the plane suffice. A missing value is an exception (v < 0) or NaN (u < 0 < v).
  check_one(symmetries([&](const Vector2d& x) -> Vector2d {
              if (x[1] < 0) throw std::domain_error("v < 0");
              return friction(x) * (x[0] < 0 ? not_a_number : 1);
            }),
            1, Matrix2d::Identity());
}

TEST_CASE("a generator that does not hold across a kink says so", "[planar][symmetry]") {
  const auto sign = [](double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; };
  // Uniform acceleration in each quadrant: a shift of u is a symmetry within a quadrant, but not across its border.
  const PlanarSymmetries relay =
      symmetries([=](const Vector2d& x) { return Vector2d(x[1], -sign(x[0]) - 0.5 * sign(x[1])); });
  REQUIRE(relay.generators.size() == 2);
  CHECK(relay.generators[0].everywhere);
  CHECK(relay.generators[1].shift == Vector2d(1, 0));
  CHECK_FALSE(relay.generators[1].everywhere);
  // The field has a kink off the axes. Differences must not cross this kink either.
  const PlanarSymmetries slanted = symmetries([=](const Vector2d& x) {
    const double side = sign(x[0] - 2 * x[1]);
    return Vector2d(2 + side, 1 - 0.5 * side);
  });
  REQUIRE(slanted.scaling);
  CHECK(slanted.generators.front().everywhere);
  CHECK(std::ranges::any_of(slanted.generators, [](const Generator& x) { return !x.everywhere; }));
  // A symmetry of a smooth field holds everywhere. Cases: shifts, a spiral, another centre, weights; also with noise.
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 1e-9);
  const PlanarField fields[] = {
      [](const Vector2d& x) { return Vector2d(1.5 + std::sin(3 * x[1]), std::cos(3 * x[1])); },
      [](const Vector2d& x) { return Vector2d(-0.1 * x[0] - x[1], x[0] - 0.1 * x[1]); },
      [](const Vector2d& x) { return Vector2d(1 - x[0], -2 * (x[1] + 3)); },
      [](const Vector2d& x) { return Vector2d(x[1], -x[0] * x[0] * x[0]); },
      [](const Vector2d&) { return Vector2d(1, 2); },
      [&](const Vector2d& x) -> Vector2d { return -x / x.norm() + Vector2d(noise(random), noise(random)); },
  };
  for (const PlanarField& field : fields) {
    const PlanarSymmetries found = symmetries(field);
    CAPTURE(&field - fields, found.level);
    CHECK_FALSE(found.generators.empty());
    for (const Generator& x : found.generators) {
      CAPTURE(x.time, x.matrix, x.shift);
      CHECK(x.everywhere);
    }
  }
}

TEST_CASE("a scaling that does not hold across jumps is no scaling of the field", "[planar][symmetry]") {
  const auto sign = [](double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; };
  // Fields: friction with a jump along a line, on a circle, beside the origin; a relay about (0, 0) and (0, 1) at once.
  const PlanarField fields[] = {
      [=](const Vector2d& x) -> Vector2d { return -x / x.norm() - Vector2d(0, 0.5 * sign(x[0] - 0.6)); },
      [=](const Vector2d& x) -> Vector2d { return -x / x.norm() * (2 + sign(x.norm() - 1)); },
      [=](const Vector2d& x) -> Vector2d { return -x / x.norm() - Vector2d(0, x[0] > 0.5 ? 0.2 : 0); },
      [=](const Vector2d& x) { return Vector2d(x[1], -sign(x[0]) - 0.3 * sign(x[1] - 1)); },
  };
  for (const PlanarField& field : fields) {
    const PlanarSymmetries found = symmetries(field);
    CAPTURE(&field - fields, found.singular_values, found.level);
    CHECK_FALSE(found.scaling);
    CHECK(std::ranges::any_of(found.generators, [](const Generator& x) { return !x.everywhere; }));
  }
}

TEST_CASE("of several scalings within sectors the one that leaves the jumps where they are", "[planar][symmetry]") {
  const auto sign = [](double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; };
  const auto relay = [=](const Vector2d& x) { return Vector2d(x[1], -sign(x[0]) - 0.3 * sign(x[1])); };
  for (const Vector2d& centre : {Vector2d(1, 0), Vector2d(-0.3, 0.7)}) {
    const PlanarSymmetries found = symmetries([&](const Vector2d& x) { return relay(x - centre); });
    CAPTURE(centre, found.singular_values, found.level);
    REQUIRE(found.scaling);
    const Generator& x = *found.scaling;
    CHECK(x.everywhere);
    CHECK((x.centre() - centre).norm() < 1e-12);
    CHECK((x.matrix - 2 * x.time * diagonal(1, 0.5)).norm() < 1e-12);
  }
  // A field that is uniform on both sides of a line: every point of the line may be the centre.
  const PlanarSymmetries slanted = symmetries([=](const Vector2d& x) {
    const double side = sign(x[0] - 2 * x[1] + 0.4);
    return Vector2d(2 + side, 1 - 0.5 * side);
  });
  REQUIRE(slanted.scaling);
  const Vector2d centre = slanted.scaling->centre();
  CHECK(centre[0] - 2 * centre[1] == Approx(-0.4).epsilon(1e-12));
}

TEST_CASE("a translation with a rate is no scaling", "[planar][symmetry]") {
  // The only symmetry of u' = exp(u), v' = exp(v) is u -> u + s, v -> v + s, t -> exp(-s) t.
  const PlanarSymmetries found =
      find_symmetries([](const Vector2d& x) { return Vector2d(std::exp(x[0]), std::exp(x[1])); }, {2, 1});
  REQUIRE(found.generators.size() == 1);
  CHECK(found.generators[0].time == Approx(-1).epsilon(1e-9));
  CHECK_FALSE(found.scaling);
}

TEST_CASE("symmetries are the same in all units", "[planar][symmetry]") {
  const Vector2d centre(3, -1);
  for (double unit : {1e-155, 1.0, 1e160}) {
    CAPTURE(unit);
    check_one(find_symmetries(planar_field({PadeLaw{}, 0.3}), {unit, unit}), 1, Matrix2d::Identity());
    const PlanarSymmetries found = find_symmetries(
        [&](const Vector2d& x) {
          const Vector2d y = x / unit - centre;
          return Vector2d(-y / std::sqrt(y.norm()));
        },
        {unit, 2 * unit});
    REQUIRE(found.scaling);
    CHECK((found.scaling->centre() / unit - centre).norm() < 1e-12);
  }
}
