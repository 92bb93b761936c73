// Canonical coordinates: q or ln k, and p = ln v. (u, v) -> (c u, c v) shifts only p, so orbits are translates along p.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "views/portrait_views.hpp"

namespace contensou::portraits {

namespace {

constexpr double half_height = 5;  // half height of the panels, in p
constexpr double step = 0.8;       // distance of translates in p; larger if p changes at nearly constant k
constexpr int max_count = 24;      // largest number of translates of a curve

/// Draws one panel: translates of each curve, with the arrow of the symmetry.
MappedPanel translates(const Drawing& drawing, Panel axes, const std::function<double(double ln_k)>& abscissa,
                       const std::function<double(double x)>& ln_k_at) {
  const double middle = std::log(drawing.portrait.window.v());
  axes.y = {math("p") + " = ln " + math("v"), middle - half_height, middle + half_height, false, {}};
  const double below = middle - 100 * half_height;
  const PanelMap map{.place =
                         [abscissa, below](const Instant& at, const Instant&) {
                           return Point{abscissa(at.ln_k), std::max(at.ln_v, below)};
                         },
                     .state = [ln_k_at, mu = drawing.portrait.system().mu()](Point at) -> std::optional<Instant> {
                       const double ln_k = ln_k_at(at.x);
                       return std::isfinite(ln_k) ? std::optional(instant_at_logarithms(mu, ln_k, at.y)) : std::nullopt;
                     }};
  PortraitPanel layers(drawing, std::move(axes), map);
  const auto copies = [&](const PortraitOrbit& curve) {
    const Instant at = at_log_ratio(curve, 0);
    // The first translate touches the lower border, the last one the upper border. Rows next to an axis do not count,
    // because no number of translates would reach them.
    const Axis& x = layers.panel().x;
    const double margin = 0.02 * (x.high - x.low);
    double rise = 0, fall = 0;
    for (Eigen::Index i = 0; i < curve.rows(); ++i) {
      const double there = abscissa(curve.ln_k[i]);
      if (there < x.low + margin || there > x.high - margin) continue;
      rise = std::max(rise, curve.ln_v[i] - at.ln_v);
      fall = std::max(fall, at.ln_v - curve.ln_v[i]);
    }
    const double apart = std::max(step, (2 * half_height + rise + fall) / drawing.crowd(max_count));
    const int first = -static_cast<int>(std::ceil((half_height + rise) / apart));
    const int last = static_cast<int>(std::ceil((half_height + fall) / apart));
    std::vector<OrbitCopy> result;
    for (int i = first; i <= last; ++i) result.push_back({curve, std::exp(middle + i * apart - at.ln_v)});
    return result;
  };
  layers.add_copies(copies, false);
  const Axis& y = layers.panel().y;
  layers.add_invariant({}, {}, [&](double ln_k) {
    const double x = abscissa(ln_k);
    return std::vector<Polyline>{{{x, y.high}, {x, y.low}}};
  });
  layers.add_highlights();
  // Draw the action of the symmetry: it moves an orbit to a copy.
  MappedPanel finished = std::move(layers).finished();
  Panel& panel = finished.panel;
  const double x = panel.x.low + 0.82 * (panel.x.high - panel.x.low);
  std::vector<double> orbits;  // their p at this x
  for (const Lines& lines : panel.lines) {
    for (const Polyline& line : lines.lines) {
      for (std::size_t i = 1; i < line.size(); ++i) {
        const Point a = line[i - 1], b = line[i];
        if ((a.x - x) * (b.x - x) < 0) orbits.push_back(a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y));
      }
    }
  }
  const auto nearest = [&](double p) {
    const auto found = std::ranges::min_element(orbits, {}, [&](double orbit) { return std::abs(orbit - p); });
    return found == orbits.end() ? p : *found;
  };
  const double low = nearest(middle - 0.76 * half_height), high = nearest(low + 2 * step);
  panel.lines.push_back({{{{x, low}, {x, high}}},
                         {drawing.palette.highlight, 2, false},
                         "symmetry " + math("p → p") + " + ln " + math("c")});
  panel.arrows.push_back({{{{x, high}, {0, 1}}}, drawing.palette.highlight});
  return finished;
}

}  // namespace

std::vector<MappedPanel> similarity_view(const Drawing& drawing) {
  const PhasePortrait& portrait = drawing.portrait;
  const double mu = portrait.system().mu();
  const std::vector<double> rays = ray_log_ratios(portrait);
  const auto [low, high] = rays.empty() ? std::pair{0.0, 0.0} : std::pair{rays.front(), rays.back()};
  // A requested motion begins inside the panel.
  const double start =
      !portrait.highlight.empty() && portrait.highlight[0].u[0] != 0 ? portrait.highlight[0].ln_k[0] : 0;
  Panel by_q, by_ratio;
  by_q.title = math("q = v/u") + ": the symmetry changes " + math("p") + " alone";
  by_q.x = {math("q = μk"), 0, mu * std::max(rays.empty() ? 4 : 3 * std::exp(high), 1.2 * std::exp(start)), false, {}};
  by_ratio.title = "the same against ln " + math("k");
  by_ratio.x = {"ln " + math("k"), low - 4, std::max(high + 4, start + 1), false, {}};
  std::vector<MappedPanel> panels;
  panels.push_back(translates(
      drawing, std::move(by_q), [mu](double ln_k) { return mu * std::exp(std::min(ln_k, 50.0)); },
      [mu](double q) { return std::log(q / mu); }));
  panels.push_back(translates(
      drawing, std::move(by_ratio), [](double ln_k) { return std::max(ln_k, -1e3); }, [](double x) { return x; }));
  return panels;
}

}  // namespace contensou::portraits
