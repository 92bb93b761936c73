#include "contensou/si/scaling.hpp"

#include <cmath>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/si/catalogue.hpp"

using namespace contensou;

namespace {

si::Experiment pool() { return si::find_ball("pool")->experiment; }

double stop_in_seconds(const si::Experiment& experiment, const reduction::Law& law) {
  return si::seconds(experiment,
                     reduction::Flow(si::reduced_system(experiment, law)).stop_time(si::reduced_start(experiment)).tau);
}

}  // namespace

TEST_CASE("u is R omega_z with its sign, v the slip, mu the patch over the radius", "[table]") {
  si::Experiment experiment = pool();
  experiment.contact.patch = si::PatchRadius{0.0028575};
  experiment.start = si::SlipAndSpin{.slip = 2, .spin = -10};
  CHECK(si::patch_ratio(experiment, reduction::PadeLaw{}) == Approx(0.1).epsilon(1e-15));
  CHECK(si::reduced_start(experiment).u == -0.28575);
  CHECK(si::reduced_start(experiment).v == 2);
}

TEST_CASE("a ball that only slides takes 2 v0/(7 f g)", "[limit]") {
  si::Experiment experiment = pool();
  experiment.start = si::SlipAndSpin{.slip = 1.7, .spin = 0};
  const double expected = 2 * 1.7 / (7 * experiment.contact.friction * experiment.environment.gravity);
  CHECK(stop_in_seconds(experiment, reduction::PadeLaw{}) == Approx(expected).epsilon(1e-14));
  CHECK(stop_in_seconds(experiment, reduction::HertzLaw{}) == Approx(expected).epsilon(1e-14));
}

TEST_CASE("a ball that only spins takes omega_z/alpha", "[limit]") {
  si::Experiment experiment = pool();
  experiment.contact.patch = si::SpinDeceleration{8};
  experiment.start = si::SlipAndSpin{.slip = 0, .spin = -100};
  for (const reduction::Law& law : reduction::named_laws()) {
    CHECK(stop_in_seconds(experiment, law) == Approx(100.0 / 8).epsilon(1e-14));
  }
}

TEST_CASE("seconds keep 0 and infinity where f g underflows", "[limit]") {
  si::Experiment experiment = pool();
  experiment.contact.friction = 1e-200;
  experiment.environment.gravity = 1e-200;
  CHECK(si::seconds(experiment, 0) == 0);
  CHECK(std::isinf(si::seconds(experiment, 1)));
}

TEST_CASE("a system of an impossible ball is refused", "[limit]") {
  si::Experiment experiment = pool();
  experiment.ball.mass = -1;
  CHECK_THROWS_AS(si::reduced_system(experiment, reduction::PadeLaw{}), std::domain_error);
}
