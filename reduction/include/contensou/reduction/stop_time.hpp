#pragma once

#include <string_view>
#include <vector>

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// The ways to a stop time, for comparison: they share no code beyond the law.
enum class Route {
  closed,       ///< the law's closed form (closed_solution)
  quadrature,   ///< separated equation and time quadrature
  regularised,  ///< (2.7) and (2.8), stepped in beta
  direct,       ///< (2.6), stepped in tau
};

std::string_view name(Route route);

/// One sentence: what the route does, how accurate it is, what it cannot do.
std::string_view description(Route route);

/// The routes that can answer for this system, best first; the first is the default.
std::vector<Route> routes(const ReducedSystem& system);

/// The time until u = v = 0 by one route, the system solved for this start alone; Flow::stop_time has the best. 0 at
/// rest.
///
/// @throws std::domain_error   if start is not a state (finite, v >= 0), or the system does not have the route
/// @throws std::runtime_error  if a stepper did not reach the stop; the message is its outcome's sentence
///
/// Accuracy  StopTime::accuracy: closed 1e-15 for mu <= 1, quadrature 3e-15 for a smooth law, steppers 1e-10; for all
///           finite starts, v0/(mu u0) may overflow.
StopTime stop_time(const ReducedSystem& system, State start, Route route);

}  // namespace contensou::reduction
