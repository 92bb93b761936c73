#include "contensou/portraits/phase_portrait.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/detail/root.hpp"
#include "contensou/reduction/detail/stepped_motion.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "data/round_numbers.hpp"
#include "data/tracing.hpp"

namespace contensou::portraits {

using Eigen::Vector2d;
using reduction::Flow;
using reduction::Orbit;
using reduction::OrbitPoint;
using reduction::ReducedSystem;
using reduction::State;

double SpeedScale::height(double ln_v) const {
  const double ln_x = ln_v - std::log(top);
  return (std::exp(ln_x) + std::exp(exponent * ln_x)) / 2;
}

double SpeedScale::slope(double ln_v) const {
  const double ln_x = ln_v - std::log(top);
  return (std::exp(ln_x) + exponent * std::exp(exponent * ln_x)) / 2;
}

double SpeedScale::ln_v(double height) const {
  if (linear()) return std::log(top) + std::log(height);
  // Newton's method in l = ln x^s, from above. The height is convex in l, so each step decreases l and none overshoots.
  const double twice = std::log(2 * height);
  double l = std::min(twice, exponent * twice);
  for (int i = 0; i < 60; ++i) {
    const double x = std::exp(l / exponent), power = std::exp(l);
    const double step = (x + power - 2 * height) / (x / exponent + power);
    l -= step;
    if (!(step > 1e-15)) break;
  }
  return std::log(top) + l / exponent;
}

namespace {

/// Returns the default window |u| <= U, 0 <= v <= V as the state (U, V).
/// @param shown  states that the window must contain
State default_sides(const ReducedSystem& system, View view, const std::vector<State>& shown) {
  State far{0, 0};
  for (const State& state : shown) far = {std::max(far.u, std::abs(state.u)), std::max(far.v, state.v)};
  constexpr double margin = 1.2;
  if (view == View::patch || view == View::log || view == View::blowup) {
    // Both axes of the view patch are speeds at the patch. In the view blowup, one axis is u.
    const double side = margin * std::max(system.mu() * far.u, far.v);
    if (side > 0) return {view == View::blowup && far.u > 0 ? margin * far.u : side / system.mu(), side};
    return {1, system.mu()};
  }
  if (far.u != 0 && far.v != 0) return {margin * far.u, margin * far.v};
  if (far.u != 0 || far.v != 0) return {margin * std::max(far.u, far.v), margin * std::max(far.u, far.v)};
  // Pure sliding from v = V and pure pivoting from u = U last equally long: neither is squeezed against an axis.
  // The window does not reach above a large k, because balls there slide as if they did not spin.
  constexpr double large = 20;
  const double sliding = system.sliding_limit(1) / (1 - system.drive());
  return {1, round_down(std::min(system.pivoting_limit(1) / sliding, large * system.mu()))};
}

/// Returns two flags: true if the axis of v may be bent; true if a linear axis would show a comb of vertical lines.
std::pair<bool, bool> bends(const reduction::PhasePlane& plane) {
  constexpr double comb = 12;
  const auto& [direction, k, order] = plane.tangents.front();
  const bool may = plane.terminal.rays.empty() && direction == reduction::InvariantDirection::pivoting;
  return {may, may && 1 + order > comb};
}

SpeedScale scale_of(const reduction::PhasePlane& plane, const Window& window, bool linear) {
  return {window.v(), linear ? 1 : 1 / (1 + plane.tangents.front().contact_order)};
}

using Instant = PortraitOrbit::Instant;
using Track = std::vector<Instant>;  // from the first state to the stop

/// Converts a state.
/// @param ln_k_stop  ln k of the terminal ratio, used at rest
Instant instant(const Orbit::Remaining& at, double mu, double ln_k_stop) {
  const double ln_k = at.u == 0 ? (at.v > 0 ? infinity : ln_k_stop) : at.ln_v - std::log(mu * std::abs(at.u));
  return {at.u, at.v, at.ln_v, ln_k, at.tau_left};
}

/// Returns the visible change of ln k. Beyond |ln k| = 20 orbits cannot be distinguished from an axis.
double turn(const Instant& a, const Instant& b) {
  return std::abs(std::clamp(a.ln_k, -20.0, 20.0) - std::clamp(b.ln_k, -20.0, 20.0));
}

/// Starting at `from`, in the direction of a step, returns the last number for which a condition holds.
template <class Holds>
double last_along(Holds holds, double from, double step) {
  for (; holds(from + step); step *= 1.5) from += step;
  return reduction::last_where(holds, from, from + step);
}

/// Returns true if a curve begins at xi or later. Under a drive orbits come from v = 0, not from infinity.
bool begins(const reduction::SimilarityCurve& curve, const ReducedSystem& system, double xi) {
  return system.drive() > 0 && curve.chart().log_far_ratio() == -infinity &&
         curve.chart().log_ratio(xi) < reduction::least_log_ratio(system.law(), system.r(), system.drive());
}

PortraitOrbit columns(const Track& track) {
  const auto column = [&](double Instant::*part) {
    Eigen::ArrayXd values(std::ssize(track));
    std::ranges::transform(track, values.begin(), part);
    return values;
  };
  return {column(&Instant::u), column(&Instant::v), column(&Instant::ln_v), column(&Instant::ln_k),
          column(&Instant::tau_left)};
}

class OrbitTracer {
 public:
  OrbitTracer(const Flow& flow, const Window& window, const SpeedScale& scale, bool stepped)
      : flow_(flow), U_(window.u()), V_(window.v()), scale_(scale), is_stepped_(stepped) {}

  PortraitOrbit orbit(State start) const { return columns(is_stepped_ ? stepped(start) : exact(start)); }

  /// Returns the orbit through a point, from its entry into the window.
  PortraitOrbit orbit_through(State point) const { return orbit(entry(point)); }

  /// Returns orbits of both signs of u. They start on the right half of the border, equally far apart across the flow.
  std::vector<PortraitOrbit> orbits(int count) const {
    std::vector<PortraitOrbit> result;
    std::optional<PortraitOrbit> curve;
    for (const Seed& seed : seeds(count)) {
      if (scale_.linear()) {
        result.push_back(orbit({seed.u, speed(seed)}));
      } else {
        // Use copies of one curve, because v may be too small for a double.
        constexpr double above = 9;
        if (!curve) curve = contensou::portraits::orbit_through(flow_, 0, ln_w(0), above);
        result.push_back(copied(*curve, seed));
      }
      result.push_back(mirrored(result.back()));
    }
    return result;
  }

 private:
  /// A state whose v is given by its logarithm, which does not underflow.
  struct Seed {
    double u, ln_v;
  };

  /// Returns v, exact on the upper border.
  double speed(const Seed& at) const { return at.ln_v == std::log(V_) ? V_ : std::min(std::exp(at.ln_v), V_); }

  double ln_k(const Seed& at) const { return at.ln_v - std::log(system_.mu() * at.u); }

  /// Returns ln w, w = mu |u|, of the similarity curve itself. The orbit is a scaled copy of this curve.
  double ln_w(double ln_k) const {
    const reduction::SimilarityCurve& curve = *flow_.solution().through(ln_k);
    return curve.ln_w(curve.chart().coordinate(ln_k));
  }

  std::vector<Seed> seeds(int count) const {
    if (count == 0) return {};
    struct Step {
      double place, across;
    };
    // Places from 0 to 1 lie on the upper border, from 1 to 2 on the right border, downwards. Under a drive the lower
    // border is no orbit. Orbits then also begin there, at places from 2 to 3.
    const auto on_border = [this](double place) {
      if (place < 1) return Seed{place * U_, std::log(V_)};
      return place < 2 ? Seed{U_, scale_.ln_v(2 - place)} : Seed{(3 - place) * U_, -infinity};
    };
    std::vector<Step> border{{0, 0}};
    constexpr int steps = 500;  // number of steps along a side
    const int all_steps = (system_.drive() > 0 ? 3 : 2) * steps;
    for (int i = 0; i < all_steps; ++i) {
      const Seed at = on_border((i + 0.5) / steps);
      // Below this ln k rates divided by speeds are constant, because they depend on k alone.
      constexpr double lowest = -20;
      const double k = std::exp(std::max(ln_k(at), lowest));
      const auto rate = system_.field({1 / system_.mu(), k});
      const double du = rate.u * system_.mu() * at.u / U_;
      const double dv =
          rate.v / k * scale_.slope(std::isinf(at.ln_v) ? std::log(system_.mu() * at.u) + lowest : at.ln_v);
      const double across = std::abs(i < steps || i >= 2 * steps ? dv : du) / std::hypot(du, dv) / steps;
      border.push_back({static_cast<double>(i + 1) / steps, border.back().across + across});
    }

    std::vector<Seed> result;
    for (int i = 0; i < count; ++i) {
      const double wanted = border.back().across * (i + 0.5) / count;
      const auto after = std::ranges::lower_bound(border, wanted, {}, &Step::across), before = after - 1;
      const double fraction = (wanted - before->across) / (after->across - before->across);
      result.push_back(on_border(std::lerp(before->place, after->place, fraction)));
    }
    for (const auto& curve : flow_.solution().curves()) {
      const auto inside = [&](const Seed& at) { return flow_.solution().through(ln_k(at)) == curve; };
      if (std::ranges::none_of(result, inside)) result.push_back(amid(curve->chart()));
    }
    return result;
  }

  /// Returns a start on the border for a sector between two invariant half-lines that may be too narrow for the steps
  /// of seeds. The start lies halfway between two rays, or at half or twice the k of the ray next to an axis.
  Seed amid(const reduction::TerminalChart& sector) const {
    const auto [low, high] = std::minmax({sector.log_terminal_ratio(), sector.log_far_ratio()});
    const double half = std::log(2);
    const double ln_k = std::isinf(high) ? low + half : std::isinf(low) ? high - half : std::midpoint(low, high);
    const double ln_right = std::log(system_.mu() * U_) + ln_k, ln_top = std::log(V_);
    if (ln_right < ln_top) return {U_, ln_right};
    return {std::min(std::exp(ln_top - ln_k) / system_.mu(), U_), ln_top};
  }

  /// Returns the orbit from a start. It consists of the scaled rows of another orbit on the same similarity curve.
  PortraitOrbit copied(const PortraitOrbit& curve, const Seed& start) const {
    const double ln_k_start = ln_k(start);
    const double factor = system_.mu() * start.u * std::exp(-ln_w(ln_k_start));
    const double v = speed(start);
    Track track{{start.u, v, start.ln_v, ln_k_start, flow_.orbit({start.u, v}).stop_time()}};
    double last_height = scale_.height(start.ln_v);
    for (Eigen::Index row = 0; row < curve.rows(); ++row) {
      if (!(curve.ln_k[row] < ln_k_start)) continue;
      const Instant here = curve.at(row, factor), &last = track.back();
      const double u = std::abs(here.u - last.u) / U_;
      const double height = scale_.height(here.ln_v);
      constexpr double near = 0.006;
      if (std::max({u, std::abs(height - last_height), turn(here, last) / 20}) <= near) continue;
      track.push_back(here);
      last_height = height;
    }
    track.push_back(curve.at(curve.rows() - 1, factor));
    return columns(track);
  }

  static PortraitOrbit mirrored(PortraitOrbit orbit) {
    orbit.u = -orbit.u + 0.0;
    return orbit;
  }

  double ln_k_stop(State start) const {
    return std::log(flow_.terminal().end_of(start.u == 0 ? infinity : start.v / (system_.mu() * std::abs(start.u))).k);
  }

  /// Computes the orbit: first in steps of xi while k visibly changes, then in equal steps of ln (time left).
  Track exact(State start) const {
    const Orbit orbit = flow_.orbit(start);
    const auto distance = [this](const Instant& a, const Instant& b) { return on_window(a, b); };
    const double end = ln_k_stop(start);
    const auto timed = [&](const OrbitPoint& point, double left) {
      return instant({point.u, point.v, point.ln_v, left}, system_.mu(), end);
    };
    Track track{timed(orbit.at_time(0), orbit.stop_time())};
    if (!orbit.on_axis()) {
      constexpr double lowest = -20;
      const double first = orbit.start_coordinate();
      const auto at = [&](double xi) { return instant(orbit.remaining_at_coordinate(xi), system_.mu(), end); };
      refine(track, first, {std::min(lowest, first + lowest)}, at, distance);
    }
    const double begin = std::log(track.back().tau_left);
    std::vector<double> places;
    constexpr int folds = 30;
    for (int i = 1; i <= folds; ++i) places.push_back(begin - i);
    const auto at = [&](double place) { return timed(orbit.at_time_left(std::exp(place)), std::exp(place)); };
    refine(track, begin, places, at, distance);
    track.push_back(timed(orbit.at_time_left(0), 0));
    return track;
  }

  double on_window(const Instant& a, const Instant& b) const {
    // Distances far outside the window do not count; only ratios matter there.
    const auto change = [](double x, double y) {
      return std::abs(std::clamp(x, -2.0, 2.0) - std::clamp(y, -2.0, 2.0));
    };
    const double u = change(a.u / U_, b.u / U_) / 0.02;
    const double v = change(a.v / V_, b.v / V_) / 0.02;
    // Next to the axes, where the curve may turn sharply, distances are ratios.
    const auto fold = [](double x, double y) { return std::abs(std::log(std::max(x, 1e-3) / std::max(y, 1e-3))); };
    const double folds = std::max(fold(std::abs(a.u) / U_, std::abs(b.u) / U_) / 0.15, fold(a.v / V_, b.v / V_) / 0.4);
    return std::max({u, v, turn(a, b) / 0.4, folds});
  }

  /// Returns the state at which the orbit through a point enters the window, by following the scaled curve backwards.
  State entry(State point) const {
    const double mu = system_.mu();
    const double ln_k = std::log(point.v / (mu * std::abs(point.u)));
    const reduction::SimilarityCurve& curve = *flow_.solution().through(ln_k);
    const double here = curve.chart().coordinate(ln_k);
    const auto upstream = [&](double xi) {
      if (xi == here) return point;
      const double w = mu * std::abs(point.u) * std::exp(curve.ln_w(xi) - curve.ln_w(here));
      return State{std::copysign(w / mu, point.u), w * std::exp(curve.chart().log_ratio(xi))};
    };
    const auto outside = [this](State state) { return !(std::abs(state.u) <= U_ && state.v <= V_); };
    return upstream(
        last_along([&](double xi) { return !begins(curve, system_, xi) && !outside(upstream(xi)); }, here, 1));
  }

  Track stepped(State start) const {
    const auto motion = reduction::integrate_regularised(system_, start);
    if (!motion.outcome.ok()) throw std::runtime_error(motion.outcome.sentence);
    Track track;
    for (Eigen::Index i = 0; i < motion.points.rows(); ++i) {
      const OrbitPoint point = motion.points.row(i);
      const double left = std::max(0.0, motion.stop_time - point.tau);
      track.push_back(instant({point.u, point.v, point.ln_v, left}, system_.mu(), ln_k_stop(start)));
    }
    return track;
  }

  const Flow& flow_;
  const ReducedSystem& system_ = flow_.system();
  double U_, V_;
  SpeedScale scale_;
  bool is_stepped_;
};

void require(const PortraitRequest& request, const Window& window, View view) {
  const auto& [low, high] = window;
  if (request.window && !(low[0] < high[0] && low[1] < high[1] && low[1] >= 0)) {
    throw std::domain_error(fmt::format("portrait: a window has ends that grow, and v >= 0; got {} to {} by {} to {}",
                                        low[0], high[0], low[1], high[1]));
  }
  if (request.window && !shows_window(view)) {
    throw std::domain_error(fmt::format(
        "portrait: a window with ends of its own is of the views uv, patch and pair; {} has no such axes", name(view)));
  }
  // Stop times and squares of speeds in the window must be doubles.
  constexpr double smallest = 1e-150;
  const auto reasonable = [](double side) { return side >= smallest && side <= 1 / smallest; };
  if (!reasonable(window.u()) || !reasonable(window.v())) {
    throw std::domain_error(fmt::format(
        "portrait: the sides of the window must be between {} and {}, got {} by {}: use another unit of speed",
        smallest, 1 / smallest, window.u(), window.v()));
  }
  if (request.highlight) reduction::require_state("portrait", *request.highlight);
  for (const State& point : request.through) {
    reduction::require_state("portrait", point);
    if (point.u != 0 && point.v != 0) continue;
    throw std::domain_error(fmt::format(
        "portrait: ({}, {}) lies on an axis, through which no orbit passes; u and v must not be 0, or make it the start",
        point.u, point.v));
  }
  require(request, window);
}

/// Adds the regularised times to an orbit of a flow.
void add_betas(const Flow& flow, PortraitOrbit& motion) {
  if (!is_one_orbit(flow, motion)) return;
  const Orbit orbit = flow.orbit({motion.u[0], motion.v[0]});
  motion.beta = motion.tau_left.unaryExpr(
      [&](double left) { return orbit.at_time_left(std::min(left, orbit.stop_time())).beta; });
  motion.beta[0] = 0;
}

PhasePortrait portrait_in(const Flow& flow, View view, const Window& window, bool linear,
                          const PortraitRequest& request, const IsochroneTimes& times) {
  const reduction::PhasePlane plane = reduction::phase_plane(flow);
  const SpeedScale scale = scale_of(plane, window, linear);
  const OrbitTracer tracer(flow, window, scale, request.stepped);
  PhasePortrait portrait{{window, {}, {}, times.step, {}, {}, request.through}, flow, plane, view, scale, {}};
  if (!request.drawn_only || shows_window(view)) {
    portrait.isochrones = isochrones(flow, window, times.times);
    const int with_room_for_labels = view == View::pair ? 9 : 12;
    constexpr double most = 4;  // largest factor for the number of orbits if the window is a part of |u| <= U
    const double denser = std::clamp(window.u() / window.sides()[0], 1.0, most);
    portrait.orbits =
        tracer.orbits(request.orbits.value_or(static_cast<int>(std::lround(denser * with_room_for_labels))));
    const auto stays_outside = [&](const PortraitOrbit& orbit) {
      for (Eigen::Index i = 0; i < orbit.rows(); ++i) {
        if (window.contains({orbit.u[i], orbit.v[i]})) return false;
      }
      return true;
    };
    if (request.window) std::erase_if(portrait.orbits, stays_outside);
  }
  if (request.highlight && (request.highlight->u != 0 || request.highlight->v != 0)) {
    portrait.highlight = {tracer.orbit(*request.highlight)};
  }
  for (const State& point : request.through) portrait.through.push_back(tracer.orbit_through(point));
  for (const auto* orbits : {&portrait.highlight, &portrait.through}) {
    for (const PortraitOrbit& orbit : *orbits) {
      if (!request.uncoupled || orbit.u[0] == 0 || orbit.v[0] == 0) continue;
      portrait.uncoupled.push_back(uncoupled_orbit(flow, {orbit.u[0], orbit.v[0]}));
    }
  }
  for (auto* orbits : {&portrait.orbits, &portrait.highlight, &portrait.through}) {
    if (view != View::regularised || request.drawn_only) continue;
    for (PortraitOrbit& orbit : *orbits) add_betas(flow, orbit);
  }
  return portrait;
}

/// Returns the stop times of the isochrones of each plane: the requested times, else multiples of a round time up to
/// the last time. Without a requested number, the steps are the roundest. If the last times of compared planes differ
/// much, all times are from one series 1, 2, 5, 10, and each plane has a fixed number of these below its last time.
/// @param lasts  last stop times of the planes
std::vector<IsochroneTimes> round_times(const std::vector<double>& lasts, const PortraitRequest& request) {
  constexpr double near = 0.95, alike = 3, of_decade = 3;
  constexpr int usual_beside_others = 4, usual_of_series = 3;
  const double unit = request.time_unit;
  const auto [shortest, longest] = std::ranges::minmax(lasts);
  if (longest < alike * shortest || !request.isochrone_times.empty() || request.isochrones == 0) {
    const int usual = lasts.size() > 1 ? usual_beside_others : usual_isochrones;
    return std::vector(lasts.size(), isochrone_times(request, near * longest, usual));
  }
  const int count = request.isochrones.value_or(usual_of_series);
  std::vector<IsochroneTimes> result;
  for (double last : lasts) {
    constexpr double few_decades = 9;
    const double low = near * shortest / unit / std::pow(10, count / of_decade + 1);
    std::vector<double> times = round_ratios(low, near * last / unit, few_decades);
    times.erase(times.begin(), times.end() - std::min<std::ptrdiff_t>(count, std::ssize(times)));
    for (double& time : times) time *= unit;
    result.push_back({std::move(times), 0});
  }
  return result;
}

/// Returns one window for all planes; for the view patch without a requested window, windows of equal rim speeds.
std::vector<Window> windows_of(const std::vector<Flow>& flows, View view, const PortraitRequest& request) {
  if (request.window) return {flows.size(), *request.window};
  std::vector<State> shown = request.through, sides;
  if (request.highlight) shown.push_back(*request.highlight);
  for (const Flow& flow : flows) sides.push_back(default_sides(flow.system(), view, shown));
  const auto largest = [&](double State::*side) { return std::ranges::max(sides, {}, side).*side; };
  // Without points to show, except in the view patch, take the median of v: the smallest shows nothing of a large mu.
  const bool rims = view == View::patch;
  const double u = largest(&State::u), highest = largest(&State::v);
  std::ranges::sort(sides, {}, &State::v);
  const double v = shown.empty() && !rims ? sides[(sides.size() - 1) / 2].v : highest;
  std::vector<Window> windows;
  for (const Flow& flow : flows) {
    const Vector2d of = request.sides.value_or(Vector2d(rims ? v / flow.system().mu() : u, v));
    windows.push_back({{-of[0], 0}, of});
  }
  return windows;
}

}  // namespace

PortraitOrbit::Instant PortraitOrbit::at(Eigen::Index row, double factor) const {
  const auto ln = [row](const Eigen::ArrayXd& column) { return column.size() > 0 ? column[row] : NAN; };
  return {factor * u[row], factor * v[row], ln(ln_v) + std::log(factor), ln(ln_k), factor * tau_left[row]};
}

PortraitOrbit orbit_through(const Flow& flow, double ln_k, double ln_v, double upstream) {
  const reduction::SimilarityCurve& curve = *flow.solution().through(ln_k);
  const reduction::TerminalChart& chart = curve.chart();
  const double here = chart.coordinate(ln_k);
  const double ln_scale = ln_v - ln_k - curve.ln_w(here);
  const auto at = [&](double xi) {
    const double ln_w = ln_scale + curve.ln_w(xi), its_ln_k = chart.log_ratio(xi);
    const State state{std::exp(ln_w) / flow.system().mu(), std::exp(ln_w + its_ln_k)};
    return Instant{state.u, state.v, ln_w + its_ln_k, its_ln_k, flow.orbit(state).stop_time()};
  };
  const auto ln_size = [&](double xi) { return ln_scale + curve.ln_w(xi) + std::max(chart.log_ratio(xi), 0.0); };
  const double size = ln_size(here);
  constexpr double downstream = 30;
  const double first =
      upstream > 0
          ? last_along([&](double xi) { return !begins(curve, flow.system(), xi) && ln_size(xi) < size + upstream; },
                       here, 1)
          : here;
  const double last = last_along([&](double xi) { return ln_size(xi) > size - downstream; }, here, -1);
  Track track{at(first)};
  // Use u if it does not underflow, because ln v - ln k has lost its digits for orbits next to the axis.
  const auto its_ln_size = [mu = flow.system().mu()](const Instant& it) {
    return (it.u > 0 ? std::log(mu * it.u) : it.ln_v - it.ln_k) + std::max(it.ln_k, 0.0);
  };
  refine(track, first, {last}, at, [&](const Instant& a, const Instant& b) {
    const double angle = std::abs(std::atan(std::exp(a.ln_k)) - std::atan(std::exp(b.ln_k)));
    const double shrinks = std::abs(its_ln_size(a) - its_ln_size(b));
    return std::max({angle / 0.02, turn(a, b) / 0.25, shrinks / 0.1});
  });
  track.push_back({0, 0, -infinity, chart.log_terminal_ratio(), 0});
  return columns(track);
}

PortraitOrbit uncoupled_orbit(const Flow& flow, const State& start) {
  const double slides = flow.orbit({0, start.v}).stop_time(), spins = flow.system().pivoting_limit(start.u);
  const double first = std::min(slides, spins), last = std::max(slides, spins);
  Track track;
  /// @param faster, slower  shares of the starting speeds that are left: of the speed that stops first, and of the
  /// other
  const auto add = [&](double faster, double slower, double left) {
    const auto [of_v, of_u] = slides < spins ? std::pair(faster, slower) : std::pair(slower, faster);
    const double ln_v = std::log(of_v * start.v), ln_u = std::log(of_u * std::abs(start.u));
    track.push_back({of_u * start.u, of_v * start.v, ln_v, ln_v - ln_u - std::log(flow.system().mu()), left});
  };
  constexpr int pieces = 120;
  constexpr double folds = 30;  // logarithmic axes show times this many powers of e before the stop
  const auto share = [](int i) { return std::exp(-folds * i / pieces); };
  for (int i = 0; i <= pieces; ++i) {
    const double left = last - first + share(i) * first;
    add(share(i), left / last, left);
  }
  for (int i = 0; i <= pieces && last > first; ++i) add(0, share(i) * (1 - first / last), share(i) * (last - first));
  track.push_back({0, 0, -infinity, track.back().ln_k, 0});
  return columns(track);
}

std::vector<PhasePortrait> phase_portraits(const std::vector<Flow>& flows, const PortraitRequest& request) {
  const View view = request.view.value_or(View::uv);
  const std::vector<Window> windows = windows_of(flows, view, request);
  std::vector<double> lasts;
  bool all_may_bend = true, one_is_comb = false;
  for (std::size_t i = 0; i < flows.size(); ++i) {
    require(request, windows[i], view);
    lasts.push_back(flows[i].orbit({windows[i].u(), windows[i].v()}).stop_time());
    const auto [may_bend, comb] = bends(reduction::phase_plane(flows[i]));
    all_may_bend = all_may_bend && may_bend;
    one_is_comb = one_is_comb || comb;
  }
  const bool linear = request.linear || request.stepped || !shows_window(view) || !all_may_bend || !one_is_comb;
  const std::vector<IsochroneTimes> times = round_times(lasts, request);
  std::vector<PhasePortrait> portraits;
  bool has_isochrones = false;
  for (std::size_t i = 0; i < flows.size(); ++i) {
    const ReducedSystem& system = flows[i].system();
    PhasePortrait portrait = portrait_in(flows[i], view, windows[i], linear, request, times[i]);
    has_isochrones = has_isochrones || !portrait.isochrones.empty();
    if (request.comparison) {
      const ReducedSystem other(*request.comparison, system.mu(), system.inertia(), system.drive());
      const bool its_linear = linear || !bends(reduction::phase_plane(other)).second;
      portrait.comparisons.push_back(portrait_in(other, view, windows[i], its_linear, request, times[i]));
      portrait.comparisons.back().scale = portrait.scale;
    }
    portraits.push_back(std::move(portrait));
  }
  if (!request.isochrone_times.empty() && shows_window(view) && !has_isochrones) {
    throw std::domain_error(fmt::format(
        "portrait: no state in the window has a stop time that isochrones are asked of; in its corner it is {:.3g}",
        std::ranges::max(lasts) / request.time_unit));
  }
  return portraits;
}

PhasePortrait phase_portrait(const Flow& flow, const PortraitRequest& request) {
  return phase_portraits({flow}, request).front();
}

}  // namespace contensou::portraits
