#pragma once

#include "numerics/legendre_series.hpp"

namespace contensou::reduction {

/// Solves d y' + h y = g on [-1, 1] with y(-1) = start. For h/d >= 0, y relaxes towards g/h, forgets its start and
/// never amplifies an error. If d vanishes at -1, the result is the regular solution, which starts at g/h.
///
/// @param advection  d at the points of LegendreSeries, >= 0
/// @param rate       h at these points; h/d can have any size; for h < 0, y moves away from g/h
/// @param source     g at these points
/// @param start      y(-1)
/// @return           y
///
/// If h/d is moderate, the method is the integrating factor. If h/d is large, the factor is no polynomial, but y is,
/// and the method is collocation: one linear system for y' at the points, or for y if y forgets its start
/// immediately.
LegendreSeries solve_linear_ode(const LegendreSeries::Samples& advection, const LegendreSeries::Samples& rate,
                                const LegendreSeries::Samples& source, double start);

}  // namespace contensou::reduction
