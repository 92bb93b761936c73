#pragma once

#include <array>
#include <functional>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::portraits {

/// The orbit of a start in canonical coordinates, as data: points (x, p) of the strip, which the symmetry shifts in p alone.
/// Copies of the orbit, and of all else here, are the same points with another p.
struct ReducedOrbits {
  Point start;
  std::vector<Polyline> orbit;                ///< of the start, in the way of the motion; of a focus turn by turn
  std::vector<Polyline> elsewhere = {};       ///< one orbit of each other sector
  std::vector<double> rays = {};              ///< their x
  std::function<Point(Point)> in_plane = {};  ///< (u, v) of a point of the strip
};

/// How far above and below the start p of the orbits is followed, where they go so far.
inline constexpr double orbits_beyond = 12;

/// How far p of the copies that are shown lies above that of the start: these are 1/8 to 8 times as large.
inline constexpr std::array copy_shifts{-3 * std::numbers::ln2, -2 * std::numbers::ln2, -std::numbers::ln2,
                                        std::numbers::ln2,      2 * std::numbers::ln2,  3 * std::numbers::ln2};

/// Of (2.6), with x = ln k and p = ln v.
/// @throws std::domain_error  for a start on an axis or on an invariant ray, where the symmetry moves an orbit along itself
ReducedOrbits reduced_orbits(const reduction::Flow& flow, reduction::State start);

/// Of any system solved by its scaling, with q and p of PlanarCanonical; q goes on beyond pi.
/// @throws std::domain_error  for a start on a ray or at the centre, and for a field with borders
ReducedOrbits reduced_orbits(const reduction::PlanarReduction& plane, const Eigen::Vector2d& start);

}  // namespace contensou::portraits
