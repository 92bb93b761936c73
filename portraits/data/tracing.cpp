#include "data/tracing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/detail/root.hpp"
#include "data/round_numbers.hpp"

namespace contensou::portraits {

namespace {

using reduction::State;

/// Represents directions v/u by a number that grows from u > 0 to u < 0. On logarithmic axes it is ln(v/u). Otherwise
/// it is an angle in quarter turns, from 0 to 2, on the ellipse with the half axes window.u() and window.v().
class Directions {
 public:
  Directions(const reduction::Flow& flow, const Window& window, bool logarithmic)
      : flow_(flow), sides_{window.u(), window.v()}, logarithmic_(logarithmic) {
    const auto& [low, high] = window;
    constexpr int steps = 360;
    const double first = logarithmic ? std::log(low[1] / high[0]) : 0;
    const double last = logarithmic ? std::log(high[1] / low[0]) : 2;
    for (int i = 0; i <= steps; ++i) all_.push_back(first + (last - first) * i / steps);
    if (logarithmic) return;
    // Add directions down to k = 1e-4 next to the axis v = 0, where ln k changes fast.
    for (int decade = -4; decade <= 3; ++decade) {
      const double k = std::pow(10, decade);
      const double quarter = std::atan(k * flow.system().mu() * sides_.u / sides_.v) / (std::numbers::pi / 2);
      all_.insert(all_.end(), {quarter, 2 - quarter});
    }
    std::ranges::sort(all_);
  }

  const std::vector<double>& all() const { return all_; }

  /// Returns the state that lies in a direction and has the stop time 1.
  State unit(double direction) const {
    State ray{std::exp(-direction / 2), std::exp(direction / 2)};
    if (!logarithmic_) {
      const double quarter = direction < 1 ? direction : 2 - direction;
      const double angle = quarter * std::numbers::pi / 2;
      ray = {quarter == 1 ? 0 : sides_.u * std::cos(angle), sides_.v * std::sin(angle)};
      if (direction > 1) ray.u = -ray.u;
    }
    const double tau = flow_.orbit(ray).stop_time();
    return {ray.u / tau, ray.v / tau};
  }

 private:
  const reduction::Flow& flow_;
  State sides_;
  bool logarithmic_;
  std::vector<double> all_;
};

}  // namespace

IsochroneTimes isochrone_times(const PortraitRequest& request, double last, int usual) {
  const double unit = request.time_unit;
  std::vector<double> times = request.isochrone_times;
  if (times.empty()) {
    if (request.isochrones == 0) return {{}, 0};
    const double step = request.isochrones ? step_for(last / unit, *request.isochrones, {1, 2, 5, 2.5, 4, 3, 6, 8, 1.5})
                                           : step_for(last / unit, usual, {1, 2, 5});
    return {multiples(0, last, step * unit), step * unit};
  }
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  const double step = times.front();
  bool even = true;
  for (std::size_t i = 0; i < times.size(); ++i) {
    constexpr double same = 1e-9;
    even = even && std::abs(times[i] / step - static_cast<double>(i + 1)) < same;
  }
  for (double& time : times) time *= unit;
  return {times, even ? step * unit : 0};
}

std::vector<Isochrone> isochrones(const reduction::Flow& flow, const Window& window, const std::vector<double>& times,
                                  bool logarithmic) {
  const Directions directions(flow, window, logarithmic);
  const std::vector<double>& all = directions.all();
  std::vector<State> units;
  for (double direction : all) units.push_back(directions.unit(direction));

  std::vector<Isochrone> result;
  for (double tau : times) {
    const auto scaled = [tau](State unit) { return State{tau * unit.u, tau * unit.v}; };
    // Returns the last state inside the window between a direction outside and a direction inside.
    const auto border = [&](double outside, double within) {
      const auto is_inside = [&](double direction) { return window.contains(scaled(directions.unit(direction))); };
      return scaled(directions.unit(reduction::last_where(is_inside, within, outside)));
    };
    std::vector<State> piece;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const State here = scaled(units[i]);
      const bool is_inside = window.contains(here);
      if (i > 0 && is_inside && piece.empty()) piece.push_back(border(all[i - 1], all[i]));
      if (is_inside) piece.push_back(here);
      if (piece.empty() || (is_inside && i + 1 < all.size())) continue;
      if (!is_inside) piece.push_back(border(all[i], all[i - 1]));
      const auto rows = static_cast<Eigen::Index>(piece.size());
      // A State is two doubles in memory, so the piece is a matrix of 2 rows.
      const Eigen::Map<const Eigen::Array2Xd> columns(&piece.front().u, 2, rows);
      result.push_back({tau, columns.row(0), columns.row(1)});
      piece.clear();
    }
  }
  return result;
}

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
