#pragma once

#include <optional>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>

#include "planar/approach.hpp"
#include "planar/section_field.hpp"

namespace contensou::reduction {

/// Counter-clockwise angle from one direction to another, in (0, 2 pi].
double angle_between(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// A direction that no orbit crosses: a ray, a jump across which T changes its sign, a pole, or a border beyond which
/// the field has no values.
struct Direction {
  Eigen::Vector2d n;
  Approach before, after;                    ///< clockwise and counter-clockwise of it
  std::optional<SectionField::Rates> rates;  ///< rates along the direction
};

/// The section's circle of directions.
struct Directions {
  bool star = false;                    ///< T = 0 throughout
  std::vector<Direction> dividing;      ///< counter-clockwise
  std::vector<Eigen::Vector2d> smooth;  ///< directions that orbits cross where R and T may have a kink or a jump
};

/// T cannot be told from 0 near a direction, and is not known to vanish there.
struct UndecidedDirection {
  Eigen::Vector2d n;
};

/// Finds the directions that divide a section.
///
/// Samples are evenly spaced, and closer and closer to u = 0, v = 0 and the directions between them, where a law may
/// have all of its structure. Between samples zeros of T are found by their sign or where |T| is least, and poles by
/// their sign or where the field is largest. Structure narrower than the samples, pi/128, may be missed.
///
/// @param noise    relative error of the field's values
/// @param between  further directions to sample in
/// @throws std::domain_error  if the field has no values
/// @throws UndecidedDirection
Directions find_directions(const SectionField& field, double noise, std::vector<Eigen::Vector2d> between);

}  // namespace contensou::reduction
