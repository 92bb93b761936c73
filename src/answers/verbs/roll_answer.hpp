#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "answers/table/answer.hpp"
#include "answers/table/record.hpp"
#include "answers/verbs/roll_uncertainty.hpp"
#include "contensou/si/ball_motion.hpp"
#include "contensou/si/course.hpp"
#include "contensou/si/loaded_motion.hpp"
#include "contensou/si/uncoupled_motion.hpp"

namespace contensou::answers {

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
  std::optional<RollUncertainty> uncertainty = {};
  std::optional<si::EventGradient> gradient = {};
  std::optional<double> tip = {};  ///< of a stroke of a cue: radii above the centre

  /// How the events are found.
  bool reduced() const { return !whole.resisted || whole.resisted->is_reduced(); }
  bool lies_flat() const { return experiment.ball.body.lies_flat(); }
  double stop_time() const { return whole.resisted ? whole.resisted->stop_time() : whole.motion.stop_time(); }

  si::MotionColumns at_times(const Eigen::ArrayXd& times) const;

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

}  // namespace contensou::answers
