#include "verbs/roll_answer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "contensou/si/bridge.hpp"
#include "contensou/si/integrated_motion.hpp"
#include "contensou/si/uncoupled_motion.hpp"

namespace contensou::program {

namespace {

/// Of the initial slip. Friction over a pivoting patch is viscous, so that slip ends together with the spin only.
constexpr double rolling_share = 1e-3;

si::MotionColumns motion_at(const Roll& roll, const Eigen::ArrayXd& times) {
  return roll.integrated ? si::integrate_motion(roll.shot, roll.law, times).points : roll.whole.at_times(times);
}

std::string heading(const si::Shot& shot, const Digits& digits) {
  const si::Velocities start = si::velocities_of(shot.start);
  return fmt::format(
      "{}: radius {} m, mass {} kg, friction {}, patch radius {} m (mu = {})\n"
      "velocity {} m/s, angular velocity {} 1/s: slip {} m/s, spin {} rad/s\n",
      shot.ball.name, digits(shot.ball.radius), digits(shot.ball.mass), digits(shot.contact.friction),
      digits(si::patch_radius_of(shot)), digits(si::patch_ratio(shot)), digits.list(start.velocity),
      digits.list(start.angular_velocity), digits(si::slip_at_start(shot)), digits(si::spin_at_start(shot)));
}

std::string table(const Roll& roll, const Digits& digits) {
  const auto& [shot, law, integrated, whole] = roll;
  const si::UncoupledMotion textbook(shot, law);
  const double stop = whole.stop_time();
  const double rolls = roll.rolling_time();
  const double textbook_stop = std::max(textbook.slip_end(), textbook.spin_end());
  std::string text;
  const auto row = [&, width = std::max(26, 2 * digits.count + 16)](const std::string& label, const std::string& ours,
                                                                    const std::string& theirs,
                                                                    const std::string& unit) {
    text += fmt::format("{:<24}{:>{}}{:>{}}{}\n", label, ours, width, theirs, width, unit.empty() ? "" : "  " + unit);
  };
  row("", "law " + law.name(), "textbook (uncoupled)", "");
  row("rolls after", digits(rolls), digits(textbook.slip_end()), "s");
  row("  at", digits.list(whole.at_time(rolls).position), digits.list(textbook.at_time(textbook.slip_end()).position),
      "m");
  row("spins no more after", digits(stop), digits(textbook_stop), "s");
  row("  at", digits.list(whole.at_time(stop).position), digits.list(textbook.at_time(textbook_stop).position), "m");
  row("length of slip", digits(whole.slip_length()), digits(textbook.slip_length()), "m");
  row("turned about vertical", digits(whole.spin_angle() / (2 * std::numbers::pi)),
      digits(textbook.spin_angle() / (2 * std::numbers::pi)), "turns");
  row("path until it rolls", digits(whole.path_length(rolls)), digits(textbook.path_length(textbook.slip_end())), "m");
  return text;
}

std::string ending(const si::Shot& shot, const Digits& digits) {
  const auto [velocity, angular_velocity] = si::final_motion(shot);
  const si::EnergyLoss loss = si::energy_loss(shot);
  const double start = si::kinetic_energy(shot.ball, si::velocities_of(shot.start));
  std::string text = fmt::format("then   it rolls straight on: velocity {} m/s, angular velocity {} 1/s\n",
                                 digits.list(velocity), digits.list(angular_velocity));
  if (velocity.norm() > 0) {
    const double degrees = std::atan2(velocity.y(), velocity.x()) * (180 / std::numbers::pi);
    text += fmt::format("       at {} m/s, {} degrees from the x axis\n", digits(velocity.norm()), digits(degrees));
  }
  if (si::spin_at_start(shot) != 0 && si::slip_at_start(shot) > 0) {
    text += fmt::format("       (slip below {} of its start counts as rolling: it ends with the spin only)\n",
                        digits(rolling_share));
  }
  return text + fmt::format("energy {} J: {} lost by sliding, {} by spinning, {} kept\n", digits(start),
                            digits(loss.sliding), digits(loss.pivoting), digits(start - loss.sliding - loss.pivoting));
}

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

double Roll::rolling_time() const {
  return si::spin_at_start(shot) == 0 ? whole.stop_time() : whole.slip_time(rolling_share);
}

Answer roll_table(const Roll& roll, const Eigen::ArrayXd& times) {
  const auto [velocity, angular_velocity] = si::velocities_of(roll.shot.start);
  const si::MotionColumns motion = motion_at(roll, times);
  return {.members = {{"law", roll.law.name()},
                      {"route", roll.integrated ? "integrated" : "reduced"},
                      {"mu", si::patch_ratio(roll.shot)},
                      {"velocity", std::vector(velocity.begin(), velocity.end())},
                      {"angular_velocity", std::vector(angular_velocity.begin(), angular_velocity.end())},
                      {"t_stop", roll.whole.stop_time()}},
          .columns = {{"t", motion.t},
                      {"x", motion.x},
                      {"y", motion.y},
                      {"vx", motion.vx},
                      {"vy", motion.vy},
                      {"wx", motion.wx},
                      {"wy", motion.wy},
                      {"wz", motion.wz},
                      {"slip", motion.slip},
                      {"energy", motion.energy}}};
}

std::string roll_report(const Roll& roll, const Digits& digits) {
  const std::string text = heading(roll.shot, digits) + "\n" + table(roll, digits) + "\n" + ending(roll.shot, digits);
  if (!roll.integrated) return text;
  const si::IntegratedMotion motion = si::integrate_motion(roll.shot, roll.law, {});
  return text + fmt::format("route integrated: it stops after {} s, {:.1g} from the reduced route, in {} steps\n",
                            digits(motion.stop_time), std::abs(motion.stop_time - roll.whole.stop_time()),
                            motion.steps);
}

portraits::RollPicture roll_picture(const Roll& roll, double end) {
  const auto& [shot, law, integrated, whole] = roll;
  const si::UncoupledMotion textbook(shot, law);
  const double rolls = roll.rolling_time();
  const Eigen::ArrayXd times = instants(std::max(rolls, textbook.slip_end()), end);
  const double slip = si::slip_at_start(shot);
  const double spin = si::spin_at_start(shot);
  portraits::RollPicture picture{
      .title = fmt::format("{},  {{/:Italic μ}} = {:.4g},  law: {}", portraits::literal(shot.ball.name),
                           si::patch_ratio(shot), portraits::literal(law.name())),
      .subtitle = fmt::format("slip {:.4g} m/s, spin {:.4g} rad/s", slip, spin),
      .ball = curve(shot, motion_at(roll, times), rolls),
      .textbook = curve(shot, textbook.at_times(times), textbook.slip_end())};
  if (slip > 0) {
    picture.subtitle += fmt::format("; it rolls after {:.3g} s (textbook {:.3g} s)", rolls, textbook.slip_end());
  }
  if (spin != 0) picture.subtitle += fmt::format("; its spin lasts {:.3g} s", whole.stop_time());
  return picture;
}

}  // namespace contensou::program
