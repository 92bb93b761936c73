#pragma once

#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::reduction {

/// Returns a system whose orbits are integrated by Dormand-Prince 5(4), without reduction, for any planar field.
///
/// Each step keeps the error below `tolerance`, relative to the state or to a thousandth of the start; an orbit has at
/// most 10 000 steps. Orbits are cut where a switching function changes its sign. Other jumps are detected by the error
/// estimate of this method; the estimate of Fehlberg 7(8) does not detect jumps. Tests and answers compare the
/// quadratures with these orbits.
///
/// @return a system with an empty form, undecided ends, and neither factor nor first integral
PlanarReduction by_steps(SmoothField field, double tolerance = 1e-12);

}  // namespace contensou::reduction
