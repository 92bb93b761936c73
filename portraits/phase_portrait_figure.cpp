#include "contensou/portraits/phase_portrait_figure.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace contensou::portraits {

namespace {

// Legible in grey and for colour-blind readers: dark orbits, light times, one accent.
constexpr Colour orbit_colour{0x0b4f8a};
constexpr Colour isochrone_colour{0xc8761a};
constexpr Colour axis_colour{0x222222};
constexpr Colour highlight_colour{0xb3003b};

/// How far down the contact panel reaches: to where u has fallen to this share of its start.
constexpr double smallest_share = 1.0 / 20;

/// Distance on paper, in units of the panel.
double distance(const Panel& panel, Point a, Point b) {
  return std::hypot((a.x - b.x) / (panel.x.high - panel.x.low), (a.y - b.y) / (panel.y.high - panel.y.low));
}

/// An arrow head at a share of the line's length on paper.
void add_arrow(const Panel& panel, const Polyline& line, double share, Arrows& arrows) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) length += distance(panel, line[i - 1], line[i]);
  double to_go = share * length;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double piece = distance(panel, line[i - 1], line[i]);
    if (piece > 0 && to_go <= piece) {
      const Point direction{line[i].x - line[i - 1].x, line[i].y - line[i - 1].y};
      const double t = to_go / piece;
      arrows.arrows.push_back({{line[i - 1].x + t * direction.x, line[i - 1].y + t * direction.y}, direction});
      return;
    }
    to_go -= piece;
  }
}

std::string number(double value) { return fmt::format("{:.6g}", value); }

/// A large number with its power of ten, as people write it.
std::string power_of_ten(double value) {
  if (value < 1e4) return fmt::format("{:.4g}", value);
  const double exponent = std::floor(std::log10(value));
  return fmt::format("{:.3g}·10^{{{}}}", value / std::pow(10, exponent), exponent);
}

Axis pivoting_axis(const PhasePortrait& portrait, const std::string& unit) {
  return {"{/:Italic u} = {/:Italic R ω_z}" + unit, -portrait.window.u, portrait.window.u, false, {}};
}

Lines isochrone_lines() { return {{}, {isochrone_colour, 1.1, true}, ""}; }
Lines orbit_lines() { return {{}, {orbit_colour, 1.3, false}, "orbits"}; }

void add_orbits(Panel& panel, Lines orbits, double arrow_share) {
  Arrows arrows{{}, orbit_colour};
  for (const Polyline& line : orbits.lines) add_arrow(panel, line, arrow_share, arrows);
  panel.lines.push_back(std::move(orbits));
  panel.arrows.push_back(std::move(arrows));
}

void add_highlight(Panel& panel, Polyline line, const std::string& legend) {
  constexpr double arrow_share = 0.45;
  Arrows arrows{{}, highlight_colour};
  add_arrow(panel, line, arrow_share, arrows);
  panel.marks.push_back({{line.front()}, highlight_colour});
  panel.lines.push_back({{std::move(line)}, {highlight_colour, 2.6, false}, legend});
  panel.arrows.push_back(std::move(arrows));
}

/// What lies beside a point at its height: the nearest orbits, the axis u = 0, or the border.
struct Gap {
  double left;
  double right;
};

Gap gap_around(const PhasePortrait& portrait, double u, double v) {
  Gap gap{u < 0 ? -portrait.window.u : 0, u < 0 ? 0 : portrait.window.u};
  for (const PortraitOrbit& orbit : portrait.orbits) {
    if (orbit.v[0] < v || orbit.u[0] * u < 0) continue;
    Eigen::Index i = 1;
    while (orbit.v[i] > v) ++i;
    const double share = (orbit.v[i - 1] - v) / (orbit.v[i - 1] - orbit.v[i]);
    const double here = orbit.u[i - 1] + share * (orbit.u[i] - orbit.u[i - 1]);
    if (here <= u) gap.left = std::max(gap.left, here);
    if (here >= u) gap.right = std::min(gap.right, here);
  }
  return gap;
}

/// Where a label of the given width touches no orbit: on the middle part of the isochrone, on the side of that sign,
/// where most room is; and moved off the isochrone as far as it must be.
Point place_label(const PhasePortrait& portrait, const Isochrone& isochrone, double side, double width) {
  const double lowest = isochrone.v.minCoeff();
  const double highest = isochrone.v.maxCoeff();
  Point best{};
  double widest = 0;
  for (Eigen::Index i = 0; i < isochrone.u.size(); ++i) {
    const double u = isochrone.u[i];
    const double height = (isochrone.v[i] - lowest) / (highest - lowest);
    if (u * side <= 0 || height < 0.2 || height > 0.85) continue;
    const auto [left, right] = gap_around(portrait, u, isochrone.v[i]);
    const double room = std::min({2 * (u - left), 2 * (right - u), right - left - width});
    if (best.x != 0 && room <= widest) continue;
    widest = room;
    const double middle = (left + right) / 2;
    const double slack = std::max(0.0, (right - left - width) / 2);
    best = {std::clamp(u, middle - slack, middle + slack), isochrone.v[i]};
  }
  return best;
}

/// The plane (u, v) of Fig. 4.
Panel plane_panel(const PhasePortrait& portrait, const PortraitCaption& caption) {
  const auto [U, V] = portrait.window;
  const std::string unit = caption.speed_unit.empty() ? "" : ", " + caption.speed_unit;
  Panel panel;
  panel.x = pivoting_axis(portrait, unit);
  panel.y = {"{/:Italic v}" + unit, 0, V, false, {}};

  const auto line_of = [](const Eigen::ArrayXd& u, const Eigen::ArrayXd& v) {
    Polyline line;
    for (Eigen::Index i = 0; i < u.size(); ++i) line.push_back({u[i], v[i]});
    return line;
  };
  Lines isochrones = isochrone_lines();
  isochrones.legend = fmt::format("time left {}{}", caption.time_symbol,
                                  caption.time_unit_name.empty() ? "" : ", " + caption.time_unit_name);
  // Labels on the side where the highlighted orbit is not.
  const double side = portrait.highlight && portrait.highlight->u[0] > 0 ? -1 : 1;
  for (const Isochrone& isochrone : portrait.isochrones) {
    isochrones.lines.push_back(line_of(isochrone.u, isochrone.v));
    if ((isochrone.u * side).maxCoeff() <= 0) continue;
    const std::string text = number(isochrone.tau_stop / caption.time_unit);
    const double width = (0.014 * static_cast<double>(text.size()) + 0.01) * 2 * U * 0.85;
    panel.labels.push_back(
        {place_label(portrait, isochrone, side, width), text, isochrone_colour, Label::Align::centre});
  }
  panel.lines.push_back(std::move(isochrones));

  Lines orbits = orbit_lines();
  for (const PortraitOrbit& orbit : portrait.orbits) orbits.lines.push_back(line_of(orbit.u, orbit.v));
  add_orbits(panel, std::move(orbits), 0.3);

  panel.lines.push_back({{{{-U, 0}, {U, 0}}, {{0, V}, {0, 0}}}, {axis_colour, 2.4, false}, "invariant axes"});
  panel.arrows.push_back({{{{0.55 * U, 0}, {-1, 0}}, {{-0.55 * U, 0}, {1, 0}}, {{0, 0.55 * V}, {0, -1}}}, axis_colour});
  if (portrait.highlight) {
    add_highlight(panel, line_of(portrait.highlight->u, portrait.highlight->v), caption.highlight);
  }
  return panel;
}

/// Fills the strip beside the outermost orbits with orbits that start farther out: by scaling, u -> c u at equal k.
void add_scaled_copies(std::vector<Polyline>& lines, double half_width) {
  constexpr int copies = 8;
  const auto outermost =
      std::ranges::max_element(lines, {}, [](const Polyline& line) { return std::abs(line.front().x); });
  const Polyline pattern = *outermost;
  for (int i = 1; i <= copies; ++i) {
    const double factor = std::pow(smallest_share, -static_cast<double>(i) / (copies + 1));
    for (double sign : {1.0, -1.0}) {
      Polyline copy;
      for (std::size_t j = 0; j < pattern.size(); ++j) {
        const Point here{sign * factor * pattern[j].x, pattern[j].y};
        if (std::abs(here.x) > half_width) continue;
        if (copy.empty() && j > 0) {  // begin on the border
          const double before = std::abs(factor * pattern[j - 1].x);
          const double share = (half_width - std::abs(here.x)) / (before - std::abs(here.x));
          copy.push_back({std::copysign(half_width, here.x), here.y + share * (pattern[j - 1].y - here.y)});
        }
        copy.push_back(here);
      }
      lines.push_back(std::move(copy));
    }
  }
}

/// The same orbits in (u, ln k), where even a contact of order 10^5 with the axis v = 0 has a shape.
Panel contact_panel(const PhasePortrait& portrait, const PortraitCaption& caption) {
  const double top = std::log(portrait.window.v / (portrait.mu * portrait.window.u));
  const double depth = -portrait.pivoting_slope * std::log(smallest_share);
  Panel panel;
  panel.title = fmt::format("how orbits touch the axis {{/:Italic v}} = 0:  {{/:Italic k}} ∝ |{{/:Italic u}}|^{{{}}}",
                            power_of_ten(portrait.pivoting_slope));
  panel.x = pivoting_axis(portrait, caption.speed_unit.empty() ? "" : ", " + caption.speed_unit);
  panel.y = {
      "ln {/:Italic k},   {/:Italic k = v}/({/:Italic μ}|{/:Italic u}|)", top - depth, top + 0.02 * depth, false, {}};
  const double low = top - 2 * depth;  // -infinity is drawn here, below the border

  Lines isochrones = isochrone_lines();
  for (const Isochrone& isochrone : portrait.isochrones) {
    Polyline line;
    for (Eigen::Index i = 0; i < isochrone.u.size(); ++i) {
      const double ln_k = std::log(isochrone.v[i] / (portrait.mu * std::abs(isochrone.u[i])));
      if (ln_k < 0) line.push_back({isochrone.u[i], std::max(ln_k, low)});  // beyond, too flat to be seen here
      const bool breaks = ln_k >= 0 && !line.empty();
      if (breaks) isochrones.lines.push_back(std::exchange(line, {}));
    }
    if (!line.empty()) isochrones.lines.push_back(std::move(line));
  }
  panel.lines.push_back(std::move(isochrones));

  const auto line_of = [low](const PortraitOrbit& orbit) {
    Polyline line;
    for (Eigen::Index i = 0; i < orbit.u.size(); ++i) line.push_back({orbit.u[i], std::max(orbit.ln_k[i], low)});
    return line;
  };
  Lines orbits = orbit_lines();
  for (const PortraitOrbit& orbit : portrait.orbits) orbits.lines.push_back(line_of(orbit));
  add_scaled_copies(orbits.lines, portrait.window.u);
  add_orbits(panel, std::move(orbits), 0.13);
  if (portrait.highlight) add_highlight(panel, line_of(*portrait.highlight), caption.highlight);
  return panel;
}

}  // namespace

Figure draw(const PhasePortrait& portrait, const PortraitCaption& caption) {
  Figure figure;
  figure.title = caption.title.empty() ? fmt::format("Sliding and spinning ball,  {{/:Italic μ}} = {},  law: {}",
                                                     number(portrait.mu), literal(portrait.law))
                                       : caption.title;
  figure.subtitle = caption.subtitle.empty()
                        ? "every orbit runs from the border to the stop at the origin; both axes are invariant"
                        : caption.subtitle;
  figure.width_mm = 190;
  figure.height_mm = 125;
  figure.panels.push_back(plane_panel(portrait, caption));
  if (portrait.view == View::pair) {
    figure.width_mm = 290;
    figure.panels.front().title = "the plane of Zh98, Fig. 4";
    figure.panels.push_back(contact_panel(portrait, caption));
  }
  return figure;
}

}  // namespace contensou::portraits
