#include "contensou/portraits/stop_time_map.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "views/portrait_panel.hpp"

namespace contensou::portraits {

namespace {

constexpr Colour isochrone_colour{0x1a1a1a};
constexpr Colour ray_colour{0xb3003b};

Axis axis(const Text& name, const Eigen::ArrayXd& values, bool logarithmic) {
  return {name, values[0], values[values.size() - 1], logarithmic, {}};
}

/// Returns a value of a map, interpolated at fractions of both axes.
double between(const Eigen::ArrayXXd& values, double row_share, double column_share) {
  const auto split = [](double fraction, Eigen::Index count) {
    const double place = fraction * static_cast<double>(count - 1);
    const auto before = std::min(static_cast<Eigen::Index>(place), count - 2);
    return std::pair{before, place - static_cast<double>(before)};
  };
  const auto [i, y] = split(row_share, values.rows());
  const auto [j, x] = split(column_share, values.cols());
  return (1 - y) * ((1 - x) * values(i, j) + x * values(i, j + 1)) +
         y * ((1 - x) * values(i + 1, j) + x * values(i + 1, j + 1));
}

ColourMap colours(const StopTimeMap& map, const Text& time) {
  constexpr int rows = 180, columns = 240;
  const bool logarithmic = map.axes.logarithmic;
  const Eigen::ArrayXXd values = logarithmic ? Eigen::ArrayXXd(map.tau.log()) : map.tau;
  ColourMap image;
  image.columns = columns;
  image.scale = {time, map.tau.minCoeff(), map.tau.maxCoeff(), logarithmic, {}};
  // Colours are dark for short stop times, as in portraits, but paler, so that lines are visible on them.
  constexpr int steps = 16;
  for (int i = 0; i <= steps; ++i) image.palette.push_back(viridis(static_cast<double>(i) / steps, 0.35));
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const double value = between(values, (i + 0.5) / rows, (j + 0.5) / columns);
      image.values.push_back(logarithmic ? std::exp(value) : value);
    }
  }
  return image;
}

Lines ray(const StopTimeMap& map) {
  const auto& [u0, v0, logarithmic] = map.axes;
  Lines ray{{}, {ray_colour, 1.4, true}, math("k = 1")};
  const double bottom = std::max(v0[0], 0.0), top = v0[v0.size() - 1];
  for (double side : {1.0, -1.0}) {
    // Add the part of the line v = mu |u| on this side of u = 0 and inside the map.
    const double near = std::max(side > 0 ? u0[0] : -u0[u0.size() - 1], 0.0);
    const double far = side > 0 ? u0[u0.size() - 1] : -u0[0];
    const double from = std::max(near, bottom / map.mu), to = std::min(far, top / map.mu);
    if (from < to) ray.lines.push_back({{side * from, map.mu * from}, {side * to, map.mu * to}});
  }
  return ray;
}

}  // namespace

Figure draw(StopTimeMap map, const MapCaption& caption, const AskedSize& size) {
  constexpr double min_labelled = 0.15;
  Figure figure;
  figure.title = !caption.title.empty() ? caption.title
                                        : title_of("When it stops", fmt::format("{:.4g}", map.mu), shortened(map.law));
  figure.subtitle = caption.subtitle;
  figure.size = fitted({175, 130}, 1, size);
  // From here on, values are in the units of the axes.
  map.axes.u0 /= caption.u_unit;
  map.mu *= caption.u_unit;
  map.tau /= caption.time_unit;
  Panel panel;
  panel.x = axis(caption.u, map.axes.u0, map.axes.logarithmic);
  panel.y = axis(caption.v, map.axes.v0, map.axes.logarithmic);
  panel.colours = colours(map, caption.time);

  Lines isochrones{{}, {isochrone_colour, 1.1, false}, "equal stop time " + caption.time};
  for (const Isochrone& isochrone : map.isochrones) {
    Polyline line;
    for (Eigen::Index i = 0; i < isochrone.u.size(); ++i) {
      line.push_back({isochrone.u[i] / caption.u_unit, isochrone.v[i]});
    }
    if (paper_length(panel, line) >= min_labelled) {
      // Neighbouring labels have different heights.
      const double fraction = panel.labels.size() % 2 == 0 ? 0.46 : 0.54;
      panel.labels.push_back({arrow_along(panel, line, fraction).at,
                              fmt::format("{:.6g}", isochrone.tau_stop / caption.time_unit), isochrone_colour});
    }
    isochrones.lines.push_back(std::move(line));
  }
  panel.lines.push_back(std::move(isochrones));
  if (Lines guide = ray(map); !guide.lines.empty()) panel.lines.push_back(std::move(guide));
  figure.panels = {std::move(panel)};
  return figure;
}

}  // namespace contensou::portraits
