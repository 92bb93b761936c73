#pragma once

#include <string_view>
#include <vector>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The methods for a stop time. They share no code except the law; their results are compared.
enum class Route {
  closed,       ///< closed form of the law (closed_solution)
  quadrature,   ///< integrals over k for the orbit and for the time (theory.md (R2), (R3))
  regularised,  ///< steps in beta through the paper's regularised equations (2.7) and (2.8)
  direct,       ///< steps in tau through the equations of motion (2.6)
};

std::string_view name(Route route);

/// Returns one sentence about a route: its method, its accuracy and its limits.
std::string_view description(Route route);

/// Returns the routes that are possible for this system, the best one first. The first route is the default.
std::vector<Route> routes(const ReducedSystem& system);

/// Returns the time until u = v = 0 by the first of routes(system); 0 at rest. It solves the system for this start
/// alone; Flow::stop_time solves it once for all starts.
///
/// This header includes no Eigen. It compiles in less than half the time of flow.hpp.
///
/// @throws std::domain_error  if start is not a state (finite, v >= 0)
///
/// Accuracy  that of Flow::stop_time.
StopTime stop_time(const ReducedSystem& system, State start);

/// Returns the same time, computed by the given route.
///
/// @throws std::domain_error   if start is not a state (finite, v >= 0), or the route is not possible for this system
/// @throws std::runtime_error  if a stepper did not reach the stop; the message is its Outcome::sentence
///
/// Accuracy  StopTime::accuracy: closed 1e-15 for mu <= 1, quadrature 3e-15 for a smooth law, steppers 1e-10. It holds
///           for all finite starts, even if v0/(mu u0) overflows.
StopTime stop_time(const ReducedSystem& system, State start, Route route);

}  // namespace contensou::reduction
