#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/orbit_point.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "options/argument.hpp"

namespace contensou::program {

/// The option --route.
class RouteOption {
 public:
  /// @param offered  routes that the help lists
  void add(CLI::App& app, const std::vector<reduction::Route>& offered = every_route());
  static const std::vector<reduction::Route>& every_route();

  bool given() const { return route_.given(); }
  const Argument& argument() const { return route_; }
  reduction::Route value_or(reduction::Route standard) const { return route_.value_or(standard); }

  /// Returns the given route; without one, the best route of the system.
  /// @throws BadInput  for a route that is not possible for the system
  reduction::Route read(const reduction::ReducedSystem& system) const;

 private:
  ArgumentOf<reduction::Route> route_;
};

/// Returns the states of a motion at given times, computed by any route.
///
/// @param times  tau >= 0, in any order; the rows of the result have the same order
/// @throws std::runtime_error  if a stepper did not reach the stop
reduction::OrbitColumns motion_at(const reduction::ReducedSystem& system, reduction::State start,
                                  reduction::Route route, const Eigen::ArrayXd& times);

/// Returns the states at given times before the stop. They are accurate to the last digits.
///
/// @param lefts  tau from the state to the stop, >= 0
/// @throws BadInput  for a time before the start, and for a stepper, which cannot compute these states
reduction::OrbitColumns motion_at_time_left(const reduction::ReducedSystem& system, reduction::State start,
                                            reduction::Route route, const Eigen::ArrayXd& lefts);

/// Returns the states at regularised times.
///
/// @param betas  >= 0
/// @throws BadInput  for a stepper, which accepts only tau
reduction::OrbitColumns motion_at_beta(const reduction::ReducedSystem& system, reduction::State start,
                                       reduction::Route route, const Eigen::ArrayXd& betas);

/// Returns the states at instants from the start to the stop, both included.
/// @param count        number of instants, >= 2
/// @param equidistant  false: half of the instants lie before one of the speeds has fallen to 1e-3 of its start
/// @throws std::runtime_error  as above, or if the stop time exceeds the largest double
reduction::OrbitColumns motion_samples(const reduction::ReducedSystem& system, reduction::State start,
                                       reduction::Route route, Eigen::Index count, bool equidistant);

/// Returns the states of a motion that consists of several orbits, at equidistant instants from the start to the stop.
/// @param at     returns the state at a time tau
/// @param stop   tau of the stop
reduction::OrbitColumns motion_samples(const std::function<reduction::OrbitPoint(double tau)>& at, double stop,
                                       Eigen::Index count);

}  // namespace contensou::program
