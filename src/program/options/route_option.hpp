#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/stop_time.hpp"
#include "options/argument.hpp"

namespace contensou::program {

/// --route.
class RouteOption {
 public:
  /// @param offered  what the help names
  void add(CLI::App& app, const std::vector<reduction::Route>& offered = every_route());
  static const std::vector<reduction::Route>& every_route();

  bool given() const { return route_.given(); }
  const Argument& argument() const { return route_; }
  reduction::Route value_or(reduction::Route standard) const { return route_.value_or(standard); }

  /// The route of that name; the system's best if none was given.
  /// @throws BadInput  for a route that the system does not have
  reduction::Route read(const reduction::ReducedSystem& system) const;

 private:
  ArgumentOf<reduction::Route> route_;
};

/// States along a motion by any route.
///
/// @param times  tau >= 0, in any order; the rows come in that order
/// @throws std::runtime_error  if a stepper did not reach the stop
reduction::OrbitColumns motion_at(const reduction::ReducedSystem& system, reduction::State start,
                                  reduction::Route route, const Eigen::ArrayXd& times);

/// States at so much time before the stop, to the last digits.
///
/// @param lefts  tau before the stop
/// @throws BadInput  for a time before the start, and for a stepper, which has none
reduction::OrbitColumns motion_at_time_left(const reduction::ReducedSystem& system, reduction::State start,
                                            reduction::Route route, const Eigen::ArrayXd& lefts);

/// States at regularised times.
///
/// @param betas  >= 0
/// @throws BadInput  for a stepper, which is asked by tau
reduction::OrbitColumns motion_at_beta(const reduction::ReducedSystem& system, reduction::State start,
                                       reduction::Route route, const Eigen::ArrayXd& betas);

/// @param count        instants from the start to the stop, both included; 2 or more
/// @param equidistant  or half of them until the first of the speeds has fallen to 1e-3 of its start
/// @throws std::runtime_error  as above, or if the stop time exceeds the largest double
reduction::OrbitColumns motion_samples(const reduction::ReducedSystem& system, reduction::State start,
                                       reduction::Route route, Eigen::Index count, bool equidistant);

/// The same of a motion of several orbits, one after the other, each by quadrature.
/// @param at  the state at a time tau
reduction::OrbitColumns motion_samples(const std::function<reduction::OrbitPoint(double tau)>& at, double stop,
                                       Eigen::Index count);

}  // namespace contensou::program
