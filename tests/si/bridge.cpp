#include "contensou/si/bridge.hpp"

#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/si/catalogue.hpp"

using namespace contensou;

namespace {

si::Shot pool() { return si::find_ball("pool")->shot; }

double stop_in_seconds(const si::Shot& shot, const reduction::Law& law) {
  return si::seconds(shot, reduction::Flow(si::reduced_system(shot, law)).stop_time(si::reduced_start(shot)).tau);
}

}  // namespace

TEST_CASE("u is R omega_z with its sign, v the slip, mu the patch over the radius", "[table]") {
  si::Shot shot = pool();
  shot.contact.patch = si::PatchRadius{0.0028575};
  shot.start = si::SlipAndSpin{.slip = 2, .spin = -10};
  CHECK(si::patch_ratio(shot, reduction::PadeLaw{}) == Approx(0.1).epsilon(1e-15));
  CHECK(si::reduced_start(shot).u == -0.28575);
  CHECK(si::reduced_start(shot).v == 2);
}

TEST_CASE("a ball that only slides takes 2 v0/(7 f g)", "[limit]") {
  si::Shot shot = pool();
  shot.start = si::SlipAndSpin{.slip = 1.7, .spin = 0};
  const double expected = 2 * 1.7 / (7 * shot.contact.friction * shot.environment.gravity);
  CHECK(stop_in_seconds(shot, reduction::PadeLaw{}) == Approx(expected).epsilon(1e-14));
  CHECK(stop_in_seconds(shot, reduction::HertzLaw{}) == Approx(expected).epsilon(1e-14));
}

TEST_CASE("a ball that only spins takes omega_z/alpha", "[limit]") {
  si::Shot shot = pool();
  shot.contact.patch = si::SpinDeceleration{8};
  shot.start = si::SlipAndSpin{.slip = 0, .spin = -100};
  for (const reduction::Law& law : reduction::named_laws()) {
    CHECK(stop_in_seconds(shot, law) == Approx(100.0 / 8).epsilon(1e-14));
  }
}

TEST_CASE("seconds keep 0 and infinity where f g underflows", "[limit]") {
  si::Shot shot = pool();
  shot.contact.friction = 1e-200;
  shot.environment.gravity = 1e-200;
  CHECK(si::seconds(shot, 0) == 0);
  CHECK(std::isinf(si::seconds(shot, 1)));
}

TEST_CASE("a system of an impossible ball is refused", "[limit]") {
  si::Shot shot = pool();
  shot.ball.mass = -1;
  CHECK_THROWS_AS(si::reduced_system(shot, reduction::PadeLaw{}), std::domain_error);
}
