#pragma once

#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::reduction {

/// Takes any planar field for a system without reduction: its orbits are integrated by Dormand-Prince 5(4), whose steps
/// hold an error of 1e-12 of the distance from the origin each, up to 10 000 of them. Its error estimate sees jumps of
/// the field, which Fehlberg 7(8) is blind to. A route of its own beside quadratures.
///
/// The form is empty, no end is decided, and there is neither a factor nor a first integral.
PlanarReduction by_steps(PlanarField field);

}  // namespace contensou::reduction
