#pragma once

#include <memory>

#include "contensou/reduction/planar_reduction.hpp"
#include "planar/inverse_factor.hpp"
#include "planar/solution.hpp"

namespace contensou::reduction {

/// Follows the orbit through the start, a level line of the first integral H, to its end.
/// @param cleared  true if V was fitted for the product of the field and its denominator
/// @param factor  inverse integrating factor in a box about `start`
/// @param most_work  number of evaluations of the field after which the end is left undecided
/// @param unit    length by which u and v are divided in all arguments; the motion has no units
std::shared_ptr<const PlanarOrbit::Motion> follow(const SmoothField& field, bool cleared, const InverseFactor& factor,
                                                  const Eigen::Vector2d& start, double unit, int most_work);

}  // namespace contensou::reduction
