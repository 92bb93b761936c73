#pragma once

#include <optional>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>

#include "planar/approach.hpp"
#include "planar/section_field.hpp"

namespace contensou::reduction {

/// Returns the counter-clockwise angle from one direction to another, in (0, 2 pi].
double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// A direction that no orbit crosses: a ray, a jump at which T changes its sign, a pole, or a border. Beyond a border
/// the field has no values.
struct Direction {
  Eigen::Vector2d n;
  Approach before, after;                    ///< the side clockwise and the side counter-clockwise of the direction
  std::optional<SectionField::Rates> rates;  ///< rates at the direction itself; empty if the field has no value there
};

/// The directions of a section (SectionField), counter-clockwise along the closed curve of the section.
struct Directions {
  bool star = false;                    ///< true if T = 0 for all directions
  std::vector<Direction> dividing;      ///< counter-clockwise
  std::vector<Eigen::Vector2d> smooth;  ///< directions that orbits cross although R or T has a kink or a jump there
};

/// Thrown if T near a direction is 0 within its errors, so that it is unknown whether T vanishes there.
struct UndecidedDirection {
  Eigen::Vector2d n;
};

/// Finds the directions that divide a section.
///
/// Samples are evenly spaced. They become denser towards u = 0, v = 0 and the diagonals between these axes, because all
/// structure of a law can lie there. Between samples, zeros of T are found by a change of sign or at the least |T|;
/// poles by a change of sign or at the largest field. Structure narrower than the distance of the samples, pi/128, can
/// be missed.
///
/// @param noise    relative error of the field's values
/// @param between  further directions at which to sample
/// @throws std::domain_error  if the field has no values
/// @throws UndecidedDirection
Directions find_directions(const SectionField& field, double noise, std::vector<Eigen::Vector2d> between);

}  // namespace contensou::reduction
