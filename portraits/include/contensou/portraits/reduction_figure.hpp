#pragma once

#include <string>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::portraits {

/// The symmetry of (2.6) in three panels: the plane (u, v), where it magnifies the orbit of the start; the strip of ln k
/// and p = ln v, where it shifts that orbit, so that all orbits are one curve; and the copies over their starts, one line.
/// Copies are 1/8 to 8 times as large; each has one colour in all panels, in the order of their size.
///
/// @throws std::domain_error  for a start on an axis or on an invariant ray, where the symmetry moves an orbit along itself
Figure reduction_figure(const reduction::Flow& flow, reduction::State start, const AskedSize& size = {});

/// The same for any system solved by its scaling, in the plane about its centre and the strip of PlanarCanonical, beside
/// one grey orbit in each of the other sectors.
///
/// @param name   of the system
/// @throws std::domain_error  for a start on a ray or at the centre, and for a field with borders
Figure reduction_figure(const reduction::PlanarReduction& plane, const Eigen::Vector2d& start, const std::string& name,
                        const AskedSize& size = {});

}  // namespace contensou::portraits
