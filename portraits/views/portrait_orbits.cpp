// Layers of a portrait's panel: orbits, in bands of time or in one colour, with their arrows.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <utility>

#include "contensou/portraits/layout.hpp"
#include "views/portrait_panel.hpp"

namespace contensou::portraits {

void PortraitPanel::add_orbits() {
  add_layers([](const PhasePortrait& of) {
    std::vector<Copy> copies;
    for (const PortraitOrbit& orbit : of.orbits) copies.push_back({orbit});
    return copies;
  });
}

void PortraitPanel::add_copies(const std::function<std::vector<Copy>(const PortraitOrbit& curve)>& copies,
                               bool mirrored) {
  const bool has_rays = !drawing_.portrait.plane.terminal.rays.empty();
  add_layers([&](const PhasePortrait& of) {
    if (has_rays || !of.plane.terminal.rays.empty()) return filling(of.flow, mirrored);
    // From so steep that it passes the whole window.
    const double steepest = std::log(of.window.v / (of.system().mu() * of.window.u)) + 7;
    return copies(traced_.emplace_back(orbit_through(of.flow, 0, 0, std::max(upstream_of_copies, steepest))));
  });
}

std::vector<PortraitPanel::Copy> PortraitPanel::filling(const reduction::Flow& flow, bool mirrored) {
  constexpr double gap_mm = 4, first = 1e3;
  constexpr std::size_t max_count = 60;
  struct Seed {
    Point at;  ///< on paper
    Instant state;
    const reduction::SimilarityCurve* sector;  ///< between two invariant half-lines, which no orbit crosses
    double border = first;                     ///< mm to another sector, twice
    double gap = first;                        ///< mm to the nearest line of its sector, or to the border
  };
  const auto distance = [mm = drawing_.panel_mm](Point a, Point b) {
    return std::hypot((a.x - b.x) * mm.x, (a.y - b.y) * mm.y);
  };
  std::vector<Seed> seeds;
  constexpr int columns = 48, rows = 32;
  for (int i = mirrored ? columns / 2 : 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      const Point at{(i + 0.5) / columns, (j + 0.5) / rows};
      if (const auto there = map_.state(from_paper(panel_, at))) {
        seeds.push_back({at, *there, flow.solution().through(there->ln_k).get()});
      }
    }
  }
  for (Seed& seed : seeds) {
    for (const Seed& other : seeds) {
      if (other.sector != seed.sector) seed.border = std::min(seed.border, 2 * distance(seed.at, other.at));
    }
    seed.gap += seed.border;  // a sector has one orbit at least, in its middle
  }
  std::vector<Copy> copies;
  while (!seeds.empty() && copies.size() < max_count) {
    const Seed widest = *std::ranges::max_element(seeds, {}, &Seed::gap);
    if (widest.gap < gap_mm) break;
    constexpr double upstream = 12;
    copies.push_back({traced_.emplace_back(orbit_through(flow, widest.state.ln_k, widest.state.ln_v, upstream))});
    for (const Polyline& part : clipped(panel_, line_of(copies.back()))) {
      for (const Point& at : on_paper_along(part, 0.01)) {
        for (Seed& seed : seeds) {
          if (seed.sector == widest.sector) seed.gap = std::min({seed.gap, seed.border, distance(seed.at, at)});
        }
      }
    }
    std::erase_if(seeds, [&](const Seed& seed) { return seed.gap < gap_mm; });
    if (mirrored) copies.push_back({traced_.back(), 1, -1});
  }
  return copies;
}

void PortraitPanel::add_layers(const std::function<std::vector<Copy>(const PhasePortrait&)>& copies) {
  const PhasePortrait& portrait = drawing_.portrait;
  if (drawing_.coloured()) {
    add_coloured(copies(portrait));
  } else {
    add_plain(copies(portrait), {drawing_.palette.orbit, 1.3, false},
              portrait.comparisons.empty() ? "orbits" : law_legend(portrait));
  }
  for (const PhasePortrait& other : portrait.comparisons) {
    add_plain(copies(other), {drawing_.palette.comparison, 1.3, true}, law_legend(other));
  }
}

void PortraitPanel::add_coloured(const std::vector<Copy>& copies) {
  // A piece of line for each band that an orbit crosses; one layer for each band, the last moments on top.
  const TimeBands& bands = drawing_.bands;
  std::map<std::size_t, std::vector<Polyline>, std::greater<>> layers;
  std::map<std::size_t, Arrows, std::greater<>> heads;
  for (const Copy& copy : copies) {
    const Polyline line = line_of(copy);
    orbits_.push_back(line);
    for (const auto& [arrow, left] : arrows_on(copy, line)) heads[bands.band(left)].arrows.push_back(arrow);
    Polyline piece{line.front()};
    std::size_t band = bands.band(copy.factor * copy.orbit.tau_left[0]);
    for (Eigen::Index i = 1; i < copy.orbit.rows(); ++i) {
      const double before = copy.factor * copy.orbit.tau_left[i - 1], now = copy.factor * copy.orbit.tau_left[i];
      const Point from = line[static_cast<std::size_t>(i) - 1], to = line[static_cast<std::size_t>(i)];
      for (; band > 0 && now < bands.begin(band); --band) {
        const Point cut = between(from, to, (before - bands.begin(band)) / (before - now));
        piece.push_back(cut);
        layers[band].push_back(std::exchange(piece, {cut}));
      }
      piece.push_back(to);
    }
    layers[band].push_back(std::move(piece));
  }
  for (auto& [band, lines] : layers) panel_.lines.push_back({std::move(lines), {bands.colours[band], 1.5, false}, ""});
  for (auto& [band, arrows] : heads) panel_.arrows.push_back({std::move(arrows.arrows), bands.colours[band]});
}

void PortraitPanel::add_plain(const std::vector<Copy>& copies, Stroke stroke, const Text& legend) {
  Lines lines{{}, stroke, legend};
  Arrows arrows{{}, stroke.colour};
  for (const Copy& copy : copies) {
    lines.lines.push_back(line_of(copy));
    orbits_.push_back(lines.lines.back());
    if (stroke.dashed) continue;
    for (const TimedArrow& timed : arrows_on(copy, lines.lines.back())) arrows.arrows.push_back(timed.arrow);
  }
  panel_.lines.push_back(std::move(lines));
  panel_.arrows.push_back(std::move(arrows));
}

/// Heads where equal times are left, halfway between isochrones; at least one on an orbit, where it is seen best.
std::vector<PortraitPanel::TimedArrow> PortraitPanel::arrows_on(const Copy& copy, const Polyline& line) {
  using Style = PortraitStyle::Arrows;
  std::vector<TimedArrow> result;
  if (drawing_.style.arrows == Style::none) return result;
  const auto has_room = [&](const Arrow& arrow) {
    const Point at = on_paper(panel_, arrow.at);
    if (!std::isfinite(at.x) || !std::isfinite(at.y) || !inside(at, 0.03)) return false;
    const auto crowds = [&](Point other) {
      return std::hypot((other.x - at.x) * drawing_.panel_mm.x, (other.y - at.y) * drawing_.panel_mm.y) <
             keep_off_ * drawing_.letter;
    };
    if (std::ranges::any_of(heads_, crowds)) return false;
    heads_.push_back(at);
    return true;
  };
  // With the time of the nearest row.
  const auto add_there = [&](const Arrow& arrow) {
    if (!has_room(arrow)) return;
    const auto nearest =
        std::ranges::min_element(line, {}, [&](Point point) { return paper_distance(panel_, point, arrow.at); });
    result.push_back({arrow, copy.factor * copy.orbit.tau_left[nearest - line.begin()]});
  };
  if (drawing_.style.arrows == Style::time) {
    // In the order of the motion, along which the time left falls.
    const double *first = copy.orbit.tau_left.data(), *last = first + copy.orbit.rows();
    const auto is_before = [&](double left, double time) { return copy.factor * left > time; };
    for (auto time = drawing_.bands.arrows.rbegin(); time != drawing_.bands.arrows.rend(); ++time) {
      const double* row = std::lower_bound(first, last, *time, is_before);
      if (row == first || row == last) continue;
      const double before = copy.factor * row[-1], now = copy.factor * *row;
      const Point from = line[static_cast<std::size_t>(row - first) - 1],
                  to = line[static_cast<std::size_t>(row - first)];
      const Arrow arrow{between(from, to, (before - *time) / (before - now)), {to.x - from.x, to.y - from.y}};
      if (has_room(arrow)) result.push_back({arrow, *time});
    }
  }
  const std::vector<Polyline> parts = clipped(panel_, line);
  if (parts.empty()) return result;
  if (!drawing_.portrait.scale.linear() && drawing_.style.arrows == Style::time) {
    // Where it slides hardly any time passes: one there, too.
    const Arrow arrow = arrow_along(panel_, parts.front(), 0.2);
    if (on_paper(panel_, arrow.at).y > 0.6) add_there(arrow);
  }
  if (!result.empty()) return result;
  for (double fraction : {arrow_fraction_, arrow_fraction_ + 0.1, arrow_fraction_ - 0.1}) {
    add_there(arrow_along(panel_, parts.front(), fraction));
    if (!result.empty()) break;
  }
  return result;
}

}  // namespace contensou::portraits
