// u, v and k against the fraction of the stop time that has passed. Curves depend on k at the start only.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contensou/reduction/small_mu.hpp"
#include "data/round_numbers.hpp"
#include "views/portrait_views.hpp"

namespace contensou::portraits {

namespace {

/// Returns the map from states to points: a quantity, or its ratio to the start, against the fraction of the stop time.
PanelMap over_time(double (*quantity)(const Instant& at, const Instant& start)) {
  return {[quantity](const Instant& at, const Instant& start) {
    return Point{1 - at.tau_left / start.tau_left, quantity(at, start)};
  }};
}

/// Returns ln k within limits; NaN at rest, because ln k there is only the limit of the last rows of an orbit.
double clamped_ln_k(const Instant& at, const Instant&) {
  constexpr double lowest = -60;
  return at.tau_left == 0 ? std::numeric_limits<double>::quiet_NaN() : std::clamp(at.ln_k, lowest, -lowest);
}

/// Returns the approximation for small mu at the times of a motion's rows; ln k is NaN at rest.
PortraitOrbit estimate_beside(const PhasePortrait& of, const PortraitOrbit& motion) {
  const double mu = of.system().mu();
  const reduction::SmallMuMotion solution(of.system(), {motion.u[0], motion.v[0]});
  PortraitOrbit estimate = motion;
  for (Eigen::Index row = 0; row < motion.rows(); ++row) {
    const auto [u, v, ln_v] = solution.at_time(motion.tau_left[0] - motion.tau_left[row]);
    estimate.u[row] = u;
    estimate.v[row] = v;
    estimate.ln_v[row] = ln_v;
    estimate.ln_k[row] = u == 0 ? std::numeric_limits<double>::quiet_NaN() : ln_v - std::log(mu * std::abs(u));
  }
  return estimate;
}

}  // namespace

std::vector<double> start_ratios(const PhasePortrait& portrait) {
  const reduction::ReducedSystem& system = portrait.system();
  const double same_time = 1 / (system.r() * system.law().pivoting_moment());
  const double middle = std::round(2 * std::log10(same_time));
  std::vector<double> ratios;  // 1, 3, 10, ...
  for (double half = middle - 2; half <= middle + 2; ++half) {
    ratios.push_back((std::fmod(half, 2) == 0 ? 1 : 3) * std::pow(10, std::floor(half / 2)));
  }
  return ratios;
}

void add_courses(const Drawing& drawing, const std::function<void(const PhasePortrait& of, const PortraitOrbit& orbit,
                                                                  Stroke stroke, const Text& legend)>& add) {
  const PhasePortrait& portrait = drawing.portrait;
  const std::vector<double> ratios = start_ratios(portrait);
  const auto add_all = [&](const PhasePortrait& of, bool compared) {
    const std::vector<Colour>& times = drawing.palette.times;
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      const double ln_k = std::log(ratios[i]);
      const Stroke stroke = compared ? Stroke{drawing.palette.comparison, 1.3, true}
                                     : Stroke{times[i * (times.size() - 1) / (ratios.size() - 1)], 1.8, false};
      const Text legend = compared ? law_legend(of) : math("k") + sub("0") + math(" = ") + number(std::exp(ln_k), 3);
      add(of, orbit_through(of.flow, ln_k, 0, 0), stroke, legend);
    }
  };
  add_all(portrait, false);
  for (const PhasePortrait& other : portrait.comparisons) add_all(other, true);
  if (!drawing.style.asked) return;
  for (const auto* orbits : {&portrait.through, &portrait.highlight}) {
    const bool of_start = orbits == &portrait.highlight;
    for (const PortraitOrbit& orbit : *orbits) {
      if (orbit.u[0] == 0 || orbit.v[0] == 0) continue;
      add(portrait, orbit, asked_stroke(drawing.palette, of_start),
          of_start ? drawing.caption.highlight : through_legend);
    }
  }
  for (const PortraitOrbit& orbit : portrait.uncoupled) {
    add(portrait, orbit, uncoupled_stroke(drawing.palette), uncoupled_legend);
  }
}

std::vector<MappedPanel> time_view(const Drawing& drawing) {
  const PhasePortrait& portrait = drawing.portrait;
  const std::vector<double> k_start = start_ratios(portrait);
  MappedPanel spinning{{}, over_time([](const Instant& at, const Instant& start) { return at.u / start.u; })};
  MappedPanel sliding{{}, over_time([](const Instant& at, const Instant& start) { return at.v / start.v; })};
  MappedPanel ratio{{}, over_time(clamped_ln_k)};
  Panel &u = spinning.panel, &v = sliding.panel, &k = ratio.panel;
  const Text time = math("τ/τ*");
  u.title = "spinning  " + math("u/u") + sub("0");
  v.title = "sliding  " + math("v/v") + sub("0");
  k.title = "ln " + math("k");
  for (Panel* panel : {&u, &v}) panel->y = {"", 0, 1.04, false, {}};
  for (Panel* panel : {&u, &v, &k}) panel->x = {time, 0, 1, false, {}};
  const std::vector<double> rays = ray_log_ratios(portrait);
  const double highest = std::log(k_start.back());
  k.y = {"", 0, 0, false, {}};
  if (!rays.empty()) {
    k.y.low = rays.front() - 3;
    k.y.high = rays.back() + 3;
  } else if (portrait.plane.terminal.ends.front().k == 0) {
    k.y.low = std::min(-6.0, highest - 10);
    k.y.high = highest + 1;
  } else {
    k.y.low = highest - 6;
    k.y.high = highest + 6;
  }

  const auto add = [&](const PortraitOrbit& orbit, Stroke stroke, const Text& legend) {
    for (MappedPanel* mapped : {&spinning, &sliding, &ratio}) {
      Polyline line = mapped->map.line(orbit);
      std::erase_if(line, [](Point point) { return std::isnan(point.y); });
      mapped->panel.lines.push_back({{std::move(line)}, stroke, legend});
    }
  };
  std::vector<PortraitOrbit> estimates;
  add_courses(drawing, [&](const PhasePortrait& of, const PortraitOrbit& orbit, Stroke stroke, const Text& legend) {
    add(orbit, stroke, legend);
    if (drawing.style.estimate && &of == &portrait) estimates.push_back(estimate_beside(of, orbit));
  });
  for (const PortraitOrbit& estimate : estimates) {
    add(estimate, {drawing.palette.comparison, 1.3, true}, "estimate for small " + math("μ"));
  }
  if (!rays.empty() && drawing.style.invariant) {
    Lines lines{{}, {drawing.palette.comparison, 1.6, true}, rays.size() == 1 ? math("k*") : "invariant rays"};
    for (double ln_k : rays) lines.lines.push_back({{0, ln_k}, {1, ln_k}});
    k.lines.push_back(std::move(lines));
  }
  return {std::move(spinning), std::move(sliding), std::move(ratio)};
}

}  // namespace contensou::portraits
