#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// The motion of a ball under one model, sampled: columns of equal length, SI.
struct RollCurve {
  Eigen::ArrayXd t;                        ///< increasing from 0
  Eigen::ArrayXd x, y;                     ///< of the centre
  Eigen::ArrayXd slip;                     ///< speed of the contact point
  Eigen::ArrayXd rim;                      ///< R |omega_z|
  Eigen::ArrayXd speed;                    ///< of the centre
  double rolls;                            ///< the time from which it rolls, as far as can be seen, or rests
  Eigen::Matrix3Xd angular_velocity = {};  ///< z up; for a film
};

/// What roll_figure draws.
struct RollPicture {
  Text title;
  Text subtitle;
  RollCurve ball;
  RollCurve textbook;  ///< the same start with sliding and spinning uncoupled
  AskedSize size = {};
  double slow = 0;          ///< of a film: as many times slower than the ball; 0: no film
  bool lies_flat = false;   ///< the body does not roll when its slip ends, it rests
  bool whole_path = false;  ///< up to the last row, not only to a little after the ball rolls
};

/// The path on the table, up to a little after the ball rolls, and the speeds against time, up to the stop (on a
/// logarithmic axis where the spin outlives the slip by far); the textbook's ball dashed. The path is to scale unless it
/// is too flat for that, and the figure says where it is cut and how it is stretched. A straight path is shown against
/// time instead, and a ball that stays in its place has no path.
///
/// @throws std::domain_error  if a column is shorter than 2 or columns differ in length
Figure roll_figure(const RollPicture& picture);

/// The instants of a film of a motion up to that time in s, and its pace: 25 in a second of it; unless so many are asked
/// for, real time or a round number of times slower or faster, so that it lasts 4 to 10 s.
struct FilmPace {
  Eigen::ArrayXd t;
  double slow;
};
FilmPace film_pace(double end, std::optional<Eigen::Index> asked = {});

/// The motion as it goes on, a frame for each row of the columns: the path and the speeds so far, and both balls seen
/// from above with marks that turn with them, and with what they do: slide or roll.
///
/// @throws std::domain_error  as roll_figure, and for columns without angular velocities
std::vector<Figure> roll_film(const RollPicture& picture);

}  // namespace contensou::portraits
