#pragma once

#include "numerics/legendre_series.hpp"

namespace contensou::reduction {

/// The solution of  y' + h y = g  on [-1, 1] with y(-1) = start: a quantity that relaxes towards g/h, which for h >= 0
/// forgets its start and never amplifies an error.
///
/// @param rate    h at the points of LegendreSeries, >= 0; any size
/// @param source  g there
/// @return        y
///
/// While h is moderate, by the integrating factor. Where it is large the factor is no polynomial, but y is: then by
/// collocation, one linear system for y' at the points.
LegendreSeries relax(const LegendreSeries::Samples& rate, const LegendreSeries::Samples& source, double start);

}  // namespace contensou::reduction
