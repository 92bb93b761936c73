#include <algorithm>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "answers/input/tables.hpp"
#include "answers/verbs/ball_answers.hpp"
#include "contensou/portraits/roll_figure.hpp"
#include "contensou/si/experiment.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/quantity.hpp"
#include "contensou/si/scaling.hpp"
#include "options/instants_option.hpp"
#include "options/law_option.hpp"
#include "options/output_options.hpp"
#include "options/start_options.hpp"
#include "output/batch.hpp"
#include "verb.hpp"

namespace contensou::program {

namespace {

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

/// Returns the data for the picture of the motion at these instants. The data include that of the uncoupled model.
portraits::RollPicture picture_of(const Roll& roll, const Eigen::ArrayXd& times) {
  const si::Experiment& experiment = roll.experiment;
  const double rolls = roll.whole.rolls(roll.rolling_below);
  const double textbook_rolls = roll.textbook.rolls(roll.rolling_below);
  const double slip = si::slip_at_start(experiment);
  const double spin = si::spin_at_start(experiment);
  portraits::RollPicture picture{
      .title = portraits::title_of(portraits::shortened(experiment.ball.name),
                                   fmt::format("{:.4g}", si::patch_ratio(experiment, roll.law)),
                                   portraits::shortened(roll.law.name())),
      .subtitle = fmt::format("slip {:.4g} m/s, spin {:.4g} rad/s", slip, spin),
      .ball = curve(experiment, roll.at(times), rolls),
      .textbook = curve(experiment, roll.textbook.at(times), textbook_rolls),
      .lies_flat = roll.lies_flat()};
  const auto seconds = [](double time) { return portraits::unbroken(fmt::format("{:.3g} s", time)); };
  if (slip > 0) {
    picture.subtitle += fmt::format("; it {} after {}, the textbook's after {}", roll.lies_flat() ? "rests" : "rolls",
                                    seconds(rolls), seconds(textbook_rolls));
  }
  if (spin != 0) picture.subtitle += fmt::format("; its spin lasts {}", seconds(roll.whole.stop_time()));
  if (const auto rest = roll.whole.rest()) {
    const auto& place = rest->place;
    picture.subtitle += fmt::format("; it rests after {} at {}", seconds(rest->t),
                                    portraits::unbroken(fmt::format("({:.3g}, {:.3g}) m", place.x(), place.y())));
  }
  return picture;
}

constexpr long max_frames = 1000;  ///< largest number of frames of a film: 40 s

/// Columns of the tables that --batch reads.
constexpr ColumnText straight_shots{"slip,spin", "m/s, 1/s",
                                    "start with the slip along x; other columns are copied from the input"};
constexpr ColumnText general_shots{
    "vx,vy,wx,wy,wz", "m/s, 1/s", "velocity of the centre and angular velocity at the start, instead of slip and spin"};
constexpr std::initializer_list<ColumnText> shot_events{
    {"t_rolls,x_rolls,y_rolls", "s, m, m", "time and place at which the slip falls below --rolling-below"},
    {"t_spin_ends,x_spin_ends,y_spin_ends", "s, m, m", "time and place at which the spin ends; 0 if there was none"},
    {"slip_length,turns,path", "m, 1, m",
     "distance that the contact point slides, number of turns about the vertical, path of the centre until the body "
     "rolls or rests"},
    {"t_rest,x_rest,y_rest", "s, m, m",
     "time and place at which the centre comes to rest, for a puck or with --rolling-friction"}};

std::vector<FieldText> roll_batch_texts() {
  return joined({texts_of({straight_shots, general_shots}, "in: "), texts_of(shot_events, "out: ")});
}

class RollCommand final : public Verb {
 public:
  void add_options(CLI::App& app) override {
    start_.take_load_history();
    start_.take_own_body();
    start_.add_body(app);
    start_.add_ball(app);
    app.option_defaults()->group("Stroke of a cue along x, instead of the start of the ball");
    strike_.add(app, "--strike", "SPEED",
                "speed of the cue, in metres per second. The impulse is elastic and along the cue. The model leaves "
                "out sideways deflection, miscues, other balls and jumps",
                quantity("m/s"));
    tip_.add(app, "--tip", "A,B",
             fmt::format("point that the cue hits, in radii of the ball: A to the right of the centre and B above it, "
                         "seen along the cue; at most {} from the centre (default 0,0)",
                         si::largest_tip_offset),
             [](const std::string& typed) { return Eigen::Vector2d(numbers(typed, 2, "A,B").data()); });
    elevation_.add(app, "--elevation", "ANGLE",
                   "angle by which the butt of the cue is raised, 0 to below 90 degrees (default 0)", quantity("deg"));
    cue_mass_.add(app, "--cue-mass", "MASS",
                  fmt::format("mass of the cue, in kilograms (default {})", si::standard_cue_mass), quantity("kg"));
    law_.add(app);
    integrated_.add(
        app, "--route", "ROUTE",
        "numerical method: reduced (default, by integrals) or integrated (equations of motion in time steps)",
        one_of<bool>({{"reduced", false}, {"integrated", true}}, "route"));
    app.option_defaults()->group("Rolling");
    rolling_below_.add(app, "--rolling-below", "SPEED",
                       fmt::format("slip below which the ball counts as rolling, in metres per second (default {}). It "
                                   "also applies to the uncoupled model",
                                   si::rolling_slip),
                       checked(quantity("m/s"), is_not_negative, "0 or more is needed"));
    gradient_.add(app, "--gradient",
                  "also print the derivatives of each event with respect to each number of the ball and its start, by "
                  "differences with an error of 1e-8");
    uncertainty_.add(app, "--uncertainty", "NAME=SPREAD,...",
                     "standard deviations of input values, such as slip=1%,friction=5%, or fit: those in "
                     "a file of 'contensou fit'. Also prints the standard deviations of the events");
    instants_.add(app, "t", "s", "");
    until_.add(app, "--until", "TIME", "last instant, in seconds (default: 1.1 times the time of the last event)",
               checked(quantity("s"), is_positive, "a time after the start is needed, in s"));
    until_.excludes({instants_.all().front()});
    app.option_defaults()->group("Many starts");
    batch_.add(app, "--batch", "FILE",
               "table with one start a row, - for standard input. Columns: slip,spin or vx,vy,wx,wy,wz in SI units. "
               "The output adds columns with the events");
    keep_going_.add(app, "--keep-going", "continue after a bad row, and leave its results empty");
    bulk_.add(app);
    batch_.excludes(
        united({{&strike_, &tip_, &elevation_, &cue_mass_, &integrated_, &until_, &uncertainty_, &gradient_},
                instants_.all(),
                start_.of_start()}),
        "the starts are in the file, and the results are events alone");
    keep_going_.needs(batch_, "is for many starts");
    bulk_.need(batch_, "is for many starts");
    strike_.excludes(start_.of_start(), "the stroke sets the start");
    tip_.needs(strike_, "belongs to a stroke");
    elevation_.needs(strike_, "belongs to a stroke");
    cue_mass_.needs(strike_, "belongs to a stroke");
    output_.add(app);
  }

  ExitStatus run() override {
    if (batch_.given()) return run_many();
    const Output output = output_.read();
    const reduction::Law law = law_.read(start_.standard_law());
    const si::Experiment experiment = read_shot(law);
    Roll roll{experiment, law, integrated_.value_or(false), rolling_below_.value_or(si::rolling_slip),
              load_for(experiment, law)};
    const auto* at = instants_.at();
    const double last = at != nullptr && at->values.size() > 0 ? at->values.maxCoeff() : until_.value_or(0);
    si::require_finite_motion(roll.experiment, roll.whole.stop_time(), last);
    if (strike_.given()) roll.tip = tip_.value_or(Eigen::Vector2d::Zero()).y();
    start_.tell_left_out();
    const double end = until_.value_or(roll.standard_end());
    roll.uncertainty = read_uncertainty(roll);
    if (gradient_ && (roll.load || output.picture))
      throw BadInput("--gradient: not in a picture, and not with a load that changes; leave it out");
    if ((gradient_ || roll.uncertainty) && output.format == "text" && (instants_.given() || until_.given()))
      throw BadInput(
          "{} is of the events, and with {} the text is a table of instants: leave one out, or take "
          "--format csv or json, which have both",
          gradient_ ? "--gradient" : "--uncertainty", names_given(united({instants_.all(), {&until_}})));
    if (gradient_) roll.gradient = gradient_of(roll);
    if (output.picture) {
      if (roll.uncertainty) throw BadInput("--uncertainty: not in a picture; leave it out");
      const bool moves = output.picture == portraits::PictureFormat::gif;
      if (instants_.at() != nullptr || instants_.equidistant() || (instants_.asked() && !moves)) {
        throw BadInput("a picture needs no --at, --samples or --equidistant, a film --samples alone: leave them out");
      }
      if (instants_.asked() > max_frames) {
        throw BadInput("a film has at most {} frames, got --samples {}", max_frames, *instants_.asked());
      }
      if (const auto [centre, body] = si::velocities_of(roll.experiment.start); centre.isZero(0) && body.isZero(0)) {
        throw BadInput("the ball is at rest, there is nothing to draw: give it a --slip, a --spin or a --velocity");
      }
      const double rolls = std::max(roll.whole.rolls(roll.rolling_below), roll.textbook.rolls(roll.rolling_below));
      const double film_end = rolls > 0 && !until_.given() ? std::min(1.6 * rolls, end) : end;
      const auto [film_times, slow] = portraits::film_pace(film_end, instants_.asked());
      portraits::RollPicture picture =
          picture_of(roll, moves ? film_times : end * Eigen::ArrayXd::LinSpaced(500, 0, 1).cube());
      picture.size = output_.size();
      picture.slow = moves ? slow : 0;
      picture.whole_path = until_.given();
      return output_.write(moves ? portraits::roll_film(picture) : std::vector{portraits::roll_figure(picture)},
                           output);
    }
    if (output.format == "text" && !instants_.given() && !until_.given())
      return output.write(answers::roll_text(roll, output.digits));
    return output.write(answers::roll_answer(roll, instants_.between(roll.whole.rolls(roll.rolling_below), end)));
  }

 private:
  std::optional<Uncertainty> read_uncertainty(const Roll& roll) const {
    if (!uncertainty_.given()) return std::nullopt;
    if (roll.load) uncertainty_.reject("needs a constant load: give --load a number");
    if (uncertainty_.text().find("fit") != std::string::npos) start_.tell_spreads_left_out(roll.experiment);
    try {
      return roll_uncertainty(roll.experiment, roll.law, roll.rolling_below, uncertainty_.text());
    } catch (const BadInput& error) {
      uncertainty_.reject(error.what());
    }
  }

  static si::EventGradient gradient_of(const Roll& roll) {
    try {
      return si::event_gradient(si::EventNumbers(roll.experiment, roll.law, roll.rolling_below));
    } catch (const std::domain_error& error) {
      throw BadInput("--gradient: {}: leave it out", error.what());
    }
  }

  ExitStatus run_many() const {
    const Output out = output_.read(1);
    const reduction::Law law = law_.read(start_.standard_law());
    const si::Experiment still = start_.read_ball(law, at_rest("--batch"));
    require_rolling_options(still);
    if (start_.load_history()) throw BadInput("--batch needs a constant load: give --load a number");
    const double chi = still.ball.body.inertia.chi, u_r = still.contact.rolling_friction;
    const si::Shots shots(still, law);
    const double rolling_below = rolling_below_.value_or(si::rolling_slip);
    // If resistance is too small for the slope, the body never rests and has no columns of rest.
    const bool may_rest = u_r * si::pressing(still.environment) > (1 - 1 / chi) * si::pull(still.environment).norm();
    OutputFile output(out.path);
    CsvReader table(batch_.text());
    const std::vector<std::string> along_x = names_of({straight_shots}), velocities = names_of({general_shots});
    const auto has = [&](const std::string& column) { return table.has_column(column); };
    const bool general = std::ranges::any_of(velocities, has);
    if (general && std::ranges::any_of(along_x, has)) {
      throw table.complaint(table.header_line(),
                            "columns slip, spin and vx, vy, wx, wy, wz exclude each other: keep one kind of start");
    }
    std::vector<std::string> names = names_of(shot_events);
    std::vector<si::EventNumber> columns;
    for (const std::string& name : names)
      columns.push_back(*std::ranges::find(si::event_numbers(), name, &si::EventNumber::column));
    if (still.ball.body.lies_flat())
      std::copy(names.end() - 3, names.end(), names.begin());  // columns of the rest, in place of columns of rolling
    if (!may_rest) names.resize(names.size() - 3);
    BatchRequest request{.inputs = general ? velocities : along_x,
                         .results = names,
                         .compute =
                             [&](std::span<const double> row, std::span<double> results, long /*line*/) {
                               const si::Start start =
                                   general ? si::Start(si::Velocities{{row[0], row[1]}, {row[2], row[3], row[4]}})
                                           : si::Start(si::SlipAndSpin{row[0], row[1]});
                               const si::Events events = shots.from(start).finite().events(rolling_below);
                               for (std::size_t i = 0; i < results.size(); ++i) results[i] = columns[i].value(events);
                             },
                         .keep_going = keep_going_,
                         .threads = bulk_.threads(),
                         .progress = bulk_.progress(out.path)};
    const ExitStatus status = run_batch(table, output, request);
    output.finish();
    return status;
  }

  /// Returns the load if it changes; else empty.
  /// @throws BadInput  if the patch would change with the load, and for options that need a constant load
  std::optional<si::LoadHistory> load_for(const si::Experiment& experiment, const reduction::Law& law) const {
    const auto load = start_.load_history();
    if (!load) return load;
    fmt::print(stderr, "{}",
               require_load_alone(experiment, law, integrated_.value_or(false) ? "--route integrated" : ""));
    return load;
  }

  /// @throws NotAllowed  for an option about rolling that is given with a body that lies flat
  void require_rolling_options(const si::Experiment& experiment) const {
    if (!experiment.ball.body.lies_flat() || !rolling_below_.given()) return;
    rolling_below_.reject(fmt::format("a {} lies flat and never rolls: leave it out", experiment.ball.body.name));
  }

  si::Experiment read_shot(const reduction::Law& law) const {
    if (!strike_.given()) {
      const si::Experiment experiment = start_.read_ball(law);
      require_rolling_options(experiment);
      return experiment;
    }
    si::Experiment experiment = start_.read_rolling_ball(
        law, "leave out --strike: 'contensou roll' gives its motion from --slip and --spin", at_rest(strike_.name()));
    const Eigen::Vector2d tip = tip_.value_or(Eigen::Vector2d::Zero());
    try {
      experiment.start = si::struck(experiment.ball, {.speed = *strike_,
                                                      .right = tip.x(),
                                                      .above = tip.y(),
                                                      .elevation = elevation_.value_or(0),
                                                      .mass = cue_mass_.value_or(si::standard_cue_mass)});
    } catch (const std::domain_error& error) {
      throw BadInput("{}: {}", names_given({&strike_, &tip_, &elevation_, &cue_mass_}), error.what());
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
  Flag keep_going_, gradient_;
  BulkOptions bulk_;
  PictureOptions output_{
      {{"a motion", with_pictures(answer_formats("csv"), {"gif"})}, {"a table of motions", {"csv"}}}};
};

const RegisteredVerb<RollCommand> roll_verb(Purpose::compute, "roll",
                                            "Compute the whole motion of a ball or a puck in SI units",
                                            "contensou roll --ball gel --slip 0.5 --spin 300 --format text",
                                            {{"", answers::roll_fields}, {"--batch", roll_batch_texts}},
                                            {"slip", "spin", "stop", "event", "uncoupled model"});

}  // namespace

}  // namespace contensou::program
