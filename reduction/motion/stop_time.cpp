#include "contensou/reduction/stop_time.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

namespace {

struct RouteText {
  Route route;
  std::string_view name;
  std::string_view description;
};

constexpr std::array route_texts{
    RouteText{Route::closed, "closed",
              "closed form, numerical error below 1e-15 for mu <= 1; only where the law has one"},
    RouteText{Route::quadrature, "quadrature",
              "quadrature of the separated equation, numerical error below 3e-15 for a smooth law"},
    RouteText{Route::regularised, "regularised",
              "(2.7) in ln u, ln v stepped in beta with (2.8), numerical error below 1e-10; any law and body"},
    RouteText{Route::direct, "direct",
              "(2.6) in ln u, ln v stepped in tau, numerical error below 1e-10; any law and body"},
};

const RouteText& text(Route route) { return *std::ranges::find(route_texts, route, &RouteText::route); }

StopTime by_stepper(const Motion& motion, Bounds bounds) {
  if (!motion.outcome.ok()) throw std::runtime_error(motion.outcome.sentence);
  return {motion.stop_time, 1e-10, motion.evaluations, bounds};
}

}  // namespace

std::string_view name(Route route) { return text(route).name; }

std::string_view description(Route route) { return text(route).description; }

std::vector<Route> routes(const ReducedSystem& system) {
  std::vector<Route> found;
  if (closed_solution(system.law(), system.r(), system.drive())) found.push_back(Route::closed);
  found.push_back(Route::quadrature);
  found.push_back(Route::regularised);
  found.push_back(Route::direct);
  return found;
}

StopTime stop_time(const ReducedSystem& system, State start) { return Flow(system).stop_time(start); }

StopTime stop_time(const ReducedSystem& system, State start, Route route) {
  switch (route) {
    case Route::closed: {
      const Flow flow(system);
      if (!flow.is_by_quadrature()) return flow.stop_time(start);
      throw std::domain_error(fmt::format("stop_time: law {} has no closed form at r = {}{}", system.law().name(),
                                          system.r(), system.drive() > 0 ? " with a drive" : ""));
    }
    case Route::quadrature:
      return Flow::by_quadrature(system).stop_time(start);
    case Route::regularised:
      return by_stepper(integrate_regularised(system, start), system.stop_time_bounds(start));
    case Route::direct:
      return by_stepper(integrate_directly(system, start), system.stop_time_bounds(start));
  }
  throw std::domain_error("stop_time: unknown route");
}

}  // namespace contensou::reduction
