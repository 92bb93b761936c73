#pragma once

#include <string>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// The motion of a ball under one model, sampled: columns of equal length, SI.
struct RollCurve {
  Eigen::ArrayXd t;      ///< increasing from 0
  Eigen::ArrayXd x, y;   ///< of the centre
  Eigen::ArrayXd slip;   ///< speed of the contact point
  Eigen::ArrayXd rim;    ///< R |omega_z|
  Eigen::ArrayXd speed;  ///< of the centre
  double rolls;          ///< the time from which it rolls, as far as can be seen
};

/// What roll_figure draws.
struct RollPicture {
  std::string title;
  std::string subtitle;
  RollCurve ball;
  RollCurve textbook;  ///< the same start with sliding and spinning uncoupled
  AskedSize size = {};
};

/// The path on the table, up to a little after the ball rolls, and the speeds against time, up to the stop (on a
/// logarithmic axis where the spin outlives the slip by far); the textbook's ball dashed. A straight path is shown
/// against time instead, and a ball that stays in its place has no path.
///
/// @throws std::domain_error  if a column is shorter than 2 or columns differ in length
Figure roll_figure(const RollPicture& picture);

}  // namespace contensou::portraits
