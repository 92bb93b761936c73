// u, v and the time against the regularised time beta of (2.7) and (2.8), in which the stop is infinitely far.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "contensou/reduction/infinity.hpp"
#include "views/portrait_views.hpp"

namespace contensou::portraits {

namespace {

using std::numbers::pi;

/// dln v/dbeta on the axis u = 0 and dln u/dbeta on v = 0, added: 1/beta_1.
double rate_at(const reduction::ReducedSystem& system, double w, double v) {
  const double chi = system.inertia().chi;
  return 30 * pi * chi * v + 256 / (3 * pi) * chi * system.r() * system.law().pivoting_moment() * w;
}

/// 1 + beta/beta_1: on the axis v = 0, u is u0 over this, and on u = 0, v is v0 over this.
double regularised_time(const reduction::Flow& flow, const Instant& at, const Instant& start) {
  if (at.tau_left == 0) return infinity;
  const double mu = flow.system().mu();
  const auto b_over_speed = [&](const Instant& it) {
    const auto& curve = *flow.solution().through(it.ln_k);
    return curve.beta_coefficient(curve.chart().coordinate(it.ln_k)) / (mu * std::abs(it.u) + it.v);
  };
  // (R7)
  const double beta = 3 * pi / (2 * flow.system().inertia().chi) * (b_over_speed(at) - b_over_speed(start));
  return 1 + rate_at(flow.system(), mu * std::abs(start.u), start.v) * std::max(0.0, beta);
}

using Quantity = double (*)(const Instant& at, const Instant& start);

PanelMap map_of(const reduction::Flow& flow, Quantity quantity) {
  return {[flow, quantity](const Instant& at, const Instant& start) {
    return Point{regularised_time(flow, at, start), quantity(at, start)};
  }};
}

double spin_left(const Instant& at, const Instant& start) { return at.u / start.u; }
double log_slip_left(const Instant& at, const Instant& start) { return at.ln_v - start.ln_v; }
double time_passed(const Instant& at, const Instant& start) { return 1 - at.tau_left / start.tau_left; }

/// The line up to one point beyond a border.
Polyline up_to(double border, Polyline line) {
  const auto beyond = std::ranges::find_if(line, [&](const Point& point) { return !(point.x < border); });
  if (beyond != line.end()) line.erase(std::isfinite(beyond->x) ? beyond + 1 : beyond, line.end());
  return line;
}

/// y at a border, by the last two points.
double at_border(double border, const Polyline& line, bool logarithmic) {
  const Point &a = line[line.size() - 2], &b = line.back();
  const double share = std::log(border / a.x) / std::log(b.x / a.x);
  return logarithmic ? a.y * std::pow(b.y / a.y, share) : a.y + share * (b.y - a.y);
}

}  // namespace

std::vector<MappedPanel> regularised_view(const Drawing& drawing) {
  const PhasePortrait& portrait = drawing.portrait;
  // Far beyond where both speeds, of which one is at first by far the smaller, have begun to fall like powers.
  const reduction::ReducedSystem& system = portrait.system();
  const std::vector<double> ratios = start_ratios(portrait);
  const double slow = std::max(rate_at(system, 1, ratios.back()) / rate_at(system, 1, 0),
                               rate_at(system, 1, ratios.front()) / rate_at(system, 0, ratios.front()));
  const double border = std::pow(10, std::ceil(3 + std::log10(slow)));
  constexpr std::array<Quantity, 3> quantities{spin_left, log_slip_left, time_passed};
  std::vector<MappedPanel> panels(quantities.size());
  panels[0].panel.title = "spinning  " + math("u/u") + sub("0");
  panels[0].panel.y = {"", 1e-2, 2, true, {}};
  panels[1].panel.title = "sliding  ln(" + math("v/v") + sub("0") + ")";
  panels[1].panel.y = {"", -1, 0, false, {}};
  panels[2].panel.title = "time  " + math("τ/τ*");
  panels[2].panel.y = {"", 0, 1.08, false, {}};
  for (std::size_t i = 0; i < panels.size(); ++i) {
    panels[i].panel.x = {"1 + " + math("β/β") + sub("1"), 1, border, true, {}};
    panels[i].map = map_of(portrait.flow, quantities[i]);
  }

  // Towards the stop u and v are powers of beta; of the two, the one that outlives the other goes like 1/beta.
  Lines powers_of_u{{}, {drawing.palette.comparison, 1, true}, "asymptotes"}, powers_of_v = powers_of_u;
  add_courses(drawing, [&](const PhasePortrait& of, const PortraitOrbit& orbit, Stroke stroke, const Text& legend) {
    const auto& terminal = of.plane.terminal;
    const double end = terminal.end_of(std::exp(orbit.ln_k[0])).k, r = of.system().r();
    std::vector<Polyline> lines;
    for (std::size_t i = 0; i < panels.size(); ++i) {
      lines.push_back(up_to(border, map_of(of.flow, quantities[i]).line(orbit)));
      panels[i].panel.lines.push_back({{lines.back()}, stroke, legend});
    }
    if (lines[0].size() < 2 || lines[0].back().x < border) return;
    const double u = at_border(border, lines[0], true), v = at_border(border, lines[1], false);
    const double power_of_u = std::isinf(end) ? r / terminal.high : 1, power_of_v = end == 0 ? terminal.low / r : 1;
    powers_of_u.lines.push_back({{1, u * std::pow(border, power_of_u)}, {border, u}});
    powers_of_v.lines.push_back({{1, v + power_of_v * std::log(border)}, {border, v}});
    panels[0].panel.y.low = std::min(panels[0].panel.y.low, u);
    panels[1].panel.y.low = std::min(panels[1].panel.y.low, 1.02 * v);
  });
  panels[0].panel.lines.push_back(std::move(powers_of_u));
  panels[1].panel.lines.push_back(std::move(powers_of_v));
  panels[2].panel.lines.push_back({{{{1, 1}, {border, 1}}}, {drawing.palette.comparison, 1, true}, "asymptotes"});
  return panels;
}

}  // namespace contensou::portraits
