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

/// An orbit in canonical coordinates as data: points (x, p) of a strip, where the symmetry shifts p alone. A copy of an
/// orbit under the symmetry therefore has the same x, and p shifted by a constant.
struct ReducedOrbits {
  Point start;
  /// Orbit of the start, in the direction of the motion; a focus has a line for each turn.
  std::vector<Polyline> orbit;
  std::vector<Polyline> elsewhere = {};  ///< one orbit of each other sector
  std::vector<double> rays = {};         ///< x of the invariant lines: rays of a scaling, else orbits of the symmetry
  std::function<Point(Point)> in_plane = {};  ///< maps a point of the strip to (u, v)
  double step = std::numbers::ln2;            ///< change of p from one copy to the next
};

/// Copies of the orbit of the start in pictures: p is shifted by these multiples of ReducedOrbits::step. The copies
/// under a scaling are 1/8 to 8 times as large.
inline constexpr std::array copies{-3, -2, -1, 1, 2, 3};

/// Returns orbits of a system solved by its scaling: x and p are q and p of PlanarCanonical; q continues beyond pi.
/// For the equations of motion (2.6) solved by their flow it returns the orbit of the start alone, with x = ln k and p
/// = ln |v|.
/// @throws std::domain_error  for a start on a ray or at the centre; for a field with borders, except (2.6)
ReducedOrbits reduced_orbits(const reduction::PlanarReduction& plane, const Eigen::Vector2d& start);

/// Returns orbits of a system that a shift (A = 0), a turn about the origin (b = 0, A = ((0, -1), (1, 0))) or a scaling
/// with A = diag(1, m) maps onto itself. For a turn x is the distance from the origin, and p is the angle. For a shift
/// (b1, b2) the point is (u, v) = (0, x) + p b, but (x, 0) + p b if b1 = 0. For a scaling with the centre (a, c),
/// x = (v - c)/(u - a)^m and p = ln |u - a|, on the side of the start; |u - a| is raised to an m that is not whole.
/// Orbits are traced in the strip as in planar_portrait.
/// @throws std::domain_error  for a start on an invariant line; as planar_portrait
ReducedOrbits reduced_orbits(const reduction::PlanarReduction& plane, const Eigen::Vector2d& start,
                             const reduction::Generator& symmetry);

/// Names in the picture of a reduction.
struct ReducedNames {
  std::string system;                                 ///< in the title, except for (2.6)
  std::array<std::string, 2> variables = {"u", "v"};  ///< on the axes of the plane
  std::string q = "q, the angle", p = "p";            ///< on the axes of the strip
};

/// Draws the symmetry of a system solved by its scaling. In the plane the symmetry magnifies the orbit of the start. In
/// the strip of ReducedOrbits it shifts the orbit, so that all orbits of a sector are one curve. Copies are 1/8 to 8
/// times as large. Each copy has one colour in all panels, by size. Each other sector has one grey orbit.
///
/// For the equations of motion (2.6) solved by their flow the plane is a quadrant. A third panel shows each copy
/// divided by its start; all these copies are one line.
///
/// @param symmetry  shift, turn or scaling that replaces the scaling of the plane; null if the plane has a scaling
/// @throws std::domain_error  as reduced_orbits
Figure reduction_figure(const reduction::PlanarReduction& plane, const Eigen::Vector2d& start,
                        const ReducedNames& names, const AskedSize& size = {},
                        const reduction::Generator* symmetry = nullptr);

}  // namespace contensou::portraits
