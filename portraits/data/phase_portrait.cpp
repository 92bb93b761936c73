#include "contensou/portraits/phase_portrait.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/reduction/regularised_motion.hpp"
#include "data/isochrones.hpp"
#include "data/round_numbers.hpp"

namespace contensou::portraits {

using reduction::Flow;
using reduction::Orbit;
using reduction::OrbitPoint;
using reduction::ReducedSystem;
using reduction::State;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Below this patch ratio the plane (u, v) alone shows a comb of verticals.
constexpr double pair_below = 0.1;

/// @param shown  states that the window must contain
Window default_window(const ReducedSystem& system, View view, const std::vector<State>& shown) {
  State far{0, 0};
  for (const State& state : shown) far = {std::max(far.u, std::abs(state.u)), std::max(far.v, state.v)};
  constexpr double margin = 1.2;
  if (view == View::patch || view == View::log || view == View::blowup) {
    // Both axes are speeds at the patch.
    const double side = margin * std::max(system.mu() * far.u, far.v);
    return side > 0 ? Window{side / system.mu(), side} : Window{1, system.mu()};
  }
  if (far.u != 0 && far.v != 0) return {margin * far.u, margin * far.v};
  if (far.u != 0 || far.v != 0) return {margin * std::max(far.u, far.v), margin * std::max(far.u, far.v)};
  // Sliding and pivoting take the same time along the two borders: neither is squeezed against an axis.
  return {1, round_down(system.pivoting_limit(1) / system.sliding_limit(1))};
}

using Instant = PortraitOrbit::Instant;
using Track = std::vector<Instant>;  // from first to stop

/// How far apart two states may be that lie next to each other on an orbit: 1 and no more.
using Distance = std::function<double(const Instant&, const Instant&)>;

/// The state of an orbit that has so much time left.
/// @param ln_k_stop  of the terminal ratio, which is taken for that of rest
Instant instant(const OrbitPoint& point, double left, double mu, double ln_k_stop) {
  const double ln_k =
      point.u == 0 ? (point.v > 0 ? infinity : ln_k_stop) : point.ln_v - std::log(mu * std::abs(point.u));
  return {point.u, point.v, point.ln_v, ln_k, left};
}

/// By how much ln k differs where it is seen to change: beyond, orbits hug an axis.
double turn(const Instant& a, const Instant& b) {
  return std::abs(std::clamp(a.ln_k, -20.0, 20.0) - std::clamp(b.ln_k, -20.0, 20.0));
}

/// Adds what lies between the last state of a track and those at the given places, halved until neighbours are near.
template <class At>
void refine(Track& track, double from, const std::vector<double>& places, At at, const Distance& distance) {
  std::vector<std::pair<double, Instant>> open;  // the next at the back
  for (double place : places) open.insert(open.begin(), {place, at(place)});
  while (!open.empty()) {
    const auto [place, state] = open.back();
    constexpr double closest = 1e-5;
    if (std::abs(place - from) > closest && distance(track.back(), state) > 1) {
      const double middle = (from + place) / 2;
      open.emplace_back(middle, at(middle));
      continue;
    }
    constexpr double near = 0.3;
    if (distance(track.back(), state) > near) track.push_back(state);
    from = place;
    open.pop_back();
  }
}

/// The last number in the direction of a step from another at which a condition holds, before it fails for good.
template <class Holds>
double last_where(Holds holds, double from, double step) {
  for (; holds(from + step); step *= 1.5) from += step;
  for (int i = 0; i < 50; ++i) {
    step /= 2;
    if (holds(from + step)) from += step;
  }
  return from;
}

PortraitOrbit columns(const Track& track) {
  const Eigen::ArrayXd empty(static_cast<Eigen::Index>(track.size()));
  PortraitOrbit orbit{empty, empty, empty, empty, empty};
  Eigen::Index row = 0;
  for (const Instant& at : track) {
    orbit.u[row] = at.u;
    orbit.v[row] = at.v;
    orbit.ln_v[row] = at.ln_v;
    orbit.ln_k[row] = at.ln_k;
    orbit.tau_left[row++] = at.tau_left;
  }
  return orbit;
}

class OrbitTracer {
 public:
  OrbitTracer(const Flow& flow, Window window, bool stepped) : flow_(flow), window_(window), is_stepped_(stepped) {}

  PortraitOrbit orbit(State start) const { return columns(is_stepped_ ? stepped(start) : exact(start)); }

  /// The orbit through a point, from where it enters the window.
  PortraitOrbit orbit_through(State point) const { return orbit(entry(point)); }

  /// Starts along the right half of the border, at equal distances across the flow as it is seen on paper.
  std::vector<State> seeds(int count) const {
    struct Step {
      State at;
      double across;
    };
    std::vector<Step> border;
    constexpr int steps = 2000;
    double across = 0;
    const auto walk = [&](auto place, bool along_top) {
      for (int i = 0; i < steps; ++i) {
        const State at = place((i + 0.5) / steps);
        const auto rate = system_.field(at);
        const double du = rate.u / window_.u;
        const double dv = rate.v / window_.v;
        across += std::abs(along_top ? dv : du) / std::hypot(du, dv) / steps;
        border.push_back({at, across});
      }
    };
    walk([&](double share) { return State{share * window_.u, window_.v}; }, true);
    walk([&](double share) { return State{window_.u, (1 - share) * window_.v}; }, false);

    std::vector<State> result;
    for (int i = 0; i < count; ++i) {
      const double wanted = across * (i + 0.5) / count;
      result.push_back(std::ranges::lower_bound(border, wanted, {}, &Step::across)->at);
    }
    if (count == 0) return result;
    for (const auto& curve : flow_.solution().curves()) {
      // A sector between two rays that is too narrow for any of these has one in its middle.
      const auto inside = [&](State at) {
        return flow_.solution().through(std::log(at.v / (system_.mu() * at.u))) == curve;
      };
      if (std::ranges::any_of(result, inside)) continue;
      const auto first = std::ranges::find_if(border, inside, &Step::at);
      result.push_back(first[std::ranges::count_if(border, inside, &Step::at) / 2].at);
    }
    return result;
  }

 private:
  double ln_k_stop(State start) const {
    return std::log(flow_.terminal().end_of(start.u == 0 ? infinity : start.v / (system_.mu() * std::abs(start.u))).k);
  }

  /// The orbit, by its nearness xi to the terminal ratio while k is seen to change, then by the time left, whose
  /// logarithm falls in even steps.
  Track exact(State start) const {
    const Orbit orbit = flow_.orbit(start);
    const Distance distance = [this](const Instant& a, const Instant& b) { return on_window(a, b); };
    const auto timed = [&, end = ln_k_stop(start)](const OrbitPoint& point, double left) {
      return instant(point, left, system_.mu(), end);
    };
    Track track{timed(orbit.at_time(0), orbit.stop_time())};
    if (!orbit.on_axis()) {
      constexpr double lowest = -20;
      const double first = orbit.start_coordinate();
      const auto at = [&](double xi) { return timed(orbit.at_coordinate(xi), orbit.time_left_at_coordinate(xi)); };
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
    // Far outside, orbits are seen by ratio only.
    const auto change = [](double x, double y) {
      return std::abs(std::clamp(x, -2.0, 2.0) - std::clamp(y, -2.0, 2.0));
    };
    const double u = change(a.u / window_.u, b.u / window_.u) / 0.02;
    const double v = change(a.v / window_.v, b.v / window_.v) / 0.02;
    // By ratio next to the axes, where the curve may turn sharply.
    const auto fold = [](double x, double y) { return std::abs(std::log(std::max(x, 1e-3) / std::max(y, 1e-3))); };
    const double folds = std::max(fold(std::abs(a.u) / window_.u, std::abs(b.u) / window_.u) / 0.15,
                                  fold(a.v / window_.v, b.v / window_.v) / 0.4);
    return std::max({u, v, turn(a, b) / 0.4, folds});
  }

  /// Where the orbit through a point enters the window: backwards along its curve, scaled onto the point.
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
    const auto outside = [this](State state) { return !(std::abs(state.u) <= window_.u && state.v <= window_.v); };
    return upstream(last_where([&](double xi) { return !outside(upstream(xi)); }, here, 1));
  }

  Track stepped(State start) const {
    const auto motion = reduction::integrate_regularised(system_, start);
    if (!motion.outcome.ok()) throw std::runtime_error(motion.outcome.sentence);
    Track track;
    for (Eigen::Index i = 0; i < motion.points.rows(); ++i) {
      const OrbitPoint point = motion.points.row(i);
      track.push_back(instant(point, std::max(0.0, motion.stop_time - point.tau), system_.mu(), ln_k_stop(start)));
    }
    return track;
  }

  const Flow& flow_;
  const ReducedSystem& system_ = flow_.system();
  Window window_;
  bool is_stepped_;
};

PortraitOrbit mirrored(PortraitOrbit orbit) {
  orbit.u = -orbit.u + 0.0;
  return orbit;
}

void require(const PortraitRequest& request) {
  if (request.orbits_per_side.value_or(0) < 0 || request.isochrones < 0) {
    throw std::domain_error(
        fmt::format("phase_portrait: numbers of orbits and isochrones must be "
                    ">= 0, got {} and {}",
                    request.orbits_per_side.value_or(0), request.isochrones));
  }
  if (request.highlight) reduction::require_state("phase_portrait", *request.highlight);
  for (const State& point : request.through) {
    reduction::require_state("phase_portrait", point);
    if (point.u != 0 && point.v != 0) continue;
    throw std::domain_error(
        fmt::format("phase_portrait: the orbit through ({}, {}) is an axis, "
                    "which is drawn anyway; u and v must not be 0",
                    point.u, point.v));
  }
}

void require(Window window, const PortraitRequest& request) {
  // Stop times and squares of speeds across the window must be doubles.
  constexpr double smallest = 1e-150;
  const auto reasonable = [](double side) { return side >= smallest && side <= 1 / smallest; };
  if (!reasonable(window.u) || !reasonable(window.v)) {
    throw std::domain_error(
        fmt::format("phase_portrait: the sides of the window must be between "
                    "{} and {}, got {} by {}: use another unit of speed",
                    smallest, 1 / smallest, window.u, window.v));
  }
  for (const State& point : request.through) {
    if (std::abs(point.u) <= window.u && point.v <= window.v) continue;
    throw std::domain_error(
        fmt::format("phase_portrait: the point ({}, {}) lies outside the "
                    "window |u| <= {}, v <= {}",
                    point.u, point.v, window.u, window.v));
  }
}

PhasePortrait portrait_in(const Flow& flow, View view, Window window, const PortraitRequest& request,
                          const std::vector<double>& times) {
  const OrbitTracer tracer(flow, window, request.stepped);
  PhasePortrait portrait{flow, reduction::phase_plane(flow.system()), view, window, {}, {}, {}, {}, {}};
  if (!request.drawn_only || view == View::uv || view == View::patch || view == View::pair) {
    portrait.isochrones = isochrones(flow, {{-window.u, 0}, {window.u, window.v}}, times);
    const int with_room_for_labels = view == View::pair ? 9 : 12;
    for (const State& seed : tracer.seeds(request.orbits_per_side.value_or(with_room_for_labels))) {
      portrait.orbits.push_back(tracer.orbit(seed));
      portrait.orbits.push_back(mirrored(portrait.orbits.back()));
    }
  }
  if (request.highlight && (request.highlight->u != 0 || request.highlight->v != 0)) {
    portrait.highlight = tracer.orbit(*request.highlight);
  }
  for (const State& point : request.through) portrait.through.push_back(tracer.orbit_through(point));
  return portrait;
}

/// Stop times of isochrones: multiples of a round time, up to the corner of the window, which is the last to stop.
std::vector<double> round_times(const Flow& flow, Window window, const PortraitRequest& request) {
  if (request.isochrones == 0) return {};
  const double longest = flow.orbit({window.u, window.v}).stop_time();
  const double step = round_step(longest / request.time_unit, request.isochrones) * request.time_unit;
  return multiples(0, 0.95 * longest, step);
}

}  // namespace

PortraitOrbit::Instant PortraitOrbit::at(Eigen::Index row, double factor) const {
  return {factor * u[row], factor * v[row], ln_v[row] + std::log(factor), ln_k[row], factor * tau_left[row]};
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
      upstream > 0 ? last_where([&](double xi) { return ln_size(xi) < size + upstream; }, here, 1) : here;
  const double last = last_where([&](double xi) { return ln_size(xi) > size - downstream; }, here, -1);
  Track track{at(first)};
  refine(track, first, {last}, at, [](const Instant& a, const Instant& b) {
    const double angle = std::abs(std::atan(std::exp(a.ln_k)) - std::atan(std::exp(b.ln_k)));
    const double shrinks = std::abs(a.ln_v - b.ln_v + std::min(b.ln_k, 0.0) - std::min(a.ln_k, 0.0));
    return std::max({angle / 0.02, turn(a, b) / 0.25, shrinks / 0.1});
  });
  track.push_back({0, 0, -infinity, chart.log_terminal_ratio(), 0});
  return columns(track);
}

PhasePortrait phase_portrait(const Flow& flow, const PortraitRequest& request) {
  require(request);
  const ReducedSystem& system = flow.system();
  std::vector<State> shown = request.through;
  if (request.highlight) shown.push_back(*request.highlight);
  const View view = request.view.value_or(system.mu() < pair_below ? View::pair : View::uv);
  const Window window = request.window.value_or(default_window(system, view, shown));
  require(window, request);
  const std::vector<double> times = round_times(flow, window, request);
  PhasePortrait portrait = portrait_in(flow, view, window, request, times);
  if (request.comparison) {
    const ReducedSystem other(*request.comparison, system.mu(), system.inertia());
    portrait.comparisons.push_back(portrait_in(other, view, window, request, times));
  }
  return portrait;
}

}  // namespace contensou::portraits
