#include "contensou/portraits/theory_figures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "data/round_numbers.hpp"
#include "views/portrait_panel.hpp"

namespace contensou::portraits {

namespace {

constexpr Colour guide_colour{0x888888};
constexpr Colour curve_colour{0x0b4f8a};
constexpr Colour marked_colour{0xb3003b};

constexpr double ends = 100;  ///< k ranges from 1/ends to ends
constexpr int pieces = 600;

/// Returns k of point i of a curve. The range of k is larger than the panel, so that no curve ends inside it.
double ratio_at(int i) { return std::pow(ends, 1.5 * (2.0 * i / pieces - 1)); }

/// One r for which curves are drawn.
struct Drawn {
  double r;
  Stroke stroke;
  Text legend;
};

/// Returns the r for which this k is an invariant ray: (Phi - rho)/(k Psi) for force Phi, moment Psi and drive rho.
double force_over_moment(const reduction::Law& law, double k, double drive) {
  const auto [force, moment] = law(reduction::slip_of_ratio(k));
  return (force - drive) / (k * moment);
}

/// Returns the k at which the drive balances the force, Phi = rho. It is the ray for r = 0.
double k_without_moment(const reduction::Law& law, double drive) {
  return reduction::terminal_ratios(law, 1e-12, drive).rays.front().k;
}

Panel panel_over_k(const Text& title) {
  Panel panel;
  panel.title = title;
  panel.x = {math("k = v/(μ|u|)"), 1 / ends, ends, true, {}};
  return panel;
}

/// Draws k* against r: attracting rays solid, repelling rays dashed.
Panel rays(const reduction::Law& law, double low, double high, std::optional<double> marked, double drive) {
  std::vector<Point> points;
  if (drive > 0) points.push_back({0, k_without_moment(law, drive)});
  const double first = points.empty() ? 0 : points[0].y;
  for (int i = 0; i <= pieces; ++i) {
    if (ratio_at(i) > first) points.push_back({force_over_moment(law, ratio_at(i), drive), ratio_at(i)});
  }
  const auto [least, largest] = std::ranges::minmax(points, {}, &Point::x);
  const double bottom = std::min({low, high, least.x, marked.value_or(low)});
  const double top = std::max({low, high, largest.x, marked.value_or(low)});
  Panel panel;
  panel.title = "invariant rays";
  panel.x = {math("r = γμ") + sup("2") + math("/χ"), 0, 1.2 * top, false, {}};
  if (drive == 0 && top > 20 * bottom) panel.x = {panel.x.name, 0.5 * bottom, 2 * top, true, {}};
  panel.y = {math("k*"), 1 / ends, ends, true, {}};
  // Along the curve of attracting rays, r = (Phi - rho)/(k Psi) grows with k.
  Lines attracting{{}, {curve_colour, 2.4}, "attracts"}, repelling{{}, {curve_colour, 1.4, true}, "repels"};
  for (std::size_t begin = 0; begin + 1 < points.size();) {
    const bool grows = points[begin + 1].x > points[begin].x;
    std::size_t end = begin + 1;
    while (end + 1 < points.size() && (points[end + 1].x > points[end].x) == grows) ++end;
    (grows ? attracting : repelling)
        .lines.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(begin),
                            points.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    begin = end;
  }
  Lines borders{{{{high, 1 / ends}, {high, ends}}}, {guide_colour, 1, false, true}, ""};
  if (drive == 0) borders.lines.push_back({{low, 1 / ends}, {low, ends}});
  panel.lines = {std::move(borders)};
  if (drive > 0) {
    Polyline undriven;
    for (int i = 0; i <= pieces; ++i) undriven.push_back({force_over_moment(law, ratio_at(i), 0), ratio_at(i)});
    panel.lines.push_back({{std::move(undriven)}, {guide_colour, 1.4}, "without a drive"});
  }
  for (Lines* lines : {&attracting, &repelling}) {
    if (!lines->lines.empty()) panel.lines.push_back(std::move(*lines));
  }
  // Labels stand away from the curve. The curve begins at r_low for k = 0 and tends to r_high for k -> infinity.
  panel.labels = {{{high, 1.6 / ends}, math("r") + sub("high"), guide_colour}};
  if (drive == 0) panel.labels.push_back({{low, ends / 1.6}, math("r") + sub("low"), guide_colour});
  if (marked) panel.lines.push_back({{{{*marked, 1 / ends}, {*marked, ends}}}, {marked_colour, 1.6, true, true}, ""});
  return panel;
}

/// Draws D = Phi - rho - r k Psi divided by the sum of its terms, with arrow heads that show the direction of k.
Panel ways(const reduction::Law& law, const std::vector<Drawn>& all, double drive) {
  Panel panel = panel_over_k(math("k") + " falls where " + math("D > 0"));
  panel.y = {math(drive > 0 ? "D/(Φ + ρ + r k Ψ)" : "D/(Φ + r k Ψ)"), -1.05, 1.05, false, {}};
  for (const auto& [r, stroke, legend] : all) {
    Polyline line;
    for (int i = 0; i <= pieces; ++i) {
      const double k = ratio_at(i);
      const auto [force, moment] = law(reduction::slip_of_ratio(k));
      line.push_back({k, (force - drive - r * k * moment) / (force + drive + r * k * moment)});
    }
    Arrows heads{{}, stroke.colour, 1};
    for (const double place : {0.15, 0.4, 0.6, 0.85}) {
      const Point& at = line[static_cast<std::size_t>(pieces * (0.5 + (place - 0.5) / 1.5))];
      heads.arrows.push_back({at, {at.y > 0 ? -at.x : at.x, 0}});
    }
    panel.lines.push_back({{std::move(line)}, stroke, legend});
    panel.arrows.push_back(std::move(heads));
  }
  panel.lines.insert(panel.lines.begin(), {{{{1 / ends, 0}, {ends, 0}}}, {guide_colour, 1}, ""});
  return panel;
}

/// Draws the sliding coefficient m between its bounds. A line ends at each ray.
Panel coefficients(const reduction::Law& law, const std::vector<Drawn>& all, double drive) {
  Panel panel = panel_over_k("time left = " + math("P + m S"));
  panel.y = {math("m"), 0, 0, false, {}};
  for (const auto& [r, stroke, legend] : all) {
    const reduction::Flow flow({law, 1, {.chi = 1, .gamma = r}, drive});
    Lines lines{{}, stroke, legend};
    for (const auto& curve : flow.solution().curves()) {
      Polyline line;
      for (int i = 0; i <= pieces; ++i) {
        const double k = ratio_at(i);
        if (flow.solution().through(std::log(k)) != curve) continue;
        line.push_back({k, curve->sliding_coefficient(curve->chart().coordinate(std::log(k)))});
        // Under a drive m is singular for k -> 0.
        if (drive == 0 || k >= 1) panel.y.high = std::max(panel.y.high, 1.1 * line.back().y);
      }
      lines.lines.push_back(std::move(line));
    }
    panel.lines.push_back(std::move(lines));
  }
  if (const auto bounds = law.sliding_bounds(); bounds && drive == 0) {
    panel.y.high = std::max(panel.y.high, 1.08 * bounds->max);
    panel.y.low = bounds->min > 0 ? 0.8 * bounds->min : -0.04;
    Lines borders{{}, {guide_colour, 1, false, true}, "bounds of " + math("m")};
    for (const double m : {bounds->min, bounds->max}) borders.lines.push_back({{1 / ends, m}, {ends, m}});
    panel.lines.insert(panel.lines.begin(), std::move(borders));
  }
  return panel;
}

}  // namespace

Figure rays_figure(const reduction::Law& law, std::optional<double> r, const AskedSize& size, double drive) {
  const reduction::TerminalRatios ratios = reduction::terminal_ratios(law, r.value_or(1), drive);
  const auto [low, high] = std::minmax(ratios.low, ratios.high);
  std::vector<Drawn> all;
  const auto add = [&](double value, Colour colour, double width, bool dashed, bool dotted) {
    all.push_back({value, {colour, width, dashed, dotted}, math("r = ") + number(value, 3)});
  };
  add(0.5 * low, viridis(0), 2, false, false);
  if (high > 1.001 * low) add(std::sqrt(low * high), viridis(0.4), 1.8, true, false);
  add(1.6 * high, viridis(0.7), 2, false, true);
  if (r) add(*r, marked_colour, 1.8, true, true);

  Figure figure;
  figure.title = "Where motions end,  law: " + shortened(law.name());
  if (drive > 0) figure.title += fmt::format(",  drive {:.3g}", drive);
  figure.subtitle = "on a ray " + math(drive > 0 ? "Φ = ρ + r k Ψ" : "Φ = r k Ψ") +
                    "; motions end on an attracting ray, or with " + math("k") + (drive > 0 ? " → ∞" : " → 0 or ∞");
  figure.size = fitted({270, 105}, 3, size);
  figure.panels = {rays(law, ratios.low, ratios.high, r, drive), ways(law, all, drive), coefficients(law, all, drive)};
  return figure;
}

}  // namespace contensou::portraits
