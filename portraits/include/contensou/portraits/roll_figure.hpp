#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// The motion of a ball under one model, sampled in SI units: columns of equal length.
struct RollCurve {
  Eigen::ArrayXd t;                        ///< increasing from 0
  Eigen::ArrayXd x, y;                     ///< position of the centre
  Eigen::ArrayXd slip;                     ///< speed of the contact point
  Eigen::ArrayXd rim;                      ///< R |omega_z|
  Eigen::ArrayXd speed;                    ///< speed of the centre
  double rolls;                            ///< time from which on the ball visibly rolls, or rests
  Eigen::Matrix3Xd angular_velocity = {};  ///< z up; needed for a film
};

/// The contents of roll_figure.
struct RollPicture {
  Text title;
  Text subtitle;
  RollCurve ball;
  RollCurve textbook;  ///< motion from the same start under the uncoupled model: sliding and spinning are independent
  AskedSize size = {};
  double slow = 0;          ///< factor by which a film is slower than the real motion; 0: no film
  bool lies_flat = false;   ///< the body rests when its slip ends, because it does not roll
  bool whole_path = false;  ///< true: draw all rows; false: up to a little after the ball rolls
};

/// Draws the path until a little after the ball rolls, and the speeds against time up to the stop. Curves of the
/// uncoupled model are dashed.
///
/// If the spin lasts much longer than the slip, the time axis is compressed a round number of times after rolling
/// begins; its x coordinate is then no time. The path is to scale unless it is too flat; then the figure states how it
/// is stretched or cut. Paths that coincide have their distance as a title. A straight path is drawn against time. A
/// ball that stays in place has no path.
///
/// @throws std::domain_error  if a column has fewer than 2 rows or columns differ in length
Figure roll_figure(const RollPicture& picture);

/// The times of the frames of a film, in s, and the factor by which the film is slower than the motion.
struct FilmPace {
  Eigen::ArrayXd t;
  double slow;
};
/// Returns the pace of a film of a motion up to the time `end` in s, with 12.5 frames a second. The film runs in real
/// time, or a round number of times slower or faster, so that it lasts 4 to 10 s.
/// @param asked  number of frames; it replaces this rule
FilmPace film_pace(double end, std::optional<Eigen::Index> asked = {});

/// Draws the frames of a film, one for each row of the columns. A frame shows the path and the speeds so far, and the
/// balls of both models from above, with marks that turn and with the word slides or rolls.
///
/// @throws std::domain_error  as roll_figure, and for columns without angular velocities
std::vector<Figure> roll_film(const RollPicture& picture);

}  // namespace contensou::portraits
