#pragma once

#include <functional>
#include <string>
#include <vector>

#include "contensou/portraits/figure.hpp"

namespace contensou::portraits {

/// What a figure is drawn from: lines (x, p) of the strip, in the way of the motion, and where the plane has them.
struct ReducedOrbits {
  Panel plane = {}, strip = {};
  Point start;                                ///< of the strip
  std::vector<Polyline> orbit;                ///< of the start
  std::vector<Polyline> elsewhere = {};       ///< orbits of other sectors
  std::vector<double> rays = {};              ///< their x
  std::function<Point(Point)> in_plane = {};  ///< of a point of the strip
};

inline constexpr double strip_below = 4.5, strip_above = 3.2;  ///< the start, of the strip in p
inline constexpr double orbits_beyond = 12;                    ///< the start, of orbits in p
inline constexpr double plane_widths = 2.2;                    ///< of the plane's window, in those of the start

/// Both panels, with the axes that they have, filled: rays, copies of the start's orbit, what the symmetry does.
Figure draw(ReducedOrbits from, const Text& title, const AskedSize& size);

/// @throws std::domain_error  always: of a start that has no strip
[[noreturn]] void refuse_ray();

}  // namespace contensou::portraits
