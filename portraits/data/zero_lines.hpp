#pragma once

#include <vector>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::portraits {

/// Returns the curves on which a function is 0 within its rectangle, with or without a change of its sign. Squares are
/// 1/160 of a window.
/// @param sides  sides of the window
std::vector<Polyline> zero_lines(const reduction::FactorPiece& piece, const Eigen::Vector2d& sides);

}  // namespace contensou::portraits
