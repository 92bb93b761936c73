#pragma once

#include <Eigen/Core>

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// Returns the state of the motion from a start at the regularised time beta (ReducedSystem::regularising_weight). For
/// beta = infinity the state is rest.
///
/// @param beta  >= 0, in the inverse of the unit of speed
/// @throws std::domain_error  if beta is negative or not a number, or as Flow::orbit
///
/// Accuracy  as OrbitPoint::beta.
/// Cost      about ten times that of Orbit::at_time.
OrbitPoint at_beta(const Flow& flow, State start, double beta);

/// Returns the states at several beta, in the order given. Throws as at_beta.
OrbitColumns at_betas(const Flow& flow, State start, const Eigen::ArrayXd& betas);

}  // namespace contensou::reduction
