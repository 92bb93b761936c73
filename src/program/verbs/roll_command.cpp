#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "contensou/portraits/roll_figure.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/si/ball_motion.hpp"
#include "contensou/si/bridge.hpp"
#include "contensou/si/integrated_motion.hpp"
#include "contensou/si/uncoupled_motion.hpp"
#include "options/figure_options.hpp"
#include "options/instants_option.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

/// The whole motion of a ball.
struct Roll {
  si::Shot shot;
  reduction::Law law;
  bool integrated;       ///< the route of its columns: the equations of motion instead of the similarity solution
  double rolling_below;  ///< m/s of slip
  si::BallMotion whole{shot, law};
  si::UncoupledMotion textbook{shot, law};

  si::MotionColumns at_times(const Eigen::ArrayXd& times) const {
    return integrated ? si::integrate_motion(shot, law, times).points : whole.at_times(times);
  }

  /// Where a series of instants ends unless the user says otherwise, in s: a little past the stop.
  double standard_end() const { return whole.stop_time() > 0 ? 1.1 * whole.stop_time() : 1; }
};

/// What happens in a motion, and where. SI.
struct Events {
  double rolls, spin_ends;
  Eigen::Vector2d rolls_at, spin_ends_at;
  double slip_length, turns, path;  ///< path: until it rolls
};

/// @param motion  BallMotion or UncoupledMotion
/// @param rolling_below  m/s of slip
template <class Motion>
Events events_of(const Motion& motion, double rolling_below) {
  const double rolls = motion.slip_time(rolling_below);
  const double spin_ends = motion.spin_end();
  return {rolls,
          spin_ends,
          motion.at_time(rolls).position,
          motion.at_time(spin_ends).position,
          motion.slip_length(),
          motion.spin_angle() / (2 * std::numbers::pi),
          motion.path_length(rolls)};
}

Json members_of(const Events& events) {
  const auto& [rolls, spin_ends, rolls_at, spin_ends_at, slip_length, turns, path] = events;
  return {{"rolls_after", {{"t", rolls}, {"x", rolls_at.x()}, {"y", rolls_at.y()}}},
          {"spin_ends", {{"t", spin_ends}, {"x", spin_ends_at.x()}, {"y", spin_ends_at.y()}}},
          {"slip_length", slip_length},
          {"turns", turns},
          {"path", path}};
}

/// What friction takes of the kinetic energy, in J.
struct EnergyBalance {
  double start;
  si::EnergyLoss loss;
  double kept;
};

EnergyBalance energy_balance(const si::Shot& shot) {
  const auto [velocity, angular_velocity] = si::final_motion(shot);
  return {si::kinetic_energy(shot.ball, si::velocities_of(shot.start)), si::energy_loss(shot),
          si::kinetic_energy(shot.ball, {velocity, angular_velocity})};
}

std::string heading(const si::Shot& shot, const reduction::Law& law, const Digits& digits) {
  const si::Velocities start = si::velocities_of(shot.start);
  return fmt::format(
      "{}: radius {} m, mass {} kg, friction {}, patch radius {} m (mu = {})\n"
      "velocity {} m/s, angular velocity {} 1/s: slip {} m/s, spin {} rad/s\n",
      shot.ball.name, digits(shot.ball.radius), digits(shot.ball.mass), digits(shot.contact.friction),
      digits(si::patch_radius_of(shot, law)), digits(si::patch_ratio(shot, law)), digits.list(start.velocity),
      digits.list(start.angular_velocity), digits(si::slip_at_start(shot)), digits(si::spin_at_start(shot)));
}

std::string table(const Roll& roll, const Digits& digits) {
  const Events ours = events_of(roll.whole, roll.rolling_below);
  const Events theirs = events_of(roll.textbook, roll.rolling_below);
  std::string text;
  const auto line = [&, width = std::max(26, 2 * digits.count + 16)](const std::string& label, const std::string& first,
                                                                     const std::string& second,
                                                                     const std::string& unit) {
    text += fmt::format("{:<24}{:>{}}{:>{}}{}\n", label, first, width, second, width, unit);
  };
  const auto number = [&](const std::string& label, double Events::*value, const std::string& unit) {
    line(label, digits(ours.*value), digits(theirs.*value), "  " + unit);
  };
  const auto place = [&](Eigen::Vector2d Events::*value) {
    line("  at", digits.list(ours.*value), digits.list(theirs.*value), "  m");
  };
  line("", "law " + roll.law.name(), "textbook (uncoupled)", "");
  number("rolls after", &Events::rolls, "s");
  place(&Events::rolls_at);
  if (si::spin_at_start(roll.shot) != 0) {
    number("spins no more after", &Events::spin_ends, "s");
    place(&Events::spin_ends_at);
    number("turned about vertical", &Events::turns, "turns");
  }
  number("length of slip", &Events::slip_length, "m");
  number("path until it rolls", &Events::path, "m");
  const bool spins_too = si::spin_at_start(roll.shot) != 0 && si::slip_at_start(roll.shot) > 0;
  text += fmt::format("\nrolls  once its slip is below {} m/s{} (--rolling-below){}\n", digits(roll.rolling_below),
                      roll.rolling_below == si::rolling_slip ? ", which no eye tells from rolling" : "",
                      spins_too ? ";\n       the last of it ends with the spin" : "");
  if (roll.law.as<reduction::PadeLaw>() != nullptr)
    text += fmt::format("pade   the paper's approximation,\n       {}\n", cost_of_pade);
  return text;
}

std::string ending(const si::Shot& shot, const Digits& digits) {
  const auto [velocity, angular_velocity] = si::final_motion(shot);
  const auto [start, loss, kept] = energy_balance(shot);
  std::string text = fmt::format("then   it rolls straight on: velocity {} m/s, angular velocity {} 1/s\n",
                                 digits.list(velocity), digits.list(angular_velocity));
  if (velocity.norm() > 0) {
    const double degrees = std::atan2(velocity.y(), velocity.x()) * (180 / std::numbers::pi);
    text += fmt::format("       at {} m/s, {} degrees from the x axis\n", digits(velocity.norm()), digits(degrees));
  }
  return text + fmt::format("energy {} J: {} lost by sliding, {} by spinning, {} kept\n", digits(start),
                            digits(loss.sliding), digits(loss.pivoting), digits(kept));
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

/// Columns of the motion, and its events.
/// @param times  s
Answer table_of(const Roll& roll, const Eigen::ArrayXd& times) {
  const auto [velocity, angular_velocity] = si::velocities_of(roll.shot.start);
  const auto [start, loss, kept] = energy_balance(roll.shot);
  const si::MotionColumns motion = roll.at_times(times);
  Json members{{"law", roll.law.name()},
               {"route", roll.integrated ? "integrated" : "reduced"},
               {"mu", si::patch_ratio(roll.shot, roll.law)},
               {"velocity", std::vector(velocity.begin(), velocity.end())},
               {"angular_velocity", std::vector(angular_velocity.begin(), angular_velocity.end())},
               {"t_stop", roll.whole.stop_time()}};
  members.update(members_of(events_of(roll.whole, roll.rolling_below)));
  members["rolls_after"]["threshold"] = roll.rolling_below;
  members["energy_balance"] = {
      {"start", start}, {"lost_sliding", loss.sliding}, {"lost_spinning", loss.pivoting}, {"kept", kept}};
  members["textbook"] = members_of(events_of(roll.textbook, roll.rolling_below));
  return {.members = members,
          .columns = {{"t", motion.t},
                      {"x", motion.x},
                      {"y", motion.y},
                      {"vx", motion.vx},
                      {"vy", motion.vy},
                      {"wx", motion.wx},
                      {"wy", motion.wy},
                      {"wz", motion.wz},
                      {"slip", motion.slip},
                      {"energy", motion.energy}},
          .remarks = members};
}

/// The motion on one screen: where and when the ball ceases to slip, how it rolls on, what friction took, and the
/// textbook's answer beside it. For the route integrated, how close its stop is.
std::string report_on(const Roll& roll, const Digits& digits) {
  const std::string text =
      heading(roll.shot, roll.law, digits) + "\n" + table(roll, digits) + "\n" + ending(roll.shot, digits);
  if (!roll.integrated) return text;
  const si::IntegratedMotion motion = si::integrate_motion(roll.shot, roll.law, {});
  return text +
         fmt::format("route integrated: slip and spin end after {} s, {:.1g} from the reduced route, in {} steps\n",
                     digits(motion.stop_time), std::abs(motion.stop_time - roll.whole.stop_time()), motion.steps);
}

/// The picture of the motion up to a time in s, beside the textbook's.
portraits::RollPicture picture_of(const Roll& roll, double end) {
  const auto& [shot, law, integrated, rolling_below, whole, textbook] = roll;
  const double rolls = whole.slip_time(rolling_below);
  const double textbook_rolls = textbook.slip_time(rolling_below);
  const Eigen::ArrayXd times = instants(std::max(rolls, textbook_rolls), end);
  const double slip = si::slip_at_start(shot);
  const double spin = si::spin_at_start(shot);
  portraits::RollPicture picture{
      .title = fmt::format("{},  {{/:Italic μ}} = {:.4g},  law: {}", portraits::literal(shot.ball.name),
                           si::patch_ratio(shot, law), portraits::literal(law.name())),
      .subtitle = fmt::format("slip {:.4g} m/s, spin {:.4g} rad/s", slip, spin),
      .ball = curve(shot, roll.at_times(times), rolls),
      .textbook = curve(shot, textbook.at_times(times), textbook_rolls)};
  if (slip > 0) {
    picture.subtitle += fmt::format("; it rolls after {:.3g} s (textbook {:.3g} s)", rolls, textbook_rolls);
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
    rolling_below_.add(app, "--rolling-below", "SPEED",
                       fmt::format("the ball rolls once it slips slower, in m/s (default {})", si::rolling_slip),
                       [](const std::string& typed) {
                         const double speed = parse_number(typed);
                         if (speed < 0) throw NotAllowed("a speed of slip is >= 0, in m/s");
                         return speed;
                       });
    figure_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    const Output output = output_.read();
    const reduction::Law law = law_.read();
    const Roll roll{read_shot(law), law, integrated_.value_or(false), rolling_below_.value_or(si::rolling_slip)};
    const double end = until_.value_or(roll.standard_end());
    if (output.picture()) {
      if (instants_.given()) throw BadInput("a picture needs no --at or --samples: leave them out");
      portraits::RollPicture picture = picture_of(roll, end);
      picture.size = figure_.size();
      output.write(figure_.apply(portraits::roll_figure(picture), output.format));
    } else if (output.format == "text" && !instants_.given() && !until_.given()) {
      output.write(report_on(roll, output.digits));
    } else {
      const auto* at = instants_.at();
      output.write(table_of(roll, at != nullptr ? *at : Eigen::ArrayXd::LinSpaced(instants_.samples(), 0, end)));
    }
    return ExitStatus::done;
  }

 private:
  si::Shot read_shot(const reduction::Law& law) const {
    const si::StartOverride start{velocity_.optional(), angular_velocity_.optional()};
    if ((start.velocity || start.angular_velocity) && start_.overrides_start()) {
      throw BadInput("--slip, --spin and --velocity, --angular-velocity exclude each other: give one pair of them");
    }
    return start_.read_ball(law, start);
  }

  StartOptions start_;
  ArgumentOf<Eigen::Vector2d> velocity_;
  ArgumentOf<Eigen::Vector3d> angular_velocity_;
  LawOption law_;
  ArgumentOf<bool> integrated_;
  InstantsOption instants_;
  ArgumentOf<double> until_, rolling_below_;
  FigureOptions figure_;
  OutputOptions output_{{{"a motion", with_pictures(answer_formats("csv"))}}};
};

const RegisteredVerb<RollCommand> roll_verb(
    "roll", "The whole motion of a ball: t,x,y,vx,vy,wx,wy,wz,slip,energy",
    "contensou roll --ball pool --velocity 1,0 --angular-velocity 40,35,-50 --format text");

}  // namespace

}  // namespace contensou::program
