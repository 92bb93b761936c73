#include "verbs/roll_report.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "contensou/si/bridge.hpp"
#include "contensou/si/final_motion.hpp"
#include "contensou/si/integrated_motion.hpp"
#include "contensou/si/uncoupled_motion.hpp"

namespace contensou::program {

namespace {

class Report {
 public:
  Report(const si::Shot& shot, const reduction::Law& law, int digits)
      : shot_(shot), law_(law), digits_(digits), whole_(shot, law), textbook_(shot, law) {}

  std::string text() const { return heading() + "\n" + table() + "\n" + ending(); }

 private:
  std::string number(double value) const { return fmt::format("{:.{}g}", value, digits_); }

  template <class Values>
  std::string list(const Values& values) const {
    std::string text;
    for (double value : values) text += (text.empty() ? "" : ", ") + number(value);
    return "(" + text + ")";
  }

  std::string heading() const {
    const auto& ball = shot_.ball;
    const si::Velocities start = si::velocities_of(shot_.start);
    return fmt::format(
        "{}: radius {} m, mass {} kg, friction {}, patch radius {} m (mu = {})\n"
        "velocity {} m/s, angular velocity {} 1/s: slip {} m/s, spin {} rad/s\n",
        ball.name, number(ball.radius), number(ball.mass), number(shot_.contact.friction),
        number(si::patch_radius_of(shot_)), number(si::patch_ratio(shot_)), list(start.velocity),
        list(start.angular_velocity), number(si::slip_at_start(shot_)), number(si::spin_at_start(shot_)));
  }

  std::string row(const std::string& label, const std::string& whole, const std::string& textbook,
                  const std::string& unit) const {
    const int width = std::max(26, 2 * digits_ + 16);
    return fmt::format("{:<24}{:>{}}{:>{}}{}{}\n", label, whole, width, textbook, width, unit.empty() ? "" : "  ",
                       unit);
  }

  std::string table() const {
    const double stop = whole_.stop_time();
    const double rolls = rolling_time(shot_, whole_);
    const double textbook_rolls = textbook_.slip_end();
    const double textbook_stop = std::max(textbook_.slip_end(), textbook_.spin_end());
    const si::MotionPoint here = whole_.at_time(rolls);
    const si::MotionPoint there = textbook_.at_time(textbook_rolls);
    const double spin = si::spin_at_start(shot_);

    std::string all = row("", "law " + law_.name(), "textbook (uncoupled)", "");
    all += row("rolls after", number(rolls), number(textbook_rolls), "s");
    all += row("  at", list(here.position), list(there.position), "m");
    all += row("spins no more after", number(stop), number(textbook_stop), "s");
    all += row("  at", list(whole_.at_time(stop).position), list(textbook_.at_time(textbook_stop).position), "m");
    all += row("length of slip", number(whole_.slip_length()),
               number(si::slip_at_start(shot_) * textbook_.slip_end() / 2), "m");
    all += row("turned about vertical", number(whole_.spin_angle() / (2 * std::numbers::pi)),
               number(spin * textbook_.spin_end() / (4 * std::numbers::pi)), "turns");
    return all +
           row("path until it rolls", number(whole_.path_length(rolls)), number(textbook_path(textbook_rolls)), "m");
  }

  /// By Simpson's rule: the speed is the root of a quadratic.
  double textbook_path(double end) const {
    constexpr int panels = 1000;
    double sum = 0;
    for (int i = 0; i <= panels; ++i) {
      const double weight = i == 0 || i == panels ? 1 : i % 2 == 1 ? 4 : 2;
      sum += weight * textbook_.at_time(end * i / panels).velocity.norm();
    }
    return sum * end / (3 * panels);
  }

  std::string ending() const {
    const si::FinalMotion rolling = si::final_motion(shot_);
    const si::EnergyLoss loss = si::energy_loss(shot_);
    const double start = si::kinetic_energy(shot_.ball, si::velocities_of(shot_.start));
    const double speed = rolling.velocity.norm();
    std::string all = fmt::format("then   it rolls straight on: velocity {} m/s, angular velocity {} 1/s\n",
                                  list(rolling.velocity), list(rolling.angular_velocity));
    if (speed > 0) {
      const double degrees = std::atan2(rolling.velocity.y(), rolling.velocity.x()) * (180 / std::numbers::pi);
      all += fmt::format("       at {} m/s, {} degrees from the x axis\n", number(speed), number(degrees));
    }
    if (si::spin_at_start(shot_) != 0 && si::slip_at_start(shot_) > 0) {
      all += fmt::format("       (slip below {} of its start counts as rolling: it ends with the spin only)\n",
                         number(rolling_share));
    }
    return all + fmt::format("energy {} J: {} lost by sliding, {} by spinning, {} kept\n", number(start),
                             number(loss.sliding), number(loss.pivoting), number(start - loss.sliding - loss.pivoting));
  }

  const si::Shot& shot_;
  const reduction::Law& law_;
  int digits_;
  si::WholeMotion whole_;
  si::UncoupledMotion textbook_;
};

}  // namespace

std::string roll_report(const si::Shot& shot, const reduction::Law& law, RollRoute route, int digits) {
  std::string text = Report(shot, law, digits).text();
  if (route == RollRoute::integrated) {
    const si::IntegratedMotion motion = si::integrate_motion(shot, law, {});
    text += fmt::format("route integrated: it stops after {:.{}g} s, {:.1g} from the reduced route, in {} steps\n",
                        motion.stop_time, digits, std::abs(motion.stop_time - si::WholeMotion(shot, law).stop_time()),
                        motion.steps);
  }
  return text;
}

}  // namespace contensou::program
