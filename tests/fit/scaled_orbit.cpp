#include "fit/scaled_orbit.hpp"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "contensou/reduction/laws.hpp"
#include "contensou/si/scaling.hpp"
#include "films.hpp"

using namespace contensou;
using Eigen::ArrayXd;

TEST_CASE("an orbit by its own quadrature is that of the ball to 1e-9, from start to rest", "[route]") {
  for (const reduction::Law& law : CONTENSOU_FULL_TESTS ? reduction::named_laws() : reduction::paper_laws()) {
    for (double mu : {1e-3, 0.1, 0.8}) {
      for (const auto& [slip, spin] :
           std::vector<std::pair<double, double>>{{1, 100}, {1, 0.01}, {1e-3, 100}, {0, 100}, {1, 0}}) {
        si::Experiment ball = pool_ball();
        ball.contact.patch = si::PatchRadius{mu * ball.ball.radius};
        ball.start = si::SlipAndSpin{.slip = slip, .spin = spin};
        const si::Motion motion = si::Motion::reduced(ball, law);
        const double rate = 0.2 * ball.environment.gravity, stop = motion.stop_time();
        ArrayXd t(122);  // the whole motion and beyond, and where it slides
        t << ArrayXd::LinSpaced(61, 0, 0.999 * std::min(stop, 2 * slip / (7 * rate) + 1e-9)),
            ArrayXd::LinSpaced(61, stop, 1.5 * stop);
        INFO(law.name() << ", mu = " << mu << ", slip " << slip << ", spin " << spin);
        fit::ScaledOrbit orbit(law, mu, si::reduced_start(ball));
        orbit.reach(std::numeric_limits<double>::infinity());
        CHECK(orbit.stop().T == Approx(rate * stop).epsilon(1e-9));
        const double scale = std::max(slip, ball.ball.radius * spin);
        std::size_t cell = 0;
        double worst_slip = 0, worst_spin = 0, worst_length = 0;
        for (Eigen::Index i = 0; i < t.size(); ++i) {
          const si::MotionPoint at = motion.at(t[i]);
          const fit::Speeds now = orbit.at(rate * t[i], cell).now;
          worst_slip = std::max(worst_slip, std::abs(now.v - at.slip));
          worst_spin = std::max(worst_spin, std::abs(now.u / ball.ball.radius - at.angular_velocity.z()));
          const double slid = slip * t[i] - 3.5 * (slip * t[i] - at.position.x());
          worst_length = std::max(worst_length, std::abs(now.slid / rate - slid));
        }
        CHECK(worst_slip <= 1e-9 * (slip > 0 ? slip : scale));
        CHECK(worst_spin <= 1e-9 * (spin > 0 ? spin : scale / ball.ball.radius));
        CHECK(worst_length < 1e-9 * scale * stop);
        CHECK(orbit.at(rate * t[t.size() - 1], cell).now.turned / rate / ball.ball.radius ==
              Approx(motion.spin_angle()).epsilon(1e-8));
      }
    }
  }
}
