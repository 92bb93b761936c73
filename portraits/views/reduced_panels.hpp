#pragma once

#include "contensou/portraits/reduced_orbits.hpp"

namespace contensou::portraits {

inline constexpr double strip_below = 4.5, strip_above = 3.2;  ///< the start, of the strip in p
inline constexpr double plane_widths = 2.2;                    ///< of the plane's window, in those of the start

/// Both panels, with the axes that they have, filled: rays, copies of the start's orbit, what the symmetry does.
Figure draw(const ReducedOrbits& from, Panel plane, Panel strip, const Text& title, const AskedSize& size);

}  // namespace contensou::portraits
