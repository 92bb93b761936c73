// u, v and the time against the regularised time beta (reduction::ReducedSystem). The stop lies at beta = infinity.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/flow.hpp"
#include "data/tracing.hpp"
#include "views/portrait_views.hpp"

namespace contensou::portraits {

namespace {

using std::numbers::pi;

/// Returns 1/beta_1, the sum of |d ln v/dbeta| on the axis u = 0 and |d ln u/dbeta| on the axis v = 0.
double rate_at(const reduction::ReducedSystem& system, double w, double v) {
  const double chi = system.inertia().chi;
  return 30 * pi * chi * v + 256 / (3 * pi) * chi * system.r() * system.law().pivoting_moment() * w;
}

/// Returns 1 + beta/beta_1. On the axis v = 0, u is u0 divided by this number; on u = 0, v is v0 divided by it.
double regularised_time(const reduction::Flow& flow, const Instant& at, const Instant& start) {
  if (at.tau_left == 0) return infinity;
  const double mu = flow.system().mu();
  const auto b_over_speed = [&](const Instant& it) {
    const auto& curve = *flow.solution().through(it.ln_k);
    return curve.beta_coefficient(curve.chart().coordinate(it.ln_k)) / (mu * std::abs(it.u) + it.v);
  };
  // reduction/numerics.md (R39)
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

/// A motion sampled at equal ratios of 1 + beta/beta_1, from 1 to a limit. Rows of a PortraitOrbit suit the plane, but
/// for a small patch these rows leave out decades of beta.
struct BetaCourse {
  std::vector<double> places;
  std::vector<Instant> instants;
};

BetaCourse beta_course(const reduction::Flow& flow, reduction::State start, double border) {
  constexpr int of_decade = 24, fewest = 240;
  const double rate = rate_at(flow.system(), flow.system().mu() * std::abs(start.u), start.v);
  const int count = std::max(fewest, static_cast<int>(of_decade * std::log10(border)));
  BetaCourse course;
  Eigen::ArrayXd betas(count + 1);
  for (int i = 0; i <= count; ++i) {
    course.places.push_back(i == count ? border : std::pow(border, static_cast<double>(i) / count));
    betas[i] = (course.places.back() - 1) / rate;
  }
  const reduction::OrbitColumns at = reduction::at_betas(flow, start, betas);
  const double stop = flow.orbit(start).stop_time();
  for (Eigen::Index i = 0; i <= count; ++i)
    course.instants.push_back({at.u[i], at.v[i], at.ln_v[i], std::log(at.k[i]), stop - at.tau[i]});
  return course;
}

}  // namespace

std::vector<MappedPanel> regularised_view(const Drawing& drawing) {
  const PhasePortrait& portrait = drawing.portrait;
  // At `border` both speeds have long been powers of beta, even if one speed is much smaller at the start.
  const reduction::ReducedSystem& system = portrait.system();
  const std::vector<double> ratios = start_ratios(portrait);
  const double slow = std::max(rate_at(system, 1, ratios.back()) / rate_at(system, 1, 0),
                               rate_at(system, 1, ratios.front()) / rate_at(system, 0, ratios.front()));
  const double border = std::pow(10, std::ceil(3 + std::log10(slow)));
  constexpr double least = 1e-12;  // smallest u/u0 that is drawn
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

  // Towards the stop u and v are powers of beta. The speed that vanishes last is proportional to 1/beta.
  Lines powers_of_u{{}, {drawing.palette.comparison, 1, true}, "asymptotes"}, powers_of_v = powers_of_u;
  add_courses(drawing, [&](const PhasePortrait& of, const PortraitOrbit& orbit, Stroke stroke, const Text& legend) {
    const auto& terminal = of.plane.terminal;
    const double end = terminal.end_of(std::exp(orbit.ln_k[0])).k, r = of.system().r();
    if (!is_one_orbit(of.flow, orbit)) return;
    const BetaCourse course = beta_course(of.flow, {orbit.u[0], orbit.v[0]}, border);
    const Instant &first = course.instants.front(), &last = course.instants.back();
    for (std::size_t i = 0; i < panels.size(); ++i) {
      Polyline line;
      for (std::size_t j = 0; j < course.places.size(); ++j) {
        const double value = quantities[i](course.instants[j], first);
        if (i == 0 && value < least) break;  // u may underflow, and the axis is logarithmic
        line.push_back({course.places[j], value});
      }
      panels[i].panel.lines.push_back({{std::move(line)}, stroke, legend});
    }
    const double u = spin_left(last, first), v = log_slip_left(last, first);
    const double power_of_u = std::isinf(end) ? r / terminal.high : 1, power_of_v = end == 0 ? terminal.low / r : 1;
    if (u >= least) powers_of_u.lines.push_back({{1, u * std::pow(border, power_of_u)}, {border, u}});
    powers_of_v.lines.push_back({{1, v + power_of_v * std::log(border)}, {border, v}});
    panels[0].panel.y.low = std::min(panels[0].panel.y.low, std::max(u, least));
    panels[1].panel.y.low = std::min(panels[1].panel.y.low, 1.02 * v);
  });
  panels[0].panel.lines.push_back(std::move(powers_of_u));
  panels[1].panel.lines.push_back(std::move(powers_of_v));
  panels[2].panel.lines.push_back({{{{1, 1}, {border, 1}}}, {drawing.palette.comparison, 1, true}, "asymptotes"});
  return panels;
}

}  // namespace contensou::portraits
