#pragma once

#include <vector>

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
  reduction::Route value_or(reduction::Route standard) const { return route_.value_or(standard); }

  /// The route of that name; the system's best if none was given.
  /// @throws BadInput  for a route that the system does not have
  reduction::Route read(const reduction::ReducedSystem& system) const;

 private:
  ArgumentOf<reduction::Route> route_;
};

}  // namespace contensou::program
