#pragma once

#include "numerics/legendre_series.hpp"

namespace contensou::reduction {

/// The solution of  d y' + h y = g  on [-1, 1] with y(-1) = start: a quantity that relaxes towards g/h, which for h/d
/// >= 0 forgets its start and never amplifies an error. Where d vanishes at -1, the regular solution, which starts on
/// g/h.
///
/// @param advection  d at the points of LegendreSeries, >= 0
/// @param rate       h there; h/d may have any size; where h < 0, y grows away from g/h
/// @param source     g there
/// @return           y
///
/// While h/d is moderate, by the integrating factor. Where it is large the factor is no polynomial, but y is: then by
/// collocation, one linear system for y' at the points; where the start is forgotten at once, for y without it.
LegendreSeries solve_linear_ode(const LegendreSeries::Samples& advection, const LegendreSeries::Samples& rate,
                                const LegendreSeries::Samples& source, double start);

}  // namespace contensou::reduction
