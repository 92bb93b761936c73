#include "contensou/si/experiment.hpp"

#include <functional>
#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"

using namespace contensou::si;
using Catch::Matchers::Contains;
using contensou::reduction::PressureLaw;

namespace {

Experiment good_shot() {
  return {.ball = {.name = "ball", .mass = 0.17, .radius = 0.03},
          .contact = {.friction = 0.2, .patch = PatchRadius{0.003}},
          .start = SlipAndSpin{.slip = 1, .spin = -100}};
}

}  // namespace

TEST_CASE("an experiment is checked value by value", "[limit]") {
  CHECK_NOTHROW(require_experiment(good_shot()));
  struct Fault {
    std::function<void(Experiment&, double)> set;
    std::string name;
    std::vector<double> values;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<Fault> faults{
      {[](Experiment& s, double x) { s.ball.mass = x; }, "mass", {0, -1, inf}},
      {[](Experiment& s, double x) { s.ball.radius = x; }, "radius", {0, -1, nan, inf}},
      {[](Experiment& s, double x) { s.contact.friction = x; }, "friction", {0, -1, nan, inf}},
      {[](Experiment& s, double x) { s.contact.patch = PatchRadius{x}; }, "patch_radius", {0, -1, nan, inf}},
      {[](Experiment& s, double x) { s.contact.patch = SpinDeceleration{x}; }, "spin_deceleration", {0, -1, nan, inf}},
      {[](Experiment& s, double x) {
         s.contact.patch = HertzModuli{{x, 1e9}, {0.3, 0.3}};
       },
       "youngs_modulus",
       {0, -1, nan, inf}},
      {[](Experiment& s, double x) {
         s.contact.patch = HertzModuli{{1e9, 1e9}, {0.3, x}};
       },
       "poisson_ratio",
       {-1, 0.51, nan}},
      {[](Experiment& s, double x) { std::get<SlipAndSpin>(s.start).slip = x; }, "slip", {-1, nan, inf}},
      {[](Experiment& s, double x) { std::get<SlipAndSpin>(s.start).spin = x; }, "spin", {nan, inf, -inf}},
      {[](Experiment& s, double x) { s.environment.gravity = x; }, "gravity", {0, -9.8, nan, inf}},
  };
  Experiment weightless = good_shot();
  weightless.ball.mass = unknown_mass;
  CHECK_NOTHROW(require_experiment(weightless));
  for (const Fault& fault : faults) {
    for (double value : fault.values) {
      Experiment experiment = good_shot();
      fault.set(experiment, value);
      INFO(fault.name << " = " << value);
      CHECK_THROWS_WITH(require_experiment(experiment), Contains(fault.name + " must be") && Contains("got"));
    }
  }
}

TEST_CASE("any velocities, if they are numbers and so are those of the rim", "[limit]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  Experiment experiment = good_shot();
  experiment.start = Velocities{{-1, 2}, {3, -4, 5}};
  CHECK_NOTHROW(require_experiment(experiment));
  // The slip velocity (2.1) is (vx - R omega_y, vy + R omega_x).
  CHECK(slip_velocity_at_start(experiment).x() == -1 + 0.03 * 4);
  CHECK(slip_velocity_at_start(experiment).y() == 2 + 0.03 * 3);
  CHECK(spin_at_start(experiment) == 5);
  for (double bad : {nan, inf, -inf}) {
    experiment.start = Velocities{{0, bad}, {0, 0, 0}};
    CHECK_THROWS_WITH(require_experiment(experiment), Contains("velocity must be finite, in m/s"));
    experiment.start = Velocities{{0, 0}, {0, bad, 0}};
    CHECK_THROWS_WITH(require_experiment(experiment), Contains("angular_velocity must be finite"));
  }
  experiment.start = Velocities{{1.7e308, 0}, {0, -1e308, 0}};
  experiment.ball.radius = 10;
  CHECK_THROWS_WITH(require_experiment(experiment), Contains("velocity of the contact point must be finite"));
  experiment.start = SlipAndSpin{.slip = 1, .spin = 1e308};
  CHECK_THROWS_WITH(require_experiment(experiment), Contains("radius times spin"));
}

TEST_CASE("the patch is no larger than the ball", "[limit]") {
  Experiment experiment = good_shot();
  experiment.contact.patch = PatchRadius{0.03};
  CHECK_NOTHROW(require_experiment(experiment));
  experiment.contact.patch = PatchRadius{0.031};
  CHECK_THROWS_WITH(require_experiment(experiment), Contains("0.031") && Contains("at most the ball's radius 0.03"));
  experiment.contact.patch = SpinDeceleration{1e6};
  CHECK_THROWS_WITH(patch_radius_of(experiment, PressureLaw::ring()),
                    Contains("from its spin deceleration 1000000 rad/s^2, under law ring"));
}
