#pragma once

#include <memory>

#include "contensou/reduction/integrating_factor.hpp"
#include "planar/inverse_factor.hpp"
#include "planar/solution.hpp"

namespace contensou::reduction {

/// Follows the orbit through the start, a level line of the first integral H, to its end.
/// @param fitted  field in which V was fitted: `field`, or `field` times the denominator of `field`
/// @param factor  inverse integrating factor in a box about `start`
std::shared_ptr<const PlanarOrbit::Motion> follow(const SmoothField& field, const SmoothField& fitted,
                                                  const InverseFactor& factor, const Eigen::Vector2d& start,
                                                  int most_parts);

}  // namespace contensou::reduction
