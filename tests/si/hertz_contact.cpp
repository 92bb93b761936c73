#include "contensou/si/hertz_contact.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace contensou::si;

TEST_CASE("effective modulus of two equal bodies", "[limit]") {
  const HertzModuli equal{.youngs_modulus = {2e9, 2e9}, .poisson_ratio = {0.5, 0.5}};
  CHECK(effective_modulus(equal) == Approx(2e9 / (2 * 0.75)).epsilon(1e-15));
}

TEST_CASE("a rigid plane leaves the ball's own modulus", "[limit]") {
  const HertzModuli rigid_plane{.youngs_modulus = {2e6, 1e300}, .poisson_ratio = {0.49, 0.3}};
  CHECK(effective_modulus(rigid_plane) == Approx(2e6 / (1 - 0.49 * 0.49)).epsilon(1e-15));
}

TEST_CASE("the Hertz radius grows with the cube root of load and radius", "[symmetry]") {
  const HertzModuli moduli{.youngs_modulus = {2.1e11, 7.0e10}, .poisson_ratio = {0.3, 0.22}};
  const double patch = hertz_patch_radius(0.3, 0.01, moduli);
  CHECK(hertz_patch_radius(8 * 0.3, 0.01, moduli) == Approx(2 * patch).epsilon(1e-15));
  CHECK(hertz_patch_radius(0.3, 8 * 0.01, moduli) == Approx(2 * patch).epsilon(1e-15));
}

TEST_CASE("the patch of a spin deceleration makes the ball slow down at that rate", "[route]") {
  const double R = 0.03, f = 0.2, g = 9.8, alpha = 7;
  const double moment_at_rest = 3 * std::numbers::pi / 16;
  const double patch = patch_radius_of_deceleration(R, alpha, f, g, moment_at_rest);
  CHECK(2.5 * patch * f * g * moment_at_rest / (R * R) == Approx(alpha).epsilon(1e-14));
}
