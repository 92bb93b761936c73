#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "answers/verbs/uncertainty.hpp"
#include "contensou/si/event_gradient.hpp"
#include "contensou/si/motion.hpp"
#include "contensou/si/scaling.hpp"

namespace contensou::answers {

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

}  // namespace contensou::answers
