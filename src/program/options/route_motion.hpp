#pragma once

#include <Eigen/Core>

#include "contensou/reduction/flow.hpp"

namespace contensou::program {

/// States along a motion by any route.

/// @param times  tau >= 0, in any order; the rows come in that order
/// @throws std::runtime_error  if a stepper did not reach the stop
reduction::OrbitColumns motion_at(const reduction::ReducedSystem& system, reduction::State start,
                                  reduction::Route route, const Eigen::ArrayXd& times);

/// @param count  equidistant instants from the start to the stop, both included; 2 or more
/// @throws std::runtime_error  as above, or if the stop time exceeds the largest double
reduction::OrbitColumns motion_samples(const reduction::ReducedSystem& system, reduction::State start,
                                       reduction::Route route, Eigen::Index count);

}  // namespace contensou::program
