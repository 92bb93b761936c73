#include "contensou/si/integrated_motion.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "contensou/reduction/hertz_law.hpp"
#include "contensou/reduction/laws.hpp"
#include "contensou/reduction/pade_law.hpp"
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

TEST_CASE("the first integrals keep their values along the integration", "[invariant]") {
  for (const reduction::Law& law : reduction::named_laws()) {
    for (double mu : {1e-3, 0.1, 1.0}) {
      for (const MotionCase& motion_case : motion_cases) {
        INFO(law.name() << ", mu = " << mu << ", " << motion_case.name);
        const Shot shot = shot_of(motion_case, mu);
        const double v0 = slip_at_start(shot);
        if (v0 < 1e-15) continue;
        const double stop = integrate_motion(shot, law, {}).stop_time;
        const MotionColumns motion = integrate_motion(shot, law, Eigen::ArrayXd::LinSpaced(50, 0, stop)).points;
        const double R = shot.ball.radius;
        const Eigen::Vector2d e = slip_velocity_at_start(shot) / v0;
        const auto start = velocities_of(shot.start).angular_velocity;
        const double speed = v0 + R * start.norm();
        for (Eigen::Index i = 0; i < motion.rows(); ++i) {
          const Eigen::Vector2d contact{motion.vx[i] - R * motion.wy[i], motion.vy[i] + R * motion.wx[i]};
          const Eigen::Vector2d omega{motion.wx[i], motion.wy[i]};
          // alpha; omega along the slip; 7 R omega across it + 5 v
          CHECK(std::abs(e.x() * contact.y() - e.y() * contact.x()) < 1e-12 * speed);
          CHECK(e.dot(contact) == Approx(motion.slip[i]).margin(1e-12 * speed));
          CHECK(std::abs(e.dot(omega - start.head<2>())) * R < 1e-12 * speed);
          const auto across = [&](const Eigen::Vector2d& w) { return e.x() * w.y() - e.y() * w.x(); };
          CHECK(std::abs(7 * R * (across(omega) - across(start.head<2>())) + 5 * (motion.slip[i] - v0)) <
                1e-10 * speed);
        }
      }
    }
  }
}

TEST_CASE("friction takes m v0^2/7 by sliding and m u0^2/5 by pivoting, under any law", "[invariant]") {
  for (const reduction::Law& law : reduction::named_laws()) {
    for (double mu : {1e-2, 0.3, 1.0}) {
      const Shot shot = shot_of(motion_cases[2], mu);
      const double stop = integrate_motion(shot, law, {}).stop_time;
      // The power of each friction, (f N) Phi v and (f N eps) Psi |omega_z|, summed along the integration.
      const double load = shot.contact.friction * shot.ball.mass * shot.environment.gravity;
      const double eps = patch_radius_of(shot, law);
      // Simpson's rule in s, t = stop s^4: the start, where the ball slides, in detail.
      constexpr Eigen::Index panels = 4000;
      const Eigen::ArrayXd s = Eigen::ArrayXd::LinSpaced(panels + 1, 0, 1);
      const Eigen::ArrayXd times = stop * s.pow(4);
      const MotionColumns motion = integrate_motion(shot, law, times).points;
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
      const EnergyLoss loss = energy_loss(shot);
      CHECK(sliding == Approx(loss.sliding).epsilon(1e-6));
      CHECK(pivoting == Approx(loss.pivoting).epsilon(1e-6));
      CHECK(motion.energy[0] - motion.energy[panels] == Approx(loss.sliding + loss.pivoting).epsilon(1e-11));
    }
  }
}

TEST_CASE("instants in any order, past the stop too", "[limit]") {
  const Shot shot = shot_of(motion_cases[2], 0.1);
  Eigen::ArrayXd times(5);
  times << 30, 0.01, 0, 0.01, 2;
  const MotionColumns motion = integrate_motion(shot, reduction::HertzLaw{}, times).points;
  CHECK((motion.t == times).all());
  CHECK(motion.vx[1] == motion.vx[3]);
  CHECK(motion.x[2] == 0);
  CHECK(motion.vx[2] == Approx(1).epsilon(1e-15));
  CHECK(motion.wz[0] == 0);
  CHECK(motion.slip[0] == 0);
}

TEST_CASE("what cannot be integrated is said", "[domain]") {
  const Shot shot = shot_of(motion_cases[0], 0.1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double t : {-1.0, nan}) {
    CHECK_THROWS_AS(integrate_motion(shot, reduction::PadeLaw{}, Eigen::ArrayXd::Constant(1, t)), std::domain_error);
  }
  CHECK_THROWS_AS(integrate_motion(shot, NotANumber{}, {}), std::runtime_error);
}
