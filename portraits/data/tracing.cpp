#include "data/tracing.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::portraits {

void require(const PortraitRequest& request, const Window& window) {
  const int orbits = request.orbits.value_or(0), isochrones = request.isochrones.value_or(0);
  if (orbits < 0 || isochrones < 0) {
    throw std::domain_error(
        fmt::format("portrait: numbers of orbits and isochrones must be >= 0, got {} and {}", orbits, isochrones));
  }
  for (double time : request.isochrone_times) {
    if (time > 0 && std::isfinite(time)) continue;
    throw std::domain_error(fmt::format("portrait: the time of an isochrone must be > 0, got {}", time));
  }
  for (const reduction::State& point : request.through) {
    if (window.contains(point)) continue;
    throw std::domain_error(fmt::format("portrait: the point ({}, {}) lies outside the window {} to {} by {} to {}",
                                        point.u, point.v, window.low[0], window.high[0], window.low[1],
                                        window.high[1]));
  }
}

Panel panel_of(const Window& window) {
  Panel panel;
  panel.x = {"", window.low[0], window.high[0], false, {}};
  panel.y = {"", window.low[1], window.high[1], false, {}};
  return panel;
}

PortraitOrbit columns(const Polyline& line, double tau_left) {
  // A Point is two doubles in memory, so the line is a matrix of 2 rows.
  const Eigen::Map<const Eigen::Array2Xd> rows(&line.front().x, 2, static_cast<Eigen::Index>(line.size()));
  return {.u = rows.row(0), .v = rows.row(1), .tau_left = Eigen::ArrayXd::Constant(rows.cols(), tau_left)};
}

bool is_one_orbit(const reduction::Flow& flow, const PortraitOrbit& motion) {
  constexpr double same = 1e-9;
  const double stop = flow.orbit({motion.u[0], motion.v[0]}).stop_time();
  return std::abs(motion.tau_left[0] - stop) <= same * stop;
}

}  // namespace contensou::portraits
