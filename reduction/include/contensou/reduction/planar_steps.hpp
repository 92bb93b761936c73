#pragma once

#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::reduction {

/// Returns a system whose orbits are integrated by Dormand-Prince 5(4), without reduction, for any planar field.
///
/// Each step keeps the error below 1e-12 of the distance from the origin; an orbit has at most 10 000 steps. The error
/// estimate of this method detects jumps of the field; the estimate of Fehlberg 7(8) does not. Tests compare the
/// quadratures with these orbits.
///
/// @return a system with an empty form, undecided ends, and neither factor nor first integral
PlanarReduction by_steps(PlanarField field);

}  // namespace contensou::reduction
