#pragma once

#include "contensou/portraits/roll_figure.hpp"
#include "contensou/si/whole_motion.hpp"
#include "output/answer.hpp"

namespace contensou::program {

/// The whole motion of a ball.
struct Roll {
  si::Shot shot;
  reduction::Law law;
  bool integrated;  ///< the route of its columns: the equations of motion instead of the similarity solution
  si::WholeMotion whole{shot, law};

  /// When the ball rolls, in s: its slip is below rolling_share of that at the start, or over where there is no spin.
  double rolling_time() const;

  /// Where a series of instants ends unless the user says otherwise, in s: a little past the stop.
  double standard_end() const { return whole.stop_time() > 0 ? 1.1 * whole.stop_time() : 1; }
};

/// Columns of the motion.
/// @param times  s
Answer roll_table(const Roll& roll, const Eigen::ArrayXd& times);

/// The motion on one screen: where and when the ball ceases to slip, how it rolls on, what friction took, and the
/// textbook's answer beside it. For the route integrated, how close its stop is.
std::string roll_report(const Roll& roll, const Digits& digits);

/// The picture of the motion up to a time in s, beside the textbook's.
portraits::RollPicture roll_picture(const Roll& roll, double end);

}  // namespace contensou::program
