#pragma once

#include <string>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::portraits {

/// Draws the symmetry of a system solved by its scaling. In the plane the symmetry magnifies the orbit of the start. In
/// the strip of ReducedOrbits it shifts the orbit, so that all orbits of a sector are one curve. Copies are 1/8 to 8
/// times as large. Each copy has one colour in all panels, by size. Each other sector has one grey orbit.
///
/// For the equations of motion (2.6) solved by their flow the plane is a quadrant. A third panel shows each copy
/// divided by its start; all these copies are one line.
///
/// @param name  name of the system; for (2.6) the title consists of mu and law
/// @throws std::domain_error  as reduced_orbits
Figure reduction_figure(const reduction::PlanarReduction& plane, const Eigen::Vector2d& start, const std::string& name,
                        const AskedSize& size = {});

}  // namespace contensou::portraits
