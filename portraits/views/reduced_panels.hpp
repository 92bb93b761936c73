#pragma once

#include "contensou/portraits/reduced_orbits.hpp"

namespace contensou::portraits {

inline constexpr double strip_below = 4.5, strip_above = 3.2;  ///< range of p below and above the start, in the strip
inline constexpr double plane_widths = 2.2;  ///< size of the plane's window divided by the speeds of the start

/// Fills both panels, whose axes are given: rays, copies of the start's orbit, the action of the symmetry.
Figure draw(const ReducedOrbits& from, Panel plane, Panel strip, const Text& title, const AskedSize& size);

}  // namespace contensou::portraits
