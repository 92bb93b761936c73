#include "options/route_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <vector>

#include "contensou/reduction/direct_motion.hpp"
#include "contensou/reduction/regularised_motion.hpp"

namespace contensou::program {

using reduction::Flow;
using reduction::Motion;
using reduction::Orbit;
using reduction::OrbitColumns;
using reduction::ReducedSystem;
using reduction::Route;
using reduction::State;

namespace {

Motion step(const ReducedSystem& system, State start, Route route, const Eigen::ArrayXd& times) {
  Motion motion = route == Route::regularised ? reduction::integrate_regularised(system, start, times)
                                              : reduction::integrate_directly(system, start, times);
  if (!motion.outcome.ok()) throw std::runtime_error(motion.outcome.sentence);
  return motion;
}

/// The flow that a route computes orbits from; none for the steppers.
std::optional<Flow> flow_of(const ReducedSystem& system, Route route) {
  if (route == Route::closed) return system;
  if (route == Route::quadrature) return Flow::by_quadrature(system);
  return std::nullopt;
}

double require_finite(double stop) {
  if (std::isfinite(stop)) return stop;
  throw std::runtime_error("the stop time exceeds the largest double: use a larger unit of speed");
}

}  // namespace

OrbitColumns motion_at(const ReducedSystem& system, State start, Route route, const Eigen::ArrayXd& times) {
  if (const auto flow = flow_of(system, route)) return flow->orbit(start).at_times(times);
  if (times.size() == 0) return OrbitColumns();

  // The steppers go forwards only.
  std::vector<Eigen::Index> order(static_cast<std::size_t>(times.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return times[i]; });
  Eigen::ArrayXd increasing(times.size());
  for (Eigen::Index i = 0; i < times.size(); ++i) increasing[i] = times[order[static_cast<std::size_t>(i)]];
  const Motion motion = step(system, start, route, increasing);
  OrbitColumns columns(times.size());
  for (Eigen::Index i = 0; i < times.size(); ++i) {
    columns.set(order[static_cast<std::size_t>(i)], motion.points.row(i));
  }
  return columns;
}

OrbitColumns motion_samples(const ReducedSystem& system, State start, Route route, Eigen::Index count) {
  if (const auto flow = flow_of(system, route)) {
    const Orbit orbit = flow->orbit(start);
    require_finite(orbit.stop_time());
    return orbit.sample(count);
  }
  const Motion whole = step(system, start, route, {});
  const double stop = require_finite(whole.stop_time);
  OrbitColumns columns = motion_at(system, start, route, Eigen::ArrayXd::LinSpaced(count, 0, stop));
  columns.set(count - 1, whole.points.row(whole.points.rows() - 1));
  return columns;
}

}  // namespace contensou::program
