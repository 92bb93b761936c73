#include "contensou/si/motion.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "motion_cases.hpp"

using namespace contensou;
using namespace contensou::si;

namespace {

struct NotANumber {
  reduction::Resistance operator()(reduction::Slip slip) const {
    const double k = slip.sliding / slip.pivoting;
    if (k > 0.1 && k < 0.2) return {std::nan(""), std::nan("")};
    return reduction::PadeLaw{}(slip);
  }
};

}  // namespace

TEST_CASE("friction takes m v0^2/7 by sliding and m u0^2/5 by pivoting, under any law", "[invariant]") {
  for (const reduction::Law& law : reduction::named_laws()) {
    for (double mu : {1e-2, 0.3, 1.0}) {
      const Experiment experiment = experiment_of(motion_cases[2], mu);
      const Motion in_steps = Motion::in_steps(experiment, law);
      const double stop = in_steps.stop_time();
      // The power (f N) Phi v of sliding and the power (f N eps) Psi |omega_z| of spinning are integrated over time.
      const double load = experiment.contact.friction * experiment.ball.mass * experiment.environment.gravity;
      const double eps = patch_radius_of(experiment, law);
      // Use Simpson's rule in s, with t = stop s^4. Its points are dense at the beginning, where the ball slides.
      constexpr Eigen::Index panels = 4000;
      const Eigen::ArrayXd s = Eigen::ArrayXd::LinSpaced(panels + 1, 0, 1);
      const Eigen::ArrayXd times = stop * s.pow(4);
      const MotionColumns motion = in_steps.at(times);
      double sliding = 0, pivoting = 0;
      for (Eigen::Index i = 0; i <= panels; ++i) {
        const double weight = (i == 0 || i == panels ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) / (3.0 * panels);
        const double rate = 4 * stop * std::pow(s[i], 3);
        const double rim = eps * std::abs(motion.wz[i]);
        if (motion.slip[i] == 0 && rim == 0) continue;
        const auto [phi, psi] = law({motion.slip[i], rim});
        sliding += weight * rate * load * phi * motion.slip[i];
        pivoting += weight * rate * load * psi * rim;
      }
      INFO(law.name() << ", mu = " << mu);
      const EnergyLoss loss = energy_loss(experiment);
      CHECK(sliding == Approx(loss.sliding).epsilon(1e-6));
      CHECK(pivoting == Approx(loss.pivoting).epsilon(1e-6));
      CHECK(motion.energy[0] - motion.energy[panels] == Approx(loss.sliding + loss.pivoting).epsilon(1e-11));
    }
  }
}

TEST_CASE("instants in any order, past the stop too", "[limit]") {
  const Experiment experiment = experiment_of(motion_cases[2], 0.1);
  Eigen::ArrayXd times(5);
  times << 30, 0.01, 0, 0.01, 2;
  const MotionColumns motion = Motion::in_steps(experiment, reduction::HertzLaw{}).at(times);
  CHECK((motion.t == times).all());
  CHECK(motion.vx[1] == motion.vx[3]);
  CHECK(motion.x[2] == 0);
  CHECK(motion.vx[2] == Approx(1).epsilon(1e-15));
  CHECK(motion.wz[0] == 0);
  CHECK(motion.slip[0] == 0);
}

TEST_CASE("what cannot be integrated is said", "[domain]") {
  const Experiment experiment = experiment_of(motion_cases[0], 0.1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double t : {-1.0, nan}) {
    CHECK_THROWS_AS(Motion::in_steps(experiment, reduction::PadeLaw{}).at(Eigen::ArrayXd::Constant(1, t)),
                    std::domain_error);
  }
  CHECK_THROWS_AS(Motion::in_steps(experiment, NotANumber{}), std::runtime_error);
}

TEST_CASE("a motion in steps has all the events of the reduced one", "[route]") {
  for (const std::size_t each : {std::size_t{1}, std::size_t{2}}) {
    const Experiment experiment = experiment_of(motion_cases[each], 0.1);
    const Motion reduced = Motion::reduced(experiment, reduction::HertzLaw{}),
                 in_steps = Motion::in_steps(experiment, reduction::HertzLaw{});
    const Events ours = reduced.events(), theirs = in_steps.events();
    CHECK(theirs.rolls.t == Approx(ours.rolls.t).epsilon(1e-10));
    CHECK((theirs.rolls.place - ours.rolls.place).norm() < 1e-10);
    CHECK(theirs.spin_ends.t == Approx(ours.spin_ends.t).epsilon(1e-10));
    CHECK(theirs.slip_length == Approx(ours.slip_length).epsilon(1e-10));
    CHECK(theirs.turns == Approx(ours.turns).epsilon(1e-10));
    CHECK(theirs.path == Approx(ours.path).epsilon(1e-8));
    CHECK(in_steps.spin_time(5) == Approx(reduced.spin_time(5)).epsilon(1e-10));
    CHECK(in_steps.slip_time(0) == in_steps.stop_time());
    CHECK(in_steps.steps() > 0);
    CHECK(in_steps.pieces().empty());
    CHECK_FALSE(in_steps.is_reduced());
    CHECK(in_steps.energy_balance().kept == Approx(reduced.energy_balance().kept));
  }
}
