#include "options/route_option.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace contensou::program {

using reduction::Flow;
using reduction::ReducedSystem;
using reduction::Route;

namespace {

std::vector<std::string> route_names(const std::vector<Route>& routes) {
  std::vector<std::string> names;
  for (Route route : routes) names.emplace_back(name(route));
  return names;
}

}  // namespace

const std::vector<Route>& RouteOption::every_route() {
  static const std::vector<Route> routes{Route::closed, Route::quadrature, Route::regularised, Route::direct};
  return routes;
}

void RouteOption::add(CLI::App& app, const std::vector<Route>& offered) {
  Choices<Route> choices;
  for (Route route : every_route()) choices.emplace_back(name(route), route);
  std::vector<std::string> methods = route_names(offered);
  for (std::string& method : methods)
    method += method == "closed" ? " (formulas)" : method == "quadrature" ? " (integrals)" : "";
  route_.add(app, "--route", "ROUTE",
             fmt::format("method: {} (time steps); default: first possible", fmt::join(methods, ", ")),
             one_of(choices, "route"));
}

Route RouteOption::read(const ReducedSystem& system) const {
  const std::vector<Route> available = reduction::routes(system);
  const Route route = route_.value_or(available.front());
  if (std::ranges::find(available, route) == available.end()) {
    route_.reject(fmt::format("law {} at mu = {} does not have this route; it has {}", system.law().name(), system.mu(),
                              fmt::join(route_names(available), ", ")));
  }
  return route;
}

std::optional<Flow> flow_of(const ReducedSystem& system, Route route) {
  if (route == Route::closed) return system;
  if (route == Route::quadrature) return Flow::by_quadrature(system);
  return std::nullopt;
}

}  // namespace contensou::program
