// The views whose axes are the two speeds: uv, patch, log, and pair (the plane and a panel of (u, ln k)).
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "contensou/reduction/detail/infinity.hpp"
#include "data/round_numbers.hpp"
#include "views/portrait_views.hpp"

namespace contensou::portraits {

namespace {

using Copies = std::vector<OrbitCopy>;

/// Returns ticks of v: round speeds in the linear part of the axis, powers of ten below this part.
/// @param real  true: speeds of a real body, so that tiny speeds have no meaning
std::vector<Axis::Tick> speed_ticks(const SpeedScale& scale, bool real) {
  std::vector<Axis::Tick> ticks{{0, "0"}};
  constexpr double lowest = 0.12;  // below this height the axis is not linear
  const double least_power = real ? -9 : -30;
  for (double h : {0.1, 0.2, 0.3, 0.4}) {
    const double decades = scale.ln_v(h) / std::log(10.0);
    const double step = std::pow(10, std::max(0.0, std::floor(std::log10(-decades)) - 1));
    const double power = step * std::round(decades / step);
    const double at = scale.height(power * std::log(10.0));
    if (power >= least_power && std::exp(power * std::log(10.0)) < 0.7 * lowest * scale.top)
      ticks.push_back({at, "10" + sup(fmt::format("{}", power))});
  }
  for (double v : multiples(lowest * scale.top, scale.top * (1 + 1e-9), round_step(scale.top, 6))) {
    ticks.push_back({scale.height(std::log(v)), number(v, 3)});
  }
  return ticks;
}

/// Names the slip below which a bent axis shows a power of v, and marks where each requested motion slides at 1 mm/s.
void add_slips(PortraitPanel& layers, const Drawing& drawing, double unit) {
  const SpeedScale& scale = drawing.portrait.scale;
  Panel& panel = layers.panel();
  constexpr double bend = 0.5, below = 0.035, beside = 0.015, mm = 1e-3;
  const Point corner = from_paper(panel, {beside, 0});
  panel.labels.push_back({{corner.x, scale.height(scale.ln_v(bend)) - below},
                          Text("slip below ") + number(std::exp(scale.ln_v(bend)) / mm, 2) + " mm/s",
                          drawing.palette.invariant,
                          Label::Align::left});
  for (const PortraitOrbit& orbit : drawing.portrait.highlight) {
    const auto row = std::ranges::find_if(orbit.ln_v, [](double ln_v) { return ln_v <= std::log(mm); });
    if (row == orbit.ln_v.begin() || row == orbit.ln_v.end()) continue;
    const double time = (orbit.tau_left[0] - orbit.tau_left[row - orbit.ln_v.begin()]) / drawing.caption.time_unit;
    const Point at{unit * orbit.u[row - orbit.ln_v.begin()], scale.height(std::log(mm))};
    panel.marks.push_back({{at}, drawing.palette.highlight, 1, Marks::Shape::circle});
    panel.labels.push_back({from_paper(panel, between(on_paper(panel, at), {0.5, on_paper(panel, at).y}, 0.04)),
                            Text("1 mm/s after ") + number(time, 3) + " s", drawing.palette.highlight,
                            at.x > 0 ? Label::Align::right : Label::Align::left});
  }
}

/// Returns a half-plane panel. Its sides are the sides of the window, in units of u and v.
MappedPanel half_plane(const Drawing& drawing, double unit, const Text& name) {
  Panel panel;
  const Window& window = drawing.portrait.window;
  const auto& [low, high] = window;
  const SpeedScale scale = drawing.portrait.scale;
  const double x = unit * window.u(), top = scale.linear() ? high[1] : 1;
  const double bottom = scale.linear() ? low[1] : scale.height(std::log(low[1]));
  panel.x = {drawing.speed(name), unit * low[0], unit * high[0], false, {}};
  panel.y = {drawing.speed(math("v")), bottom, top, false, {}};
  if (!scale.linear()) {
    const Text exponent = math("s = ") + number(scale.exponent, 3), power = math("v") + sup(math("s"));
    // A panel beside others is small, and has a title.
    const bool beside_others = !drawing.caption.panel.empty();
    panel.y.name += "  (shaded: " + power + (beside_others ? ")" : ", " + exponent + ")");
    if (beside_others) panel.title = exponent;
    panel.y.ticks = speed_ticks(scale, !drawing.caption.speed_unit.empty());
    std::erase_if(panel.y.ticks, [&](const Axis::Tick& tick) { return tick.at < bottom; });
    const auto [left, right] = std::pair(panel.x.low, panel.x.high);
    constexpr double bend = 0.5;
    if (bottom < bend)
      panel.regions.push_back({{{left, bottom}, {right, bottom}, {right, bend}, {left, bend}}, drawing.palette.region});
  }
  const PanelMap map{.place =
                         [unit, scale](const Instant& at, const Instant&) {
                           return Point{unit * at.u, scale.linear() ? at.v : scale.height(at.ln_v)};
                         },
                     .state = [unit, scale, mu = drawing.portrait.system().mu()](Point at) -> std::optional<Instant> {
                       if (at.y < 0 || (at.x == 0 && at.y == 0)) return std::nullopt;
                       return instant_at(mu, at.x / unit, scale.linear() ? std::log(at.y) : scale.ln_v(at.y));
                     }};
  PortraitPanel layers(drawing, std::move(panel), map);
  layers.add_orbits();
  layers.add_isochrones();
  layers.add_field();
  layers.add_invariant({{{0, top}, {0, 0}}}, {{{-x, 0}, {0, 0}}, {{x, 0}, {0, 0}}}, [&](double ln_k) {
    const double slope = std::exp(ln_k) * drawing.portrait.system().mu() / unit;  // v divided by x
    return std::vector<Polyline>{{{x, slope * x}, {0, 0}}, {{-x, slope * x}, {0, 0}}};
  });
  layers.add_highlights();
  if (!scale.linear() && bottom == 0 && drawing.caption.panel.empty() && drawing.caption.speed_unit == "m/s")
    add_slips(layers, drawing, unit);
  if (window.contains({0, 0}))
    layers.panel().marks.push_back({{{0, 0}}, drawing.palette.invariant, 1.2, Marks::Shape::dot, "the stop"});
  return std::move(layers).finished();
}

/// Adds copies of a curve. At the given ln k the copies have evenly spaced values of u, of both signs.
void add_evenly(Copies& copies, const PortraitOrbit& curve, double ln_k, double max_u, int count) {
  const double u = at_log_ratio(curve, ln_k).u;
  for (int i = 0; i < count; ++i) {
    for (double sign : {1.0, -1.0}) copies.push_back({curve, (i + 0.5) / count * max_u / u, sign});
  }
}

}  // namespace

MappedPanel contact_panel(const Drawing& drawing, bool right_half) {
  using reduction::InvariantDirection;
  const PhasePortrait& portrait = drawing.portrait;
  const double U = portrait.window.u();
  const auto& [direction, k_star, order] = portrait.plane.tangents.front();
  const std::vector<double> rays = ray_log_ratios(portrait);
  constexpr double shrinks = 20;  // u falls by at least this factor within the panel
  const int per_side = drawing.crowd(12);
  constexpr double reach = 3;
  Panel panel;
  panel.x = {drawing.speed(math("u = R ω") + sub(math("z"))), right_half ? 0 : -U, U, false, {}};
  panel.y = {"ln " + math("k") + ",   " + math("k = v/(μ|u|)"), 0, 0, false, {}};
  const bool pivoting = rays.empty() && direction == InvariantDirection::pivoting;
  // Orbits start at the top if they touch v = 0 at the origin, else around the middle.
  const double top = std::log(portrait.window.v() / (portrait.system().mu() * U));
  const double lowest = rays.empty() ? 2 : rays.front(), highest = rays.empty() ? 2 : rays.back();
  if (pivoting) {
    const double depth = std::max(order * std::log(shrinks), 8.0);
    panel.title = "orbits touch the axis " + math("v = 0") + ":  " + math("k ∝ |u|") + sup(math("n")) + ",  " +
                  math("n = ") + number(order, 4);
    panel.y.low = top - depth;
    panel.y.high = top + 0.02 * depth;
  } else {
    panel.title = rays.empty()                          ? "orbits touch the axis " + math("u = 0")
                  : portrait.plane.tangents.size() == 1 ? "orbits touch the ray " + math("k = k*")
                                                        : "orbits touch one of several lines";
    panel.y.low = lowest - reach;
    panel.y.high = highest + reach;
  }
  const auto copies = [=](const PortraitOrbit& curve) {
    Copies result;
    if (!pivoting) {
      add_evenly(result, curve, lowest - reach, U, per_side);
      add_evenly(result, curve, lowest - 0.3 * reach, 3 * U, per_side);
      return result;
    }
    add_evenly(result, curve, top, U, per_side);
    // Add orbits that enter from the sides, evenly down to the bottom.
    const double u = at_log_ratio(curve, top).u;
    for (int i = 1; i <= per_side; ++i) {
      const double factor = std::pow(shrinks, static_cast<double>(i) / (per_side + 0.5));
      for (double sign : {1.0, -1.0}) result.push_back({curve, factor * U / u, sign});
    }
    return result;
  };
  const double low = panel.y.low - 2 * (panel.y.high - panel.y.low);  // place of ln k = -infinity, below the border
  const PanelMap map{.place =
                         [low](const Instant& at, const Instant&) {
                           return Point{at.u, std::clamp(at.ln_k, low, 1e300)};
                         },
                     .state = [mu = portrait.system().mu()](Point at) -> std::optional<Instant> {
                       if (at.x == 0) return std::nullopt;
                       return instant_at(mu, at.x, at.y + std::log(mu * std::abs(at.x)));
                     }};
  PortraitPanel layers(drawing, std::move(panel), map);
  layers.set_arrows(0.3, 2.5);
  layers.add_copies(copies, !right_half);
  layers.add_highlights();
  layers.add_invariant({}, {}, [U](double ln_k) {
    return std::vector<Polyline>{{{-U, ln_k}, {0, ln_k}}, {{U, ln_k}, {0, ln_k}}};
  });
  return std::move(layers).finished();
}

std::vector<MappedPanel> plane_view(const Drawing& drawing) {
  return {half_plane(drawing, 1, math("u = R ω") + sub(math("z")))};
}

std::vector<MappedPanel> patch_view(const Drawing& drawing) {
  return {half_plane(drawing, drawing.portrait.system().mu(), math("μ u") + ",  rim speed of the patch")};
}

std::vector<MappedPanel> pair_view(const Drawing& drawing) {
  std::vector<MappedPanel> panels{half_plane(drawing, 1, math("u = R ω") + sub(math("z"))),
                                  contact_panel(drawing, false)};
  const reduction::ReducedSystem& system = drawing.portrait.system();
  const auto [chi, gamma] = system.inertia();
  const bool of_paper = system.drive() == 0 && chi == reduction::homogeneous_ball.chi &&
                        gamma == reduction::homogeneous_ball.gamma && system.law().name() == "pade";
  panels.front().panel.title = !drawing.portrait.scale.linear() ? "the plane, " + math("v") + " on a bent scale"
                               : of_paper                       ? "the plane, as in Zhuravlev 1998, Fig. 4"
                                                                : "the plane";
  return panels;
}

std::vector<MappedPanel> log_view(const Drawing& drawing) {
  using reduction::InvariantDirection;
  const PhasePortrait& portrait = drawing.portrait;
  const double mu = portrait.system().mu(), V = portrait.window.v();
  const auto log_u = [=](double u) { return std::log(mu * std::abs(u) / V); };
  const bool spins_last = portrait.plane.tangents.front().direction != InvariantDirection::sliding;
  const std::vector<double> rays = ray_log_ratios(portrait);
  // The panel surrounds the requested orbits, their beginnings and their crossings of k = 1, with a margin of some
  // powers of e. The margin is larger towards small values of the speed that vanishes first. Scaling is a shift along
  // the diagonal, so both axes have the same unit.
  Panel panel;
  panel.to_scale = true;
  std::vector<double> xs, ys;
  const auto add = [&](const Instant& at) {
    if (!std::isfinite(at.ln_k)) return;
    xs.push_back(log_u(at.u));
    ys.push_back(at.ln_v - std::log(V));
  };
  const auto add_orbit = [&](const PortraitOrbit& curve) {
    add(curve.at(0));
    if (rays.empty() && (curve.ln_k[0] > 0) == spins_last) add(at_log_ratio(curve, 0));
  };
  for (const auto* orbits : {&portrait.highlight, &portrait.through}) std::ranges::for_each(*orbits, add_orbit);
  if (xs.empty()) add(instant_at_logarithms(mu, 0, std::log(V)));
  const auto [left, right] = std::ranges::minmax(xs);
  const auto [bottom, top] = std::ranges::minmax(ys);
  constexpr double deep = 8, near = 2, rim = 1, broad = 1.3;
  panel.x.high = right + (spins_last ? rim : near);
  panel.x.low = left - (spins_last && rays.empty() ? near : deep);
  panel.y.high = top + (spins_last ? near : rim);
  panel.y.low = bottom - (spins_last || !rays.empty() ? deep : near);
  // The panel has the shape of the page, but it does not extend to the left of the beginnings of copies.
  const double height = panel.y.high - panel.y.low, width = panel.x.high - panel.x.low;
  panel.x.low = std::min(panel.x.low, std::max(panel.x.high - broad * height, panel.y.high - upstream_of_copies));
  panel.y.low = std::min(panel.y.low, panel.y.high - width / broad);
  panel.x.name = "ln(" + math("μ|u|/V") + "),  " + math("V = ") + number(V, 4) + " " + drawing.caption.speed_unit;
  panel.y.name = "ln(" + math("v/V") + ")";
  constexpr double steep = 1 / 12.0;
  const double power = 1 / (1 + portrait.plane.tangents.front().contact_order);
  if (spins_last && rays.empty() && power < steep) {
    panel.title = (drawing.caption.panel.empty() ? "orbits are nearly vertical: at the stop " : "") + math("u ∝ v") +
                  sup(math("s")) + ",  " + math("s = ") + number(power, 3);
  }
  // A value of -infinity becomes a point far beyond the borders.
  const Point nowhere{11 * panel.x.low - 10 * panel.x.high, 11 * panel.y.low - 10 * panel.y.high};
  const PanelMap map{
      .place =
          [=](const Instant& at, const Instant&) {
            return Point{at.u == 0 ? nowhere.x : log_u(at.u), std::max(at.ln_v - std::log(V), nowhere.y)};
          },
      .state = [=](Point at) -> std::optional<Instant> {
        return instant_at_logarithms(mu, at.y - at.x, at.y + std::log(V));
      }};
  PortraitPanel layers(drawing, panel, map);
  const auto copies = [&](const PortraitOrbit& curve) {
    // Add copies, shifted along the diagonal, evenly across the panel.
    const int count = drawing.crowd(14);
    const double w = log_u(at_log_ratio(curve, 0).u);
    const double first = panel.x.low - (spins_last ? 0 : near);
    const double last = panel.x.high + (spins_last && rays.empty() ? rim : deep);
    Copies result;
    for (int i = 0; i < count; ++i) {
      result.push_back({curve, std::exp(first + (i + 0.5) * (last - first) / count - w)});
    }
    return result;
  };
  layers.add_copies(copies, false);
  const double low = std::min(panel.x.low, panel.y.low), high = std::max(panel.x.high, panel.y.high);
  layers.panel().lines.push_back({{{{low, low}, {high, high}}}, {drawing.palette.isochrone, 1.1, true}, math("k = 1")});
  layers.add_invariant({}, {}, [&](double ln_k) {
    return std::vector<Polyline>{{{panel.y.high - ln_k, panel.y.high}, {panel.y.low - ln_k, panel.y.low}}};
  });
  layers.add_highlights();
  return {std::move(layers).finished()};
}

}  // namespace contensou::portraits
