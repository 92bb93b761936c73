// The choice of the orbits that fill a portrait's panel.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <utility>

#include "contensou/portraits/layout.hpp"
#include "data/widest_gaps.hpp"
#include "views/portrait_panel.hpp"

namespace contensou::portraits {

void PortraitPanel::add_orbits() {
  add_layers([this](const PhasePortrait& of) { return lines_of(of.orbits); });
}

void PortraitPanel::add_copies(const std::function<std::vector<OrbitCopy>(const PortraitOrbit& curve)>& copies,
                               bool mirrored) {
  const bool has_rays = !drawing_.portrait.plane.terminal.rays.empty();
  add_layers([&](const PhasePortrait& of) {
    if (has_rays || !of.plane.terminal.rays.empty()) return lines_of(filling(of.flow, mirrored));
    // The curve begins at so large a k that it passes the whole window.
    const double steepest = std::log(of.window.v() / (of.system().mu() * of.window.u())) + 7;
    return lines_of(copies(traced_.emplace_back(orbit_through(of.flow, 0, 0, std::max(upstream_of_copies, steepest)))));
  });
}

std::vector<OrbitCopy> PortraitPanel::filling(const reduction::Flow& flow, bool mirrored) {
  constexpr double gap_mm = 4;
  constexpr std::size_t max_count = 60;
  using Gaps = WidestGaps<const reduction::SimilarityCurve*, Instant>;
  const auto seed_at = [&](Point at) -> std::optional<Gaps::Seed> {
    const auto there = mirrored && at.x < 0.5 ? std::nullopt : map_.state(from_paper(panel_, at));
    if (!there) return std::nullopt;
    return Gaps::Seed{at, *there, flow.solution().through(there->ln_k).get()};
  };
  Gaps gaps(48, 32, seed_at, {drawing_.panel_mm.x, drawing_.panel_mm.y});
  std::vector<OrbitCopy> copies;
  while (!gaps.empty() && copies.size() < max_count) {
    const Gaps::Seed widest = gaps.widest();
    if (widest.gap < gap_mm) break;
    constexpr double upstream = 12;
    copies.push_back({traced_.emplace_back(orbit_through(flow, widest.state.ln_k, widest.state.ln_v, upstream))});
    for (const Polyline& part : clipped(panel_, line_of(copies.back()).line)) {
      for (const Point& at : on_paper_along(part, 0.01)) gaps.pass(widest.sector, at);
    }
    gaps.drop_below(gap_mm);
    if (mirrored) copies.push_back({traced_.back(), 1, -1});
  }
  return copies;
}

void PortraitPanel::add_layers(const std::function<std::vector<TimedLine>(const PhasePortrait&)>& lines) {
  const PhasePortrait& portrait = drawing_.portrait;
  const Text legend = portrait.comparisons.empty() ? "orbits" : law_legend(portrait);
  PanelLayers::add_orbits(lines(portrait), drawing_.coloured(), legend);
  for (const PhasePortrait& other : portrait.comparisons) {
    add_plain(lines(other), {drawing_.palette.comparison, 1.3, true}, law_legend(other));
  }
}

}  // namespace contensou::portraits
