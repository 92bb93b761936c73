#pragma once

#include <optional>
#include <vector>

#include "contensou/reduction/flow.hpp"
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

  /// Returns the given route; without one, the best route of the system.
  /// @throws BadInput  for a route that is not possible for the system
  reduction::Route read(const reduction::ReducedSystem& system) const;

 private:
  ArgumentOf<reduction::Route> route_;
};

/// Returns the flow from which a route computes orbits; empty for the steppers.
std::optional<reduction::Flow> flow_of(const reduction::ReducedSystem& system, reduction::Route route);

}  // namespace contensou::program
