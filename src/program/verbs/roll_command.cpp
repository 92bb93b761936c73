#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "contensou/portraits/roll_figure.hpp"
#include "contensou/si/ball_motion.hpp"
#include "contensou/si/bridge.hpp"
#include "contensou/si/integrated_motion.hpp"
#include "contensou/si/uncoupled_motion.hpp"
#include "options/instants_option.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

/// Of the initial slip. Friction over a pivoting patch is viscous, so that slip ends together with the spin only.
constexpr double rolling_share = 1e-3;

/// The whole motion of a ball.
struct Roll {
  si::Shot shot;
  reduction::Law law;
  bool integrated;  ///< the route of its columns: the equations of motion instead of the similarity solution
  si::BallMotion whole{shot, law};

  /// When the ball rolls, in s: its slip is below rolling_share of that at the start, or over where there is no spin.
  double rolling_time() const {
    return si::spin_at_start(shot) == 0 ? whole.stop_time() : whole.slip_time(rolling_share);
  }

  si::MotionColumns at_times(const Eigen::ArrayXd& times) const {
    return integrated ? si::integrate_motion(shot, law, times).points : whole.at_times(times);
  }

  /// Where a series of instants ends unless the user says otherwise, in s: a little past the stop.
  double standard_end() const { return whole.stop_time() > 0 ? 1.1 * whole.stop_time() : 1; }
};

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

/// Columns of the motion.
/// @param times  s
Answer table_of(const Roll& roll, const Eigen::ArrayXd& times) {
  const auto [velocity, angular_velocity] = si::velocities_of(roll.shot.start);
  const si::MotionColumns motion = roll.at_times(times);
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

/// The motion on one screen: where and when the ball ceases to slip, how it rolls on, what friction took, and the
/// textbook's answer beside it. For the route integrated, how close its stop is.
std::string report_on(const Roll& roll, const Digits& digits) {
  const std::string text = heading(roll.shot, digits) + "\n" + table(roll, digits) + "\n" + ending(roll.shot, digits);
  if (!roll.integrated) return text;
  const si::IntegratedMotion motion = si::integrate_motion(roll.shot, roll.law, {});
  return text + fmt::format("route integrated: it stops after {} s, {:.1g} from the reduced route, in {} steps\n",
                            digits(motion.stop_time), std::abs(motion.stop_time - roll.whole.stop_time()),
                            motion.steps);
}

/// The picture of the motion up to a time in s, beside the textbook's.
portraits::RollPicture picture_of(const Roll& roll, double end) {
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
      .ball = curve(shot, roll.at_times(times), rolls),
      .textbook = curve(shot, textbook.at_times(times), textbook.slip_end())};
  if (slip > 0) {
    picture.subtitle += fmt::format("; it rolls after {:.3g} s (textbook {:.3g} s)", rolls, textbook.slip_end());
  }
  if (spin != 0) picture.subtitle += fmt::format("; its spin lasts {:.3g} s", whole.stop_time());
  return picture;
}

double parse_end(const std::string& typed) {
  const double end = parse_number(typed);
  if (!(end > 0)) throw NotAllowed("a time after the start is needed, in s");
  return end;
}

class RollCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    start_.add_ball(app);
    velocity_.add(app, "--velocity", "VX,VY", "velocity of the centre in m/s, instead of the start's",
                  [](const std::string& typed) { return Eigen::Vector2d(numbers(typed, 2, "VX,VY").data()); });
    angular_velocity_.add(
        app, "--angular-velocity", "WX,WY,WZ", "angular velocity in rad/s, z up, instead of the start's",
        [](const std::string& typed) { return Eigen::Vector3d(numbers(typed, 3, "WX,WY,WZ").data()); });
    law_.add(app);
    integrated_.add(app, "--route", "ROUTE",
                    "reduced: the similarity solution (default), or integrated: the five equations of motion (2.5)",
                    one_of<bool>({{"reduced", false}, {"integrated", true}}, "route"));
    CLI::Option* at = instants_.add(app, "t", " in s", "");
    until_.add(app, "--until", "T", "the last of them, in s (default: a little past the stop)", parse_end)
        ->excludes(at);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    const si::Shot shot = read_shot();
    const Roll roll{shot, law_.read(), integrated_.value_or(false)};
    const double end = until_.value_or(roll.standard_end());
    if (output.picture()) {
      if (instants_.given()) throw BadInput("a picture needs no --at or --samples: leave them out");
      output.write(portraits::roll_figure(picture_of(roll, end)));
    } else if (output.format == "text" && !instants_.given() && !until_.given()) {
      output.write(report_on(roll, output.digits));
    } else {
      const auto* at = instants_.at();
      output.write(table_of(roll, at != nullptr ? *at : Eigen::ArrayXd::LinSpaced(instants_.samples(), 0, end)));
    }
    return ExitStatus::done;
  }

 private:
  si::Shot read_shot() const {
    const si::StartOverride start{velocity_.optional(), angular_velocity_.optional()};
    if ((start.velocity || start.angular_velocity) && start_.overrides_start()) {
      throw BadInput("--slip, --spin and --velocity, --angular-velocity exclude each other: give one pair of them");
    }
    return start_.read_ball(start);
  }

  StartOptions start_;
  ArgumentOf<Eigen::Vector2d> velocity_;
  ArgumentOf<Eigen::Vector3d> angular_velocity_;
  LawOption law_;
  ArgumentOf<bool> integrated_;
  InstantsOption instants_;
  ArgumentOf<double> until_;
  OutputOptions output_{{{"a motion", with_pictures(answer_formats("csv"))}}};
};

const RegisteredVerb<RollCommand> roll_verb(
    "roll", "The whole motion of a ball: t,x,y,vx,vy,wx,wy,wz,slip,energy",
    "contensou roll --ball pool --velocity 1,0 --angular-velocity 40,35,-50 --format text");

}  // namespace

}  // namespace contensou::program
