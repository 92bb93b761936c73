#pragma once

#include <string>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::portraits {

/// Draws the symmetry of a system solved by its scaling: the plane, in which it magnifies the orbit of the start, and
/// the strip of ReducedOrbits, in which it shifts the orbit, so that all orbits of a sector are one curve. Copies are
/// 1/8 to 8 times as large. Each has one colour in all panels, by size. Each other sector has one grey orbit.
///
/// For (2.6) solved by its flow the plane is a quadrant. A third panel shows the copies divided by their starts, which
/// are one line.
///
/// @param name  name of the system; (2.6) is titled by mu and law
/// @throws std::domain_error  as reduced_orbits
Figure reduction_figure(const reduction::PlanarReduction& plane, const Eigen::Vector2d& start, const std::string& name,
                        const AskedSize& size = {});

}  // namespace contensou::portraits
