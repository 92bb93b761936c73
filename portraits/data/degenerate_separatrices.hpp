#pragma once

#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::portraits {

/// A point at which a separatrix of an equilibrium crosses a small closed curve about the equilibrium.
struct SeparatrixPoint {
  Eigen::Vector2d x;
  bool stable;  ///< true if the motion from the point tends to the equilibrium
};

/// Finds the separatrices of an equilibrium whose eigenvalues are both 0. The motions from the points of a small
/// ellipse are followed until they leave its surroundings or come near to the equilibrium. A separatrix starts between
/// two motions that pass the equilibrium on different sides, and between a motion that passes and one that arrives.
/// @param sides  sides of the picture; the half axes of the ellipse are 1 % of them
/// @return empty if a smaller ellipse has other numbers of separatrices
/// @note accuracy: 1e-5 of the picture. Cost: some 100 000 values of the field
std::vector<SeparatrixPoint> degenerate_separatrices(const reduction::SmoothField& field, const Eigen::Vector2d& centre,
                                                     const Eigen::Vector2d& sides);

}  // namespace contensou::portraits
