#include "options/route_option.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "contensou/reduction/direct_motion.hpp"
#include "contensou/reduction/regularised_motion.hpp"
#include "contensou/reduction/regularised_time.hpp"
#include "options/instants_option.hpp"

namespace contensou::program {

using reduction::Flow;
using reduction::Motion;
using reduction::Orbit;
using reduction::OrbitColumns;
using reduction::ReducedSystem;
using reduction::Route;
using reduction::State;

namespace {

std::vector<std::string> names_of(const std::vector<Route>& routes) {
  std::vector<std::string> names;
  for (Route route : routes) names.emplace_back(name(route));
  return names;
}

/// @param times  times that do not decrease, because a stepper only goes forwards
Motion step(const ReducedSystem& system, State start, Route route, const Eigen::ArrayXd& times) {
  Motion motion = route == Route::regularised ? reduction::integrate_regularised(system, start, times)
                                              : reduction::integrate_directly(system, start, times);
  if (!motion.outcome.ok()) throw std::runtime_error(motion.outcome.sentence);
  return motion;
}

/// Returns the flow from which a route computes orbits; empty for the steppers.
std::optional<Flow> flow_of(const ReducedSystem& system, Route route) {
  if (route == Route::closed) return system;
  if (route == Route::quadrature) return Flow::by_quadrature(system);
  return std::nullopt;
}

/// Returns the first tau at which a speed has fallen to 1e-3 of its start. Most of the motion happens before this tau.
double busy_time(const Orbit& orbit, State start) {
  const double v = start.v > 0 ? orbit.time_of_v(1e-3 * start.v) : 0;
  const double u = start.u != 0 ? orbit.time_of_u(1e-3 * std::abs(start.u)) : 0;
  return start.v == 0 ? u : start.u == 0 ? v : std::min(u, v);
}

double require_finite(double stop) {
  if (std::isfinite(stop)) return stop;
  throw std::runtime_error("the stop time exceeds the largest double: use a larger unit of speed");
}

}  // namespace

const std::vector<Route>& RouteOption::every_route() {
  static const std::vector<Route> routes{Route::closed, Route::quadrature, Route::regularised, Route::direct};
  return routes;
}

void RouteOption::add(CLI::App& app, const std::vector<Route>& offered) {
  Choices<Route> choices;
  for (Route route : every_route()) choices.emplace_back(name(route), route);
  std::vector<std::string> methods = names_of(offered);
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
                              fmt::join(names_of(available), ", ")));
  }
  return route;
}

OrbitColumns motion_at(const ReducedSystem& system, State start, Route route, const Eigen::ArrayXd& times) {
  if (const auto flow = flow_of(system, route)) return flow->orbit(start).at_times(times);
  if (times.size() == 0) return OrbitColumns();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(times.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return times[i]; });
  const Motion motion = step(system, start, route, times(order));
  OrbitColumns columns(times.size());
  for (Eigen::Index row = 0; Eigen::Index i : order) columns.set(i, motion.points.row(row++));
  return columns;
}

OrbitColumns motion_at_time_left(const ReducedSystem& system, State start, Route route, const Eigen::ArrayXd& lefts) {
  const auto flow = flow_of(system, route);
  if (!flow)
    throw BadInput(
        "--time-left needs --route closed or quadrature: the other routes do not compute the stop in advance");
  const Orbit orbit = flow->orbit(start);
  OrbitColumns columns(lefts.size());
  for (Eigen::Index i = 0; i < lefts.size(); ++i) {
    if (!(lefts[i] <= orbit.stop_time())) {
      throw BadInput("--time-left: {} is before the start, which is {} before the stop", lefts[i], orbit.stop_time());
    }
    columns.set(i, orbit.at_time_left(lefts[i]));
  }
  return columns;
}

OrbitColumns motion_at_beta(const ReducedSystem& system, State start, Route route, const Eigen::ArrayXd& betas) {
  const auto flow = flow_of(system, route);
  if (!flow) throw BadInput("--beta needs --route closed or quadrature: give --at with the other routes");
  return reduction::at_betas(*flow, start, betas);
}

OrbitColumns motion_samples(const ReducedSystem& system, State start, Route route, Eigen::Index count,
                            bool equidistant) {
  const auto flow = flow_of(system, route);
  const Orbit orbit = (flow ? *flow : Flow(system)).orbit(start);
  const std::optional<Motion> whole = flow ? std::nullopt : std::optional(step(system, start, route, {}));
  const double stop = require_finite(whole ? whole->stop_time : orbit.stop_time());
  const double busy = equidistant ? 0 : busy_time(orbit, start);
  if (flow && !(2 * busy < stop && busy > 0)) return orbit.sample(count);
  const Eigen::ArrayXd times = instants(count, busy, stop);
  OrbitColumns columns = motion_at(system, start, route, times);
  if (!flow) {
    columns.set(count - 1, whole->points.row(whole->points.rows() - 1));
    return columns;
  }
  for (Eigen::Index i = count / 2; i < count; ++i) columns.set(i, orbit.at_time_left(stop - times[i]));
  return columns;
}

OrbitColumns motion_samples(const std::function<reduction::OrbitPoint(double tau)>& at, double stop,
                            Eigen::Index count) {
  OrbitColumns columns(count);
  for (Eigen::Index i = 0; i < count; ++i)
    columns.set(i, at(stop * (static_cast<double>(i) / static_cast<double>(count - 1))));
  return columns;
}

}  // namespace contensou::program
