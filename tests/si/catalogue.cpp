#include "contensou/si/catalogue.hpp"

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/experiment.hpp"
#include "contensou/si/scaling.hpp"

using namespace contensou::si;

TEST_CASE("patches of the built-in balls", "[table]") {
  struct Row {
    std::string name;
    double patch;  // m
    double mu;
  };
  // Values of the theory, rounded to three digits: from Hertz's formula and from the spin deceleration.
  const std::vector<Row> rows{{"pool", 2.83e-3, 0.099},     {"steel", 3.51e-5, 0.0035},
                              {"bowling", 1.33e-3, 0.0123}, {"rubber", 1.71e-3, 0.0685},
                              {"gel", 7.24e-3, 0.241},      {"basketball", 5.84e-3, 0.0483},
                              {"puck", 0.0381, 1},          {"curling-stone", 0.065, 0.448}};
  REQUIRE(catalogue().size() == rows.size());
  const contensou::reduction::HertzLaw law;
  for (const auto& [name, patch, mu] : rows) {
    INFO(name);
    REQUIRE(find_ball(name) != nullptr);
    const Experiment& experiment = find_ball(name)->experiment;
    CHECK(patch_radius_of(experiment, law) == Approx(patch).epsilon(2e-3));
    CHECK(patch_ratio(experiment, law) == Approx(mu).epsilon(6e-3));
    CHECK_NOTHROW(require_experiment(experiment));
    CHECK_FALSE(find_ball(name)->sources.empty());
  }
  CHECK(find_ball("hockey") == nullptr);
}

TEST_CASE("effective modulus of two equal bodies, beside a rigid plane, and of the bowling ball", "[limit]") {
  CHECK(effective_modulus({.youngs_modulus = {2e9, 2e9}, .poisson_ratio = {0.5, 0.5}}) ==
        Approx(2e9 / (2 * 0.75)).epsilon(1e-15));
  CHECK(effective_modulus({.youngs_modulus = {2e6, 1e300}, .poisson_ratio = {0.49, 0.3}}) ==
        Approx(2e6 / (1 - 0.49 * 0.49)).epsilon(1e-15));
  CHECK(effective_modulus(std::get<HertzModuli>(find_ball("bowling")->experiment.contact.patch)) ==
        Approx(2.3e9).epsilon(1e-15));
}

TEST_CASE("the Hertz radius grows with the cube root of load and radius", "[symmetry]") {
  const HertzModuli moduli{.youngs_modulus = {2.1e11, 7.0e10}, .poisson_ratio = {0.3, 0.22}};
  const double patch = hertz_patch_radius(0.3, 0.01, moduli);
  CHECK(hertz_patch_radius(8 * 0.3, 0.01, moduli) == Approx(2 * patch).epsilon(1e-15));
  CHECK(hertz_patch_radius(0.3, 8 * 0.01, moduli) == Approx(2 * patch).epsilon(1e-15));
}

TEST_CASE("of two spheres Hertz's patch is that of their relative curvature", "[table]") {
  const HertzModuli plane{.youngs_modulus = {2.1e11, 7.0e10}, .poisson_ratio = {0.3, 0.22}};
  HertzModuli sphere = plane, dish = plane;
  sphere.counter_radius = 0.01;  // radius of the ball, so R' is half of it
  dish.counter_radius = -0.03;   // 1/R' = 1/0.01 - 1/0.03
  CHECK(hertz_patch_radius(0.3, 0.01, sphere) == Approx(hertz_patch_radius(0.3, 0.005, plane)).epsilon(1e-15));
  CHECK(hertz_patch_radius(0.3, 0.01, dish) == Approx(hertz_patch_radius(0.3, 0.015, plane)).epsilon(1e-15));
  // Johnson, Contact Mechanics (4.22): a^3 = 3 N R'/(4 E*).
  CHECK(std::pow(hertz_patch_radius(0.3, 0.01, dish), 3) == Approx(0.75 * 0.3 * 0.015 / effective_modulus(plane)));
  for (double tight : {-0.01, -0.009, -1e-3}) {
    dish.counter_radius = tight;
    CHECK_THROWS_WITH(hertz_patch_radius(0.3, 0.01, dish),
                      Catch::Matchers::Contains("a dish no wider than the ball of radius 0.01 m"));
  }
}

TEST_CASE("a curling stone's spin dies out as measured", "[table]") {
  // DigitalCurling (simulator_fcv1.cpp) contains two fits: friction 0.00200985/(v + 0.06385782) + 0.00626286, and
  // domega/dt = -0.025/v. The coupled friction of a thin band has no parameter for domega/dt.
  const Experiment& stone = find_ball("curling-stone")->experiment;
  const contensou::reduction::Law ring = *contensou::reduction::find_law(law_of(stone));
  CHECK(ring.name() == "ring");
  const double eps = patch_radius_of(stone, ring), R = stone.ball.radius, spin = spin_at_start(stone);
  for (double v : {0.5, 1.0, 2.0, 2.5}) {
    const double friction = 0.00200985 / (v + 0.06385782) + 0.00626286;
    const double moment = ring(contensou::reduction::Slip{v, eps * spin}).moment;
    const double deceleration =
        stone.ball.body.inertia.gamma * friction * stone.environment.gravity * eps * moment / (R * R);
    CAPTURE(v);
    CHECK(0.025 == Approx(deceleration * v).epsilon(0.2));
  }
}
