#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "answers/ball_answer.hpp"
#include "answers/law_forms.hpp"
#include "answers/load_table.hpp"
#include "answers/roll_uncertainty.hpp"
#include "contensou/portraits/roll_figure.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/si/ball_motion.hpp"
#include "contensou/si/course.hpp"
#include "contensou/si/cue_strike.hpp"
#include "contensou/si/integrated_motion.hpp"
#include "contensou/si/loaded_motion.hpp"
#include "contensou/si/quantity.hpp"
#include "contensou/si/scaling.hpp"
#include "contensou/si/shots.hpp"
#include "contensou/si/uncoupled_motion.hpp"
#include "options/bulk_options.hpp"
#include "options/figure_options.hpp"
#include "options/instants_option.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "output/batch.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

/// The whole motion of a ball, or of a body that lies flat.
struct Roll {
  si::Experiment experiment;
  reduction::Law law;
  bool integrated;       ///< the route of its columns: the equations of motion instead of the similarity solution
  double rolling_below;  ///< m/s of slip
  std::optional<si::LoadHistory> load = {};
  double rolling_friction = experiment.contact.rolling_friction;
  si::Course<si::Loaded<si::BallMotion>> whole{
      experiment, {experiment, {experiment, law}, load}, rolling_below, rolling_friction};
  si::Course<si::Loaded<si::UncoupledMotion>> textbook{
      experiment, {experiment, {experiment, law}, load}, rolling_below, rolling_friction};
  /// With rolling friction or on a slope, by the route integrated.
  std::optional<si::ResistedMotion> in_steps =
      integrated && whole.resisted ? std::optional<si::ResistedMotion>({experiment, law, rolling_friction, true})
                                   : std::nullopt;

  /// How the events are found.
  bool reduced() const { return !whole.resisted || whole.resisted->is_reduced(); }
  bool lies_flat() const { return experiment.ball.body.lies_flat(); }
  double stop_time() const { return whole.resisted ? whole.resisted->stop_time() : whole.motion.stop_time(); }

  si::MotionColumns at_times(const Eigen::ArrayXd& times) const {
    if (!integrated) return whole.at_times(times);
    if (!in_steps) return si::integrate_motion(experiment, law, times).points;
    si::MotionColumns columns(times.size());
    for (Eigen::Index i = 0; i < times.size(); ++i) columns.set(i, in_steps->at_time(times[i]));
    return columns;
  }

  /// Where a series of instants ends unless the user says otherwise, in s: a little past the stop, and the rest.
  double standard_end() const {
    const auto rest = whole.rest();
    const double end = std::max(stop_time(), rest ? rest->t : 0);
    return end > 0 ? 1.1 * end : 1;
  }
};

Json members_of(const si::Event& event) { return {{"t", event.t}, {"x", event.place.x()}, {"y", event.place.y()}}; }

/// @param threshold  m/s, below which it rolls; null for what has none
Json members_of(const si::Events& events, bool lies_flat, const double* threshold = nullptr) {
  const auto& [rolls, spin_ends, rest, slip_length, turns, path] = events;
  Json members;
  if (!lies_flat) members["rolls_after"] = members_of(rolls);
  if (!lies_flat && threshold) members["rolls_after"]["threshold"] = *threshold;
  members["spin_ends"] = members_of(spin_ends);
  if (lies_flat || rest) members["rest"] = members_of(lies_flat ? rolls : *rest);
  members.update({{"slip_length", slip_length}, {"turns", turns}, {"path", path}});
  return members;
}

/// What friction takes of the kinetic energy, in J.
struct EnergyBalance {
  double start;
  si::EnergyLoss loss;
  double kept;
  double rolling = 0;  ///< lost to rolling resistance
  double gained = 0;   ///< on a slope
};

EnergyBalance energy_balance(const Roll& roll) {
  const si::Experiment& experiment = roll.experiment;
  const double start = si::kinetic_energy(experiment.ball, si::velocities_of(experiment.start));
  const si::EnergyLoss loss = si::energy_loss(experiment);
  if (const auto& resisted = roll.whole.resisted) {  // spin has lost what it had
    const double rolling = resisted->rolling_loss(), gained = resisted->gained_on_slope();
    const double kept = resisted->at_time(resisted->last_time()).energy;
    return {start, {start + gained - loss.pivoting - rolling - kept, loss.pivoting}, kept, rolling, gained};
  }
  const auto [velocity, angular_velocity] = si::final_motion(experiment);
  return {start, loss, si::kinetic_energy(experiment.ball, {velocity, angular_velocity})};
}

std::string heading(const si::Experiment& experiment, const reduction::Law& law, const Digits& digits) {
  const si::Velocities start = si::velocities_of(experiment.start);
  return ball_heading(experiment, law, digits) +
         fmt::format("velocity {} m/s, angular velocity {} 1/s: slip {} m/s, spin {} rad/s\n",
                     digits.list(start.velocity), digits.list(start.angular_velocity),
                     digits(si::slip_at_start(experiment)), digits(si::spin_at_start(experiment)));
}

std::string table(const Roll& roll, const Digits& digits) {
  const si::Events ours = events_of(roll.whole);
  const si::Events theirs = events_of(roll.textbook);
  std::string text;
  const auto line = [&, width = std::max(26, 2 * digits.count + 16)](const std::string& label, const std::string& first,
                                                                     const std::string& second,
                                                                     const std::string& unit) {
    text += fmt::format("{:<24}{:>{}}{:>{}}{}\n", label, first, width, second, width, unit);
  };
  const auto number = [&](const std::string& label, double first, double second, const std::string& unit) {
    line(label, digits(first), digits(second), "  " + unit);
  };
  const auto event = [&](const std::string& label, const si::Event& first, const si::Event& second) {
    number(label, first.t, second.t, "s");
    line("  at", digits.list(first.place), digits.list(second.place), "  m");
  };
  line("", "law " + roll.law.name(), "textbook (uncoupled)", "");
  const bool flat = roll.lies_flat();
  event(flat ? "its centre rests after" : "rolls after", ours.rolls, theirs.rolls);
  if (ours.rest && theirs.rest && !flat) event("its centre rests after", *ours.rest, *theirs.rest);
  if (si::spin_at_start(roll.experiment) != 0) {
    event("spins no more after", ours.spin_ends, theirs.spin_ends);
    number("turned about vertical", ours.turns, theirs.turns, "turns");
  }
  number("length of slip", ours.slip_length, theirs.slip_length, "m");
  number(flat ? "path until it rests" : "path until it rolls", ours.path, theirs.path, "m");
  const bool spins_too = si::spin_at_start(roll.experiment) != 0 && si::slip_at_start(roll.experiment) > 0;
  if (!flat)
    text += fmt::format("\nrolls  once its slip is below {} m/s{} (--rolling-below){}\n", digits(roll.rolling_below),
                        roll.rolling_below == si::rolling_slip ? ", which no eye tells from rolling" : "",
                        spins_too ? ";\n       the last of it ends with the spin" : "");
  if (roll.law.as<reduction::PadeLaw>() != nullptr)
    text += fmt::format("pade   the paper's approximation,\n       {}\n", cost_of_pade);
  return text;
}

/// How rolling resistance and a slope act, and what found the motion.
std::string resistance_text(const Roll& roll, const Digits& digits) {
  const si::Environment& environment = roll.experiment.environment;
  std::string text;
  if (environment.slope != 0)
    text += fmt::format("slope  {} degrees, {} along x: gravity pulls by {} m/s^2 and presses by {} m/s^2\n",
                        digits(environment.slope), environment.slope > 0 ? "uphill" : "downhill",
                        digits(si::pull(environment).norm()), digits(si::pressing(environment)));
  if (roll.rolling_friction > 0)
    text += fmt::format(
        "rolling resistance slows it down by u_r g = {} m/s^2 when it rolls without slip; it acts all the time\n",
        digits(roll.rolling_friction * si::pressing(environment)));
  if (const auto k = roll.whole.resisted->creep_ratio()) {
    const double rim = *k * si::patch_radius_of(roll.experiment, roll.law);
    text +=
        fmt::format("creeps while it spins: its slip tends to {} m times its spin, k = {}\n", digits(rim), digits(*k));
  }
  const auto pieces = roll.whole.resisted->pieces();
  text += !roll.reduced()  ? "route  integrated: the slip turns, which is no reduced motion\n"
          : pieces.empty() ? "route  reduced: it does not slide\n"
                           : fmt::format("route  reduced: it slides the way it rolls, with a drive of {}\n",
                                         digits(pieces.front().system.drive()));
  if (roll.lies_flat()) return text;
  return text + (roll.whole.rest()
                     ? fmt::format("rests  once it no longer turns and slides below {} m/s\n", digits(si::resting_slip))
                     : "then   it rolls down the slope for ever\n");
}

std::string ending(const Roll& roll, const Digits& digits) {
  const si::Experiment& experiment = roll.experiment;
  const auto [velocity, angular_velocity] = si::final_motion(experiment);
  const auto [start, loss, kept, rolling, gained] = energy_balance(roll);
  const bool slopes = experiment.environment.slope != 0;
  const std::string energy =
      fmt::format("energy {} J{}: {} lost by sliding, {} by spinning, {}{} kept{}\n", digits(start),
                  slopes ? fmt::format(" and {} J of the slope", digits(gained)) : "", digits(loss.sliding),
                  digits(loss.pivoting), rolling > 0 ? fmt::format("{} by rolling, ", digits(rolling)) : "",
                  digits(kept), slopes && !roll.whole.rest() ? " when slip and spin end" : "");
  const std::string resistance = roll.whole.resisted ? resistance_text(roll, digits) : "";
  if (roll.lies_flat()) return resistance + "then   it lies still\n" + energy;
  if (roll.whole.resisted) return resistance + energy;
  std::string text = fmt::format("then   it rolls straight on: velocity {} m/s, angular velocity {} 1/s\n",
                                 digits.list(velocity), digits.list(angular_velocity));
  if (velocity.norm() > 0) {
    const double degrees = std::atan2(velocity.y(), velocity.x()) * (180 / std::numbers::pi);
    text += fmt::format("       at {} m/s, {} degrees from the x axis\n", digits(velocity.norm()), digits(degrees));
  }
  return text + energy;
}

portraits::RollCurve curve(const si::Experiment& experiment, const si::MotionColumns& motion, double rolls) {
  return {.t = motion.t,
          .x = motion.x,
          .y = motion.y,
          .slip = motion.slip,
          .rim = experiment.ball.radius * motion.wz.abs(),
          .speed = (motion.vx.square() + motion.vy.square()).sqrt(),
          .rolls = rolls,
          .angular_velocity = (Eigen::Matrix3Xd(3, motion.rows()) << motion.wx.matrix().transpose(),
                               motion.wy.matrix().transpose(), motion.wz.matrix().transpose())
                                  .finished()};
}

/// Columns of the motion, and its events.
/// @param times  s
Answer table_of(const Roll& roll, const Eigen::ArrayXd& times, const std::optional<RollUncertainty>& uncertainty) {
  const auto [velocity, angular_velocity] = si::velocities_of(roll.experiment.start);
  const auto [start, loss, kept, rolling, gained] = energy_balance(roll);
  const si::MotionColumns motion = roll.at_times(times);
  Json members{{"law", roll.law.name()},
               {"route", roll.integrated || !roll.reduced() ? "integrated" : "reduced"},
               {"mu", si::patch_ratio(roll.experiment, roll.law)},
               {"ball", members_of_ball(roll.experiment, roll.law)},
               {"velocity", std::vector(velocity.begin(), velocity.end())},
               {"angular_velocity", std::vector(angular_velocity.begin(), angular_velocity.end())},
               {"t_stop", roll.stop_time()}};
  if (roll.load) members["load"] = {{"t", roll.load->instants()}, {"load", roll.load->loads()}};
  members.update(members_of(events_of(roll.whole), roll.lies_flat(), &roll.rolling_below));
  if (roll.whole.resisted) {
    if (const auto k = roll.whole.resisted->creep_ratio()) members["creeps"] = {{"k", *k}};
  }
  if (roll.in_steps) {
    members["integrated"] = {{"t_stop", roll.in_steps->stop_time()},
                             {"slip_length", roll.in_steps->slip_length()},
                             {"turns", roll.in_steps->spin_angle() / (2 * std::numbers::pi)}};
    if (const auto rest = rest_of(*roll.in_steps)) members["integrated"]["rest"] = members_of(*rest);
  } else if (roll.integrated) {
    const si::IntegratedMotion by_steps = si::integrate_motion(roll.experiment, roll.law, {});
    members["integrated"] = {{"t_stop", by_steps.stop_time},
                             {"slip_length", by_steps.slip_length},
                             {"turns", by_steps.spin_angle / (2 * std::numbers::pi)},
                             {"steps", by_steps.steps}};
  }
  members["energy_balance"] = {
      {"start", start}, {"lost_sliding", loss.sliding}, {"lost_spinning", loss.pivoting}, {"kept", kept}};
  if (roll.whole.resisted) members["energy_balance"]["lost_rolling"] = rolling;
  if (roll.experiment.environment.slope != 0) members["energy_balance"]["gained_on_slope"] = gained;
  members["textbook"] = members_of(events_of(roll.textbook), roll.lies_flat());
  if (uncertainty) members["uncertainty"] = members_of(*uncertainty);
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
std::string report_on(const Roll& roll, const Digits& digits, const std::optional<RollUncertainty>& uncertainty) {
  const std::string text = heading(roll.experiment, roll.law, digits) +
                           (roll.load ? fmt::format("the load changes: {} N is its first, {} N its last\n",
                                                    digits(roll.load->nominal()), digits(roll.load->loads().back()))
                                      : "") +
                           "\n" + table(roll, digits) + "\n" +
                           (uncertainty ? text_of(*uncertainty, digits) + "\n" : "") + ending(roll, digits);
  if (roll.in_steps) {
    const auto rest = rest_of(*roll.in_steps);
    return text + fmt::format("route integrated: {}slip and spin end after {} s\n",
                              rest ? fmt::format("its centre rests after {} s at {} m, ", digits(rest->t),
                                                 digits.list(rest->place))
                                   : "",
                              digits(roll.in_steps->stop_time()));
  }
  if (!roll.integrated) return text;
  const si::IntegratedMotion motion = si::integrate_motion(roll.experiment, roll.law, {});
  return text +
         fmt::format(
             "route integrated: slip and spin end after {} s, {:.1g} from the reduced route, whose events are those "
             "above;\n       it slips {} m and turns {} times, in {} steps\n",
             digits(motion.stop_time), std::abs(motion.stop_time - roll.stop_time()), digits(motion.slip_length),
             digits(motion.spin_angle / (2 * std::numbers::pi)), motion.steps);
}

/// The picture of the motion at these instants, beside the textbook's.
portraits::RollPicture picture_of(const Roll& roll, const Eigen::ArrayXd& times) {
  const auto& [experiment, law, integrated, rolling_below, load, rolling_friction, whole, textbook, in_steps] = roll;
  const double rolls = whole.rolls;
  const double textbook_rolls = textbook.rolls;
  const double slip = si::slip_at_start(experiment);
  const double spin = si::spin_at_start(experiment);
  portraits::RollPicture picture{.title = portraits::title_of(portraits::shortened(experiment.ball.name),
                                                              fmt::format("{:.4g}", si::patch_ratio(experiment, law)),
                                                              portraits::shortened(law.name())),
                                 .subtitle = fmt::format("slip {:.4g} m/s, spin {:.4g} rad/s", slip, spin),
                                 .ball = curve(experiment, roll.at_times(times), rolls),
                                 .textbook = curve(experiment, textbook.at_times(times), textbook_rolls),
                                 .lies_flat = roll.lies_flat()};
  const auto seconds = [](double time) { return portraits::unbroken(fmt::format("{:.3g} s", time)); };
  if (slip > 0) {
    picture.subtitle += fmt::format("; it {} after {}, the textbook's after {}", roll.lies_flat() ? "rests" : "rolls",
                                    seconds(rolls), seconds(textbook_rolls));
  }
  if (spin != 0) picture.subtitle += fmt::format("; its spin lasts {}", seconds(roll.stop_time()));
  if (const auto rest = whole.rest()) {
    const auto& place = rest->place;
    picture.subtitle += fmt::format("; it rests after {} at {}", seconds(rest->t),
                                    portraits::unbroken(fmt::format("({:.3g}, {:.3g}) m", place.x(), place.y())));
  }
  return picture;
}

double not_negative(double value) {
  if (value < 0) throw NotAllowed("0 or more is needed");
  return value;
}

double parse_end(const std::string& typed) {
  const double end = parse_quantity(typed, "s");
  if (!(end > 0)) throw NotAllowed("a time after the start is needed, in s");
  return end;
}

constexpr long max_frames = 1000;  ///< of a film: 40 s

class RollCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    start_.take_load_history();
    start_.add_ball(app, "a ball in SI units, built in or from a run file");
    app.option_defaults()->group("Stroke of a cue, along x (in place of the ball's own start)");
    strike_.add(app, "--strike", "SPEED",
                "of the cue, in metres per second: an elastic impulse along it. Left out are squirt, miscues within "
                "--tip's limit, the ball's bounce off the table and its friction there, and other balls (throw)",
                quantity("m/s"));
    tip_.add(app, "--tip", "A,B",
             fmt::format("where it strikes, to the right of and above the centre as seen along the cue, in radii, at "
                         "most {} from it (default 0,0)",
                         si::largest_tip_offset),
             [](const std::string& typed) { return Eigen::Vector2d(numbers(typed, 2, "A,B").data()); });
    elevation_.add(app, "--elevation", "ANGLE", "of the cue's butt, 0 to below 90 degrees (default 0)",
                   quantity("deg"));
    cue_mass_.add(app, "--cue-mass", "MASS", fmt::format("in kilograms (default {})", si::standard_cue_mass),
                  quantity("kg"));
    law_.add(app);
    integrated_.add(app, "--route", "ROUTE",
                    "reduced: the similarity solution (default), or integrated: the five equations of motion (2.5)",
                    one_of<bool>({{"reduced", false}, {"integrated", true}}, "route"));
    app.option_defaults()->group("Rolling");
    rolling_below_.add(
        app, "--rolling-below", "SPEED",
        fmt::format(
            "of the slip, in metres per second, below which it rolls (default {}); of the textbook's ball, too, "
            "which at 0 rolls after 2 v/(7 f g) if homogeneous",
            si::rolling_slip),
        [](const std::string& typed) { return not_negative(parse_quantity(typed, "m/s")); });
    uncertainty_.add(app, "--uncertainty", "NAME=SPREAD,...",
                     "standard deviations of numbers of the ball and its start, such as slip=1%,friction=5%, or of "
                     "vx, vy, wx, wy, wz: what the events are known to");
    CLI::Option* at = instants_.add(app, "t", "s", "");
    until_.add(app, "--until", "TIME", "the last of them, in seconds (default: a little past the stop)", parse_end)
        ->excludes(at);
    app.option_defaults()->group("Many starts");
    batch_.add(app, "--batch", "FILE",
               "CSV with columns slip,spin or vx,vy,wx,wy,wz in SI units, to which it adds the events; - is standard "
               "input");
    app.add_flag("--keep-going", keep_going_, "leave the results of a bad row empty and go on");
    bulk_.add(app);
    figure_.add(app);
    output_.add(app);
  }

  ExitStatus run() override {
    if (batch_.given()) return run_many();
    if (keep_going_) throw BadInput("--keep-going is for many starts: add --batch FILE");
    bulk_.refuse("many starts: add --batch FILE");
    const Output output = output_.read();
    figure_.require_picture(output);
    const reduction::Law law = law_.read(start_.standard_law());
    const si::Experiment experiment = read_shot(law);
    const Roll roll{experiment, law, integrated_.value_or(false), rolling_below_.value_or(si::rolling_slip),
                    load_for(experiment, law)};
    const auto* at = instants_.at();
    const double last = at != nullptr && at->values.size() > 0 ? at->values.maxCoeff() : until_.value_or(0);
    si::require_finite_motion(roll.experiment, roll.stop_time(), last);
    const double end = until_.value_or(roll.standard_end());
    const auto uncertainty = read_uncertainty(roll);
    if (output.picture()) {
      if (uncertainty) throw BadInput("--uncertainty is of numbers: leave it out of a picture");
      const bool moves = output.picture() == portraits::PictureFormat::gif;
      if (instants_.at() != nullptr || instants_.equidistant() || (instants_.asked() && !moves)) {
        throw BadInput("a picture needs no --at, --samples or --equidistant, a film --samples alone: leave them out");
      }
      if (instants_.asked() > max_frames) {
        throw BadInput(fmt::format("a film has at most {} frames, got --samples {}", max_frames, *instants_.asked()));
      }
      if (si::kinetic_energy(roll.experiment.ball, si::velocities_of(roll.experiment.start)) == 0) {
        throw BadInput("the ball is at rest, there is nothing to draw: give it a --slip, a --spin or a --velocity");
      }
      const double rolls = std::max(roll.whole.rolls, roll.textbook.rolls);
      const double film_end = rolls > 0 && !until_.given() ? std::min(1.6 * rolls, end) : end;
      const auto [film_times, slow] = portraits::film_pace(film_end, instants_.asked());
      portraits::RollPicture picture =
          picture_of(roll, moves ? film_times : end * Eigen::ArrayXd::LinSpaced(500, 0, 1).cube());
      picture.size = figure_.size();
      picture.slow = moves ? slow : 0;
      picture.whole_path = until_.given();
      std::vector<portraits::Figure> figures =
          moves ? portraits::roll_film(picture) : std::vector{portraits::roll_figure(picture)};
      for (portraits::Figure& figure : figures) figure = figure_.apply(std::move(figure), output.format);
      output.write(figures);
    } else if (output.format == "text" && !instants_.given() && !until_.given()) {
      output.write(report_on(roll, output.digits, uncertainty));
    } else {
      output.write(table_of(roll, instants_.between(roll.whole.rolls, end), uncertainty));
    }
    return ExitStatus::done;
  }

 private:
  std::optional<RollUncertainty> read_uncertainty(const Roll& roll) const {
    if (!uncertainty_.given()) return std::nullopt;
    if (roll.load) uncertainty_.reject("it is of a constant load: give --load a number");
    try {
      return roll_uncertainty(roll.experiment, roll.law, roll.rolling_below, uncertainty_.text());
    } catch (const BadInput& error) {
      uncertainty_.reject(error.what());
    }
  }

  ExitStatus run_many() const {
    const std::string others =
        names_given({&strike_, &tip_, &elevation_, &cue_mass_, &integrated_, &until_, &uncertainty_});
    if (!others.empty() || start_.overrides_start() || instants_.given()) {
      throw BadInput(fmt::format("--batch has the starts in the file, and gives events alone: leave out {}",
                                 !others.empty()     ? others
                                 : instants_.given() ? "--at, --samples"
                                                     : start_.start_names()));
    }
    const Output out = output_.read(1);
    const reduction::Law law = law_.read(start_.standard_law());
    const si::Experiment still = start_.read_ball(law, at_rest("--batch"));
    require_rolling_options(still);
    if (start_.load_history()) throw BadInput("--batch is of a constant load: give --load a number");
    const std::string rolls = still.ball.body.lies_flat() ? "rest" : "rolls";
    const double chi = still.ball.body.inertia.chi, u_r = still.contact.rolling_friction;
    const si::Shots shots(still, law, rolling_below_.value_or(si::rolling_slip), u_r);
    // Else it rolls down for ever.
    const bool may_rest = u_r * si::pressing(still.environment) > (1 - 1 / chi) * si::pull(still.environment).norm();
    OutputFile output(out.path);
    CsvReader table(batch_.text());
    const std::vector<std::string> along_x{"slip", "spin"}, velocities{"vx", "vy", "wx", "wy", "wz"};
    const auto has = [&](const std::string& column) { return table.has_column(column); };
    const bool general = std::ranges::any_of(velocities, has);
    if (general && std::ranges::any_of(along_x, has)) {
      throw table.complaint(table.header_line(),
                            "columns slip, spin and vx, vy, wx, wy, wz exclude each other: keep one kind of start");
    }
    BatchRequest request{.inputs = general ? velocities : along_x,
                         .results = {"t_" + rolls, "x_" + rolls, "y_" + rolls, "t_spin_ends", "x_spin_ends",
                                     "y_spin_ends", "slip_length", "turns", "path"},
                         .compute =
                             [&](std::span<const double> row, std::span<double> results, long /*line*/) {
                               if (general) {
                                 write(shots.from(si::Velocities{{row[0], row[1]}, {row[2], row[3], row[4]}}), results);
                               } else {
                                 write(shots.from(si::SlipAndSpin{row[0], row[1]}), results);
                               }
                             },
                         .keep_going = keep_going_,
                         .threads = bulk_.threads(),
                         .progress = bulk_.progress(out.path)};
    if (may_rest) request.results.insert(request.results.end(), {"t_rest", "x_rest", "y_rest"});
    const ExitStatus status = run_batch(table, output, request);
    output.finish();
    return status;
  }

  /// The events of a row.
  static void write(const si::Course<si::BallMotion>& course, std::span<double> results) {
    const auto [rolls, spin_ends, rest, slip_length, turns, path] = events_of(course);
    auto place = results.begin();
    const auto add = [&](const si::Event& event) {
      for (double value : {event.t, event.place.x(), event.place.y()}) *place++ = value;
    };
    add(rolls);
    add(spin_ends);
    for (double value : {slip_length, turns, path}) *place++ = value;
    constexpr double never = std::numeric_limits<double>::infinity();
    if (place != results.end()) add(rest.value_or(si::Event{never, {never, never}}));
  }

  /// The load, if it changes.
  /// @throws BadInput  where the patch would change with it, and for what is of a constant load
  std::optional<si::LoadHistory> load_for(const si::Experiment& experiment, const reduction::Law& law) const {
    const auto load = start_.load_history();
    if (!load) return load;
    fmt::print(stderr, "{}",
               require_load_alone(experiment, law, integrated_.value_or(false) ? "--route integrated" : ""));
    return load;
  }

  /// @throws NotAllowed  for an option of rolling with a body that lies flat
  void require_rolling_options(const si::Experiment& experiment) const {
    if (!experiment.ball.body.lies_flat() || !rolling_below_.given()) return;
    rolling_below_.reject(fmt::format("a {} lies flat and never rolls: leave it out", experiment.ball.body.name));
  }

  si::Experiment read_shot(const reduction::Law& law) const {
    const std::string of_stroke = names_given({&tip_, &elevation_, &cue_mass_});
    if (!strike_.given()) {
      if (!of_stroke.empty()) throw BadInput(fmt::format("{} is of a stroke: add --strike SPEED", of_stroke));
      const si::Experiment experiment = start_.read_ball(law);
      require_rolling_options(experiment);
      return experiment;
    }
    if (start_.overrides_start())
      throw BadInput(fmt::format("--strike is a start of its own: leave out {}", start_.start_names()));
    si::Experiment experiment = start_.read_rolling_ball(law, at_rest(strike_.name()));
    const Eigen::Vector2d tip = tip_.value_or(Eigen::Vector2d::Zero());
    try {
      experiment.start = si::struck(experiment.ball, {.speed = *strike_,
                                                      .right = tip.x(),
                                                      .above = tip.y(),
                                                      .elevation = elevation_.value_or(0) * (std::numbers::pi / 180),
                                                      .mass = cue_mass_.value_or(si::standard_cue_mass)});
    } catch (const std::domain_error& error) {
      strike_.reject(error.what());
    }
    si::require_experiment(experiment);
    return experiment;
  }

  StartOptions start_;
  LawOption law_;
  ArgumentOf<bool> integrated_;
  InstantsOption instants_;
  ArgumentOf<double> until_, rolling_below_, strike_, elevation_, cue_mass_;
  ArgumentOf<Eigen::Vector2d> tip_;
  Argument batch_, uncertainty_;
  bool keep_going_ = false;
  BulkOptions bulk_;
  FigureOptions figure_;
  OutputOptions output_{{{"a motion", with_pictures(answer_formats("csv"), {"gif"})}, {"a table of motions", {"csv"}}}};
};

const RegisteredVerb<RollCommand> roll_verb(Purpose::compute, "roll",
                                            "The whole motion of a ball or a puck: t,x,y,vx,vy,wx,wy,wz,slip,energy",
                                            "contensou roll --ball gel --slip 0.5 --spin 300 --format text");

}  // namespace

}  // namespace contensou::program
