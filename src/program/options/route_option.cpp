#include "options/route_option.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace contensou::program {

namespace {

using reduction::Route;

std::vector<std::string> names_of(const std::vector<Route>& routes) {
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
  route_.add(app, "--route", "ROUTE",
             fmt::format("{} (default: the first that the law has)", fmt::join(names_of(offered), ", ")),
             one_of(choices, "route"));
}

Route RouteOption::read(const reduction::ReducedSystem& system) const {
  const std::vector<Route> available = reduction::routes(system);
  const Route route = route_.value_or(available.front());
  if (std::ranges::find(available, route) == available.end()) {
    route_.reject(fmt::format("law {} at mu = {} does not have this route; it has {}", system.law().name(), system.mu(),
                              fmt::join(names_of(available), ", ")));
  }
  return route;
}

}  // namespace contensou::program
