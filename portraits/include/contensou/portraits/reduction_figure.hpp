#pragma once

#include <string>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::portraits {

/// Draws the symmetry of (2.6) in three panels: the plane (u, v), in which it magnifies the orbit of the start; the
/// strip of ln k and p = ln v, in which it shifts the orbit, so that all orbits are one curve; and the copies divided
/// by their starts, which are one line. Copies are 1/8 to 8 times as large. Each has one colour in all panels, by size.
///
/// @throws std::domain_error  for a start on an axis or an invariant ray, which the symmetry maps onto itself
Figure reduction_figure(const reduction::Flow& flow, reduction::State start, const AskedSize& size = {});

/// Draws the symmetry of any system solved by its scaling, in the plane about its centre and the strip of
/// PlanarCanonical. Each other sector has one grey orbit.
///
/// @param name   name of the system
/// @throws std::domain_error  for a start on a ray or at the centre, and for a field with borders
Figure reduction_figure(const reduction::PlanarReduction& plane, const Eigen::Vector2d& start, const std::string& name,
                        const AskedSize& size = {});

}  // namespace contensou::portraits
