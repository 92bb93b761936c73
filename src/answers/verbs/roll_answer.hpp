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
  bool integrated;       ///< the route of its columns: the equations of motion instead of the similarity solution
  double rolling_below;  ///< m/s of slip
  std::optional<si::LoadHistory> load = {};
  si::Motion whole = si::Motion::reduced(experiment, law, load).finite();
  si::Motion textbook = si::Motion::uncoupled(experiment, law, rolling_below, load).finite();
  std::optional<si::Motion> in_steps = integrated ? std::optional(si::Motion::in_steps(experiment, law)) : std::nullopt;
  std::optional<Uncertainty> uncertainty = {};
  std::optional<si::EventGradient> gradient = {};
  std::optional<double> tip = {};  ///< of a stroke of a cue: radii above the centre

  si::Events ours() const { return whole.events(rolling_below); }
  si::Events theirs() const { return textbook.events(rolling_below); }
  bool lies_flat() const { return experiment.ball.body.lies_flat(); }
  bool is_driven() const { return si::is_driven(experiment); }

  si::MotionColumns at(const Eigen::ArrayXd& times) const { return (in_steps ? *in_steps : whole).at(times); }

  /// Where a series of instants ends unless the user says otherwise, in s: a little past the stop, and the rest.
  double standard_end() const;
};

/// Columns of the motion at these instants, and its events.
/// @param times  s
Answer roll_answer(const Roll& roll, const Eigen::ArrayXd& times);

/// The motion on one screen, first in one sentence: where and when the ball ceases to slip, how it rolls on, what friction took, and the
/// textbook's answer beside it. For the route integrated, how close its stop is.
std::string roll_text(const Roll& roll, const Digits& digits);

/// The fields of that answer.
std::vector<FieldText> roll_fields();

/// {rolls_after: {t: {NAME: slope, ...}, x, y}, ...}, by the names of components.
Json members_of(const si::EventGradient& gradient);

}  // namespace contensou::answers
