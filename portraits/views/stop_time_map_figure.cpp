#include "contensou/portraits/stop_time_map_figure.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace contensou::portraits {

namespace {

constexpr Colour isochrone_colour{0x1a1a1a};
constexpr Colour ray_colour{0xb3003b};

/// Ticks of a logarithmic axis: powers of ten, or 1, 2, 5 of each where there are few.
std::vector<Axis::Tick> logarithmic_ticks(double low, double high) {
  const double decades = std::log10(high / low);
  const std::vector<int> factors = decades < 2.5 ? std::vector<int>{1, 2, 5} : std::vector<int>{1};
  const int stride = std::max(1, static_cast<int>(std::ceil(decades / 12)));
  std::vector<Axis::Tick> ticks;
  for (int power = static_cast<int>(std::floor(std::log10(low))); power <= std::log10(high) + 1e-9; ++power) {
    if (power % stride != 0) continue;
    for (int factor : factors) {
      const double at = factor * std::pow(10, power);
      if (at < low * (1 - 1e-9) || at > high * (1 + 1e-9)) continue;
      ticks.push_back({at, factors.size() > 1 ? fmt::format("{:g}", at) : fmt::format("10^{{{}}}", power)});
    }
  }
  if (ticks.size() > 1) return ticks;
  return {{low, fmt::format("{:.3g}", low)}, {high, fmt::format("{:.3g}", high)}};
}

Axis axis(const std::string& name, double low, double high, bool logarithmic) {
  if (!logarithmic) return {name, low, high, false, {}};
  return {name, low, high, true, logarithmic_ticks(low, high)};
}

Axis axis(const std::string& name, const Eigen::ArrayXd& values, bool logarithmic) {
  return axis(name, values[0], values[values.size() - 1], logarithmic);
}

/// A value between those of a map, at a share of the way along either axis.
double between(const Eigen::ArrayXXd& values, double row_share, double column_share) {
  const auto split = [](double share, Eigen::Index count) {
    const double place = share * static_cast<double>(count - 1);
    const auto before = std::min(static_cast<Eigen::Index>(place), count - 2);
    return std::pair{before, place - static_cast<double>(before)};
  };
  const auto [i, y] = split(row_share, values.rows());
  const auto [j, x] = split(column_share, values.cols());
  return (1 - y) * ((1 - x) * values(i, j) + x * values(i, j + 1)) +
         y * ((1 - x) * values(i + 1, j) + x * values(i + 1, j + 1));
}

ColourMap colours(const StopTimeMap& map) {
  constexpr int rows = 180, columns = 240;
  const bool logarithmic = map.axes.logarithmic;
  const Eigen::ArrayXXd values = logarithmic ? Eigen::ArrayXXd(map.tau.log()) : map.tau;
  ColourMap image;
  image.columns = columns;
  image.scale = axis("{/:Italic τ}*", map.tau.minCoeff(), map.tau.maxCoeff(), logarithmic);
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const double value = between(values, (i + 0.5) / rows, (j + 0.5) / columns);
      image.values.push_back(logarithmic ? std::exp(value) : value);
    }
  }
  return image;
}

/// A point's place in the panel, both from 0 to 1.
Point place(const Panel& panel, Point point) {
  const auto share = [](const Axis& axis, double value) {
    if (axis.logarithmic) return std::log(value / axis.low) / std::log(axis.high / axis.low);
    return (value - axis.low) / (axis.high - axis.low);
  };
  return {share(panel.x, point.x), share(panel.y, point.y)};
}

/// Where a line is halfway along as it is seen; the length of it is what is returned beside.
std::pair<Point, double> middle(const Panel& panel, const Polyline& line) {
  std::vector<double> lengths{0};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Point before = place(panel, line[i - 1]), here = place(panel, line[i]);
    lengths.push_back(lengths.back() + std::hypot(here.x - before.x, here.y - before.y));
  }
  const auto half = std::ranges::lower_bound(lengths, lengths.back() / 2);
  return {line[static_cast<std::size_t>(half - lengths.begin())], lengths.back()};
}

Lines ray(const StopTimeMap& map) {
  const auto& [u0, v0, logarithmic] = map.axes;
  Lines ray{{}, {ray_colour, 1.4, true}, "{/:Italic k} = 1"};
  const double bottom = std::max(v0[0], 0.0), top = v0[v0.size() - 1];
  for (double side : {1.0, -1.0}) {
    // The part of v = mu |u| with u on this side and inside the map.
    const double near = std::max(side > 0 ? u0[0] : -u0[u0.size() - 1], 0.0);
    const double far = side > 0 ? u0[u0.size() - 1] : -u0[0];
    const double from = std::max(near, bottom / map.mu), to = std::min(far, top / map.mu);
    if (from < to) ray.lines.push_back({{side * from, map.mu * from}, {side * to, map.mu * to}});
  }
  return ray;
}

}  // namespace

Figure draw(const StopTimeMap& map) {
  constexpr double shortest_labelled = 0.15;
  const bool logarithmic = map.axes.logarithmic;
  Panel panel;
  panel.x = axis("{/:Italic u}_0,  pivoting at the start", map.axes.u0, logarithmic);
  panel.y = axis("{/:Italic v}_0,  sliding at the start", map.axes.v0, logarithmic);
  panel.colours = colours(map);

  Lines isochrones{{}, {isochrone_colour, 1.1, false}, "equal stop time {/:Italic τ}*"};
  for (const Isochrone& isochrone : map.isochrones) {
    Polyline line;
    for (Eigen::Index i = 0; i < isochrone.u.size(); ++i) line.push_back({isochrone.u[i], isochrone.v[i]});
    const auto [at, length] = middle(panel, line);
    if (length >= shortest_labelled) {
      panel.labels.push_back({at, fmt::format("{:.6g}", isochrone.tau_stop), isochrone_colour, Label::Align::centre});
    }
    isochrones.lines.push_back(std::move(line));
  }
  panel.lines.push_back(std::move(isochrones));
  if (Lines guide = ray(map); !guide.lines.empty()) panel.lines.push_back(std::move(guide));

  Figure figure;
  figure.title = fmt::format("When it stops,  {{/:Italic μ}} = {:.4g},  law: {}", map.mu, literal(map.law));
  figure.subtitle = "stop time {/:Italic τ}* of every start, in the unit of the speeds";
  figure.width_mm = 175;
  figure.height_mm = 130;
  figure.panels = {std::move(panel)};
  return figure;
}

}  // namespace contensou::portraits
