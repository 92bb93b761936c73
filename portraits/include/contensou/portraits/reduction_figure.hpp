#pragma once

#include <array>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::portraits {

/// An orbit in canonical coordinates as data: points (x, p) of a strip, where the symmetry shifts p alone. A scaled
/// copy of an orbit therefore has the same x, and p shifted by a constant.
struct ReducedOrbits {
  Point start;
  /// Orbit of the start, in the direction of the motion; a focus has a line for each turn.
  std::vector<Polyline> orbit;
  std::vector<Polyline> elsewhere = {};       ///< one orbit of each other sector
  std::vector<double> rays = {};              ///< x of the rays
  std::function<Point(Point)> in_plane = {};  ///< maps a point of the strip to (u, v)
};

/// Orbits are followed to this distance of p from its value at the start, above and below.
inline constexpr double orbits_beyond = 12;

/// Shifts of p between the orbit of the start and its copies in pictures. The copies are 1/8 to 8 times as large.
inline constexpr std::array copy_shifts{-3 * std::numbers::ln2, -2 * std::numbers::ln2, -std::numbers::ln2,
                                        std::numbers::ln2,      2 * std::numbers::ln2,  3 * std::numbers::ln2};

/// Returns orbits of a system solved by its scaling: x and p are q and p of PlanarCanonical; q continues beyond pi.
/// For the equations of motion (2.6) solved by their flow it returns the orbit of the start alone, with x = ln k and p
/// = ln |v|.
/// @throws std::domain_error  for a start on a ray or at the centre; for a field with borders, except (2.6)
ReducedOrbits reduced_orbits(const reduction::PlanarReduction& plane, const Eigen::Vector2d& start);

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
