#include "verbs/roll_drawing.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "contensou/si/bridge.hpp"
#include "contensou/si/uncoupled_motion.hpp"
#include "contensou/si/whole_motion.hpp"

namespace contensou::program {

namespace {

portraits::RollCurve curve(const si::Shot& shot, const si::MotionColumns& motion, double rolls) {
  return {.t = motion.t,
          .x = motion.x,
          .y = motion.y,
          .slip = motion.slip,
          .rim = shot.ball.radius * motion.wz.abs(),
          .speed = (motion.vx.square() + motion.vy.square()).sqrt(),
          .rolls = rolls};
}

/// Instants for curves over [0, last]: even ones while the ball slides and a little longer, then geometric ones.
Eigen::ArrayXd instants(double slides, double last) {
  constexpr Eigen::Index even = 300;
  const double middle = slides > 0 ? std::min(2 * slides, last) : last;
  const Eigen::ArrayXd first = Eigen::ArrayXd::LinSpaced(even, 0, middle);
  if (!(middle < last)) return first;
  constexpr Eigen::Index late = 200;
  Eigen::ArrayXd all(even + late);
  const Eigen::ArrayXd growth = Eigen::ArrayXd::LinSpaced(late + 1, 0, std::log(last / middle)).exp();
  all << first, middle * growth.tail(late);
  return all;
}

}  // namespace

portraits::RollPicture roll_drawing(const si::Shot& shot, const reduction::Law& law, RollRoute route,
                                    std::optional<double> until) {
  const si::WholeMotion whole(shot, law);
  const si::UncoupledMotion textbook(shot, law);
  const double rolls = rolling_time(shot, whole);
  const double last = until.value_or(standard_end(shot, law));
  const Eigen::ArrayXd times = instants(std::max(rolls, textbook.slip_end()), last);

  portraits::RollPicture picture;
  picture.title = fmt::format("{},  {{/:Italic μ}} = {:.4g},  law: {}", portraits::literal(shot.ball.name),
                              si::patch_ratio(shot), portraits::literal(law.name()));
  const double slip = si::slip_at_start(shot);
  const double spin = si::spin_at_start(shot);
  picture.subtitle = fmt::format("slip {:.4g} m/s, spin {:.4g} rad/s", slip, spin);
  if (slip > 0) {
    picture.subtitle += fmt::format("; it rolls after {:.3g} s (textbook {:.3g} s)", rolls, textbook.slip_end());
  }
  if (spin != 0) picture.subtitle += fmt::format("; its spin lasts {:.3g} s", whole.stop_time());
  picture.ball = curve(shot, roll_motion(shot, law, route, times), rolls);
  picture.textbook = curve(shot, textbook.at_times(times), textbook.slip_end());
  return picture;
}

}  // namespace contensou::program
