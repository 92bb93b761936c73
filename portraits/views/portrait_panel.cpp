#include "views/portrait_panel.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "contensou/portraits/layout.hpp"
#include "data/widest_gaps.hpp"

namespace contensou::portraits {

Text Drawing::speed(const Text& name) const {
  return caption.speed_unit.empty() ? name : name + ", " + caption.speed_unit;
}

Text law_legend(const PhasePortrait& portrait) { return "law " + shortened(portrait.system().law().name()); }

std::vector<double> ray_log_ratios(const PhasePortrait& portrait) {
  std::vector<double> ln_k;
  for (const reduction::InvariantRay& ray : portrait.plane.terminal.rays) ln_k.push_back(std::log(ray.k));
  return ln_k;
}

Instant at_log_ratio(const PortraitOrbit& curve, double ln_k) {
  for (Eigen::Index i = 1; i < curve.rows(); ++i) {
    const double before = curve.ln_k[i - 1], now = curve.ln_k[i];
    if ((before - ln_k) * (now - ln_k) > 0 || before == now) continue;
    const double fraction = std::isfinite(now) ? (ln_k - before) / (now - before) : 0;
    const auto mixed = [&](double a, double b) {
      return b > 0 ? std::exp((1 - fraction) * std::log(a) + fraction * std::log(b)) : a;
    };
    return {mixed(curve.u[i - 1], curve.u[i]), mixed(curve.v[i - 1], curve.v[i]),
            std::isfinite(curve.ln_v[i]) ? curve.ln_v[i - 1] + fraction * (curve.ln_v[i] - curve.ln_v[i - 1])
                                         : curve.ln_v[i - 1],
            ln_k, mixed(curve.tau_left[i - 1], curve.tau_left[i])};
  }
  return curve.at(curve.rows() - 2);
}

Instant instant_at(double mu, double u, double ln_v) {
  return {u, std::exp(ln_v), ln_v, ln_v - std::log(mu * std::abs(u)), 0};
}

Instant instant_at_logarithms(double mu, double ln_k, double ln_v) {
  return {std::exp(ln_v - ln_k) / mu, std::exp(ln_v), ln_v, ln_k, 0};
}

Polyline PanelMap::line(const PortraitOrbit& orbit) const {
  Polyline line;
  for (Eigen::Index i = 0; i < orbit.rows(); ++i) line.push_back(place(orbit.at(i), orbit.at(0)));
  return line;
}

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

void PortraitPanel::add_invariant(std::vector<Polyline> axes, const std::vector<Polyline>& pivoting,
                                  const std::function<std::vector<Polyline>(double ln_k)>& ray) {
  if (!drawing_.style.invariant) return;
  const bool driven = drawing_.portrait.system().drive() > 0;
  if (!driven) axes.insert(axes.begin(), pivoting.begin(), pivoting.end());
  const Text legend = driven ? "invariant axis " + math("u = 0") : Text("invariant axes");
  PanelLayers::add_invariant({std::move(axes), {drawing_.palette.invariant, 1.8, false}, legend});
  Lines attracting{{}, {drawing_.palette.comparison, 3, false}, "invariant ray " + math("k = k*")};
  Lines repelling{{}, {drawing_.palette.comparison, 2.2, true}, "invariant ray that orbits leave"};
  for (const reduction::InvariantRay& of : drawing_.portrait.plane.terminal.rays) {
    Lines& lines = of.attracts_above || of.attracts_below ? attracting : repelling;
    std::ranges::move(ray(std::log(of.k)), std::back_inserter(lines.lines));
  }
  PanelLayers::add_invariant(std::move(attracting));
  PanelLayers::add_invariant(std::move(repelling));
}

void PortraitPanel::add_field() {
  using Field = PortraitStyle::Field;
  if (drawing_.style.field == Field::none) return;
  const reduction::ReducedSystem& system = drawing_.portrait.system();
  const bool regularised = drawing_.style.field == Field::regularised;
  const auto drift = [&](Point at) -> std::optional<Drift> {
    const auto there = map_.state(at);
    if (!there) return std::nullopt;
    const reduction::State here{there->u, there->v};
    const reduction::Rate rate = regularised ? system.regularised_field(here) : system.field(here);
    // The step is small compared with both speeds.
    const double h = 1e-4 / std::max(std::abs(rate.u / here.u), std::abs(rate.v / here.v));
    return Drift{place(here.u, here.v), place(here.u + h * rate.u, here.v + h * rate.v),
                 std::hypot(rate.u / drawing_.portrait.window.u(), rate.v / drawing_.portrait.window.v())};
  };
  add_directions(drift, regularised ? "direction of the regularised motion (2.7)" : "direction of the motion (2.6)");
}

void PortraitPanel::add_isochrones() {
  if (drawing_.portrait.isochrones.empty()) return;
  PanelLayers::add_isochrones(panel_.x.low < 0 ? on_paper(panel_, {0, 0}).x : -1);
  for (const PhasePortrait& other : drawing_.portrait.comparisons) {
    const Text legend = time_left(drawing_.caption) + ", " + law_legend(other);
    Lines its_lines{{}, {drawing_.palette.comparison, 1.3, false, true}, legend};
    for (const Isochrone& isochrone : other.isochrones) its_lines.lines.push_back(line_of(isochrone));
    panel_.lines.insert(panel_.lines.begin(), std::move(its_lines));
  }
}

}  // namespace contensou::portraits
