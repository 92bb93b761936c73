#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "answers/asked/given_start.hpp"
#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "contensou/si/aim.hpp"
#include "contensou/si/bounce.hpp"
#include "contensou/si/engine.hpp"
#include "contensou/si/event_gradient.hpp"
#include "contensou/si/experiment.hpp"
#include "contensou/si/load_history.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"

namespace contensou::answers {

/// Returns the ball of an answer in SI units: name, values, patch radius under the law, and the source of this radius.
Json members_of_ball(const si::Experiment& experiment, const reduction::Law& law);

/// Returns {t, x, y}.
Json members_of(const si::Event& event);

/// Returns {t: [...], load: [...]}.
Json members_of(const si::LoadHistory& load);

/// Returns the ball of an answer in two lines of text.
std::string ball_heading(const si::Experiment& experiment, const reduction::Law& law, const Digits& digits);

/// Returns a number >= 0 rounded to two digits. From 1e-5 to 1e6 it has no exponent.
std::string to_two_digits(double number);

/// Returns a length in mm, cm, m or km, to two digits.
/// @param metres  >= 0
std::string length_in_words(double metres);

/// Returns a time to two digits, with its unit.
/// @param seconds  >= 0
std::string time_in_words(double seconds);

/// Uncertainty of a number that is a function of normally distributed numbers.
struct KnownTo {
  double standard = 0;  ///< standard deviation to first order
  /// Standard deviation due to each number alone, with the sign of the derivative. If the numbers are independent,
  /// `standard` is the square root of the sum of the squares of these shares.
  std::vector<std::pair<std::string, double>> shares = {};
  std::array<double, 5> quantiles = {};  ///< quantiles of the samples at `probabilities`
  bool holds = true;                     ///< true if first order and quantiles agree within a tenth of `standard`

  static constexpr std::array<double, 5> probabilities{0.025, 0.16, 0.5, 0.84, 0.975};
};

/// The uncertainty of the numbers of a motion's events.
struct Uncertainty {
  struct Part {
    si::EventNumber number;  ///< its function `value` is not used
    double value;
    KnownTo known = {};
  };
  std::vector<Part> parts;
  long samples = 0;
  double outside = 0;  ///< share of samples left out because no start has such values, e.g. a friction below 0
};

/// Returns the label of a number of an event, such as "rolls after t" or "path".
std::string label_of(const si::EventNumber& number);

/// Returns the place of a number of an event in an object of JSON: members.rolls_after.t, or members.path.
Json& place_of(const si::EventNumber& number, Json& members);

/// Returns the uncertainty of all events of `roll`.
/// @param rolling_below  slip below which the ball rolls, m/s, as in si::Motion::rolls
/// @param typed          spreads such as "slip=1%, spin=2 rad/s, fit", for numbers of the ball and of its start: slip,
///                       spin or vx, vy, wx, wy, wz
/// @param before_each    called before each sample; it may throw
/// @throws BadInput  with the mistake and the allowed values; for a ball at rest; and if all samples are outside
Uncertainty roll_uncertainty(
    const si::Experiment& experiment, const reduction::Law& law, double rolling_below, const std::string& typed,
    const std::function<void()>& before_each = [] {});

/// Returns the uncertainty of the stop time alone: in s for a ball, otherwise in tau.
/// @param typed  for a ball as in roll_uncertainty, but only slip and spin for the start; otherwise spreads of u0, v0,
///               mu
Uncertainty stop_uncertainty(const GivenStart& start, const std::string& typed);

/// Returns {standard, quantiles, shares, first_order_holds}.
Json members_of(const KnownTo& known);

/// Returns {rolls_after: {t, x, y}, spin_ends: {t, x, y}, slip_length, turns, path, t_stop, samples, outside}.
Json members_of(const Uncertainty& uncertainty);

/// Returns the uncertainty of all numbers as a table.
std::string text_of(const Uncertainty& uncertainty, const Digits& digits);

/// Returns the remarks below the table of text_of: numbers for which the first order fails, and samples left out.
std::string remarks_on(const Uncertainty& uncertainty);

/// Returns the answer of `stop` for one start.
/// @param estimate  true: include the estimates for small mu
/// @param gradient  true: include the derivatives of the stop time
/// @param uncertainty  uncertainty of the stop time, from stop_uncertainty
/// @param load      changing load of a ball; tau belongs to its nominal load, seconds belong to the changing load
/// @throws BadInput, std::domain_error  for options that rolling friction excludes; for a load that ends before the
///                                      motion
Answer stop_answer(const GivenStart& start, reduction::Route route, bool estimate, bool gradient = false,
                   const std::optional<Uncertainty>& uncertainty = {}, const std::optional<si::LoadHistory>& load = {});

/// Returns the fields of the answer of `stop`.
std::vector<FieldText> stop_fields();

/// The whole motion of a ball, or of a body that lies flat.
struct Roll {
  si::Experiment experiment;
  reduction::Law law;
  bool integrated;       ///< true: computed from the equations of motion in steps; false: from the similarity solution
  double rolling_below;  ///< slip below which the ball rolls, m/s
  std::optional<si::LoadHistory> load = {};
  si::Motion whole = si::Motion::reduced(experiment, law, load).finite();
  si::Motion textbook = si::Motion::uncoupled(experiment, law, rolling_below, load).finite();
  std::optional<si::Motion> in_steps = integrated ? std::optional(si::Motion::in_steps(experiment, law)) : std::nullopt;
  std::optional<Uncertainty> uncertainty = {};
  std::optional<si::EventGradient> gradient = {};
  std::optional<double> tip = {};  ///< height of a cue's tip above the centre, in radii; empty without a cue

  si::Events ours() const { return whole.events(rolling_below); }
  si::Events theirs() const { return textbook.events(rolling_below); }
  bool lies_flat() const { return experiment.ball.body.lies_flat(); }
  bool is_driven() const { return si::is_driven(experiment); }

  si::MotionColumns at(const Eigen::ArrayXd& times) const { return (in_steps ? *in_steps : whole).at(times); }

  /// Returns the default end of a series of instants, s: 1.1 times Motion::last_time, or 1 if that is 0.
  double standard_end() const;
};

/// Returns the columns of the motion at these instants, and the events of the motion.
/// @param times  s
Answer roll_answer(const Roll& roll, const Eigen::ArrayXd& times);

/// Returns the motion as text on one screen: a sentence; time and place of the end of slip; the rolling after this end;
/// the lost energy; and the same under the uncoupled model. For an integrated motion, the error of the stop follows.
std::string roll_text(const Roll& roll, const Digits& digits);

/// Returns the fields of the answer of `roll`.
std::vector<FieldText> roll_fields();

/// Returns {rolls_after: {t: {NAME: slope, ...}, x, y}, ...}. NAME is a component of the start.
Json members_of(const si::EventGradient& gradient);

using AimGoal = std::variant<si::Goal, si::RollingGoal>;

/// Returns the answer of `aim`: the start that reaches the goal, the result of this start, and the stroke of a cue that
/// causes it. Throws as si::aimed.
Answer aim_answer(si::Experiment experiment, const reduction::Law& law, const AimGoal& goal);

/// Returns the fields of the answer of `aim`.
std::vector<FieldText> aim_fields();

/// Returns the answer of `bounce` for one ball.
/// @param height         height from which the ball was dropped, m; empty if it was not dropped
/// @param rolling_below  slip below which the ball rolls, m/s, > 0
Answer bounce_answer(const si::Experiment& experiment, const reduction::Law& law, const si::Impact& impact,
                     std::optional<double> height, double rolling_below);

/// Returns the fields of the answer of `bounce`.
std::vector<FieldText> bounce_fields();

/// A value that is typed into an engine in place of the right one.
struct TypedValue {
  const si::EngineParameter* parameter;
  double value;  ///< SI, >= 0; above 0 for a parameter on which the force depends
};

/// Reads NAME=VALUE, where NAME is the name of a parameter or a part of it that no other parameter of the engine has.
/// The case of letters does not matter.
/// @throws BadInput  for another name, or a value that is not allowed
TypedValue parse_typed_value(const std::string& typed, const si::EngineUse& use);

/// Returns the answer of `engine` for a ball: the settings of all engines, or of one engine, and the resulting motion.
/// CSV contains one row for each setting.
/// @param only   the only engine, which may be si::unknown_engine(); null: all
/// @param typed  values in place of the right ones; with `only`. They are one more setting of the engine, the last.
Answer engine_answer(const si::Experiment& experiment, const reduction::Law& law, const si::Engine* only = nullptr,
                     const std::vector<TypedValue>& typed = {});

/// Returns the fields of the answer of `engine`.
std::vector<FieldText> engine_fields();

}  // namespace contensou::answers
