#include "contensou/portraits/phase_portrait.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/reduction/regularised_motion.hpp"

namespace contensou::portraits {

using reduction::Flow;
using reduction::Orbit;
using reduction::OrbitPoint;
using reduction::ReducedSystem;
using reduction::State;
using std::numbers::pi;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Below this patch ratio the plane (u, v) alone shows a comb of verticals.
constexpr double pair_below = 0.1;

/// Where whole curves begin, next to infinity: at k or 1/k; more where the window is steeper.
constexpr double largest_k = 1e6;

/// Orbits on each side of u = 0: as many as leave room for the isochrones' labels.
int standard_count(View view) { return view == View::pair ? 9 : 12; }

constexpr std::array view_names{
    std::pair{View::uv, "uv"},         std::pair{View::patch, "patch"},
    std::pair{View::log, "log"},       std::pair{View::similarity, "similarity"},
    std::pair{View::blowup, "blowup"}, std::pair{View::disc, "disc"},
    std::pair{View::time, "time"},     std::pair{View::pair, "pair"},
};

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

/// A state of an orbit with the time until its stop; v and u may underflow, ln v does not.
struct Dated {
  OrbitPoint point;
  double left;
};
using Track = std::vector<Dated>;  // from first to stop

/// How far apart two states may be that lie next to each other on an orbit: 1 and no more.
using Distance = std::function<double(const OrbitPoint&, const OrbitPoint&)>;

double log_ratio(const OrbitPoint& point, double mu) {
  if (point.u == 0) return point.v > 0 ? infinity : -infinity;
  return point.ln_v - std::log(mu * std::abs(point.u));
}

/// ln k where it is seen to change: beyond, orbits hug an axis.
double seen_log_ratio(const OrbitPoint& point, double mu) { return std::clamp(log_ratio(point, mu), -20.0, 20.0); }

/// Adds what lies between the last state of a track and those at the given places, halved until neighbours are near.
template <class At>
void refine(Track& track, double from, const std::vector<double>& places, At at, const Distance& distance) {
  std::vector<std::pair<double, Dated>> open;  // the next at the back
  for (double place : places) open.insert(open.begin(), {place, at(place)});
  while (!open.empty()) {
    const auto [place, state] = open.back();
    constexpr double closest = 1e-5;
    if (std::abs(place - from) > closest && distance(track.back().point, state.point) > 1) {
      const double middle = (from + place) / 2;
      open.emplace_back(middle, at(middle));
      continue;
    }
    constexpr double near = 0.3;
    if (distance(track.back().point, state.point) > near) track.push_back(state);
    from = place;
    open.pop_back();
  }
}

/// The orbit, by its nearness xi to the terminal ratio while k is seen to change, then by the time left, whose
/// logarithm falls in even steps.
Track exact_track(const Orbit& orbit, const Distance& distance) {
  const double stop = orbit.stop_time();
  Track track{{orbit.at_time(0), stop}};
  if (!orbit.on_axis()) {
    constexpr double farthest = 20;
    const double start = orbit.start_coordinate();
    const auto at = [&](double xi) { return Dated{orbit.at_coordinate(xi), orbit.time_left_at_coordinate(xi)}; };
    refine(track, start, {std::min(-farthest, start - farthest)}, at, distance);
  }
  const double begin = std::log(track.back().left);
  std::vector<double> places;
  constexpr int folds = 30;
  for (int i = 1; i <= folds; ++i) places.push_back(begin - i);
  const auto at = [&](double place) { return Dated{orbit.at_time_left(std::exp(place)), std::exp(place)}; };
  refine(track, begin, places, at, distance);
  track.push_back({orbit.at_time_left(0), 0});
  return track;
}

class Painter {
 public:
  Painter(const Flow& flow, View view, Window window, const PortraitRequest& request)
      : flow_(flow), view_(view), window_(window), request_(request) {}

  PortraitOrbit orbit(State start) const {
    const Distance distance = [this](const OrbitPoint& a, const OrbitPoint& b) { return on_window(a, b); };
    return columns(request_.stepped ? stepped(start) : exact(start, distance), start);
  }

  /// The orbit through a point, from where it enters the window.
  PortraitOrbit orbit_through(State point) const { return orbit(entry(point)); }

  /// From next to infinity to the origin, one for each curve of the solution.
  std::vector<WholeCurve> whole_curves() const {
    std::vector<WholeCurve> curves;
    for (const auto& curve : flow_.solution().curves()) {
      const reduction::Approach& approach = curve->approach();
      curves.push_back(
          {whole_curve(approach), std::exp(approach.log_far_ratio()), std::exp(approach.log_terminal_ratio())});
    }
    std::ranges::sort(curves, {}, [](const WholeCurve& curve) { return std::min(curve.k_from, curve.k_to); });
    return curves;
  }

  PortraitOrbit whole_curve(const reduction::Approach& approach) const {
    const double mu = system_.mu();
    const Distance distance = [mu](const OrbitPoint& a, const OrbitPoint& b) {
      const double turn = std::abs(std::atan(a.k) - std::atan(b.k)) / 0.02;
      const double ratio = std::abs(seen_log_ratio(a, mu) - seen_log_ratio(b, mu)) / 0.25;
      const double shrink = std::abs(std::log(std::hypot(mu * a.u, a.v) / std::hypot(mu * b.u, b.v))) / 0.1;
      return std::max({turn, ratio, std::isfinite(shrink) ? shrink : 0});
    };
    // Steep; or, from a ray, so much beside it that it is told from it.
    const double end = std::exp(approach.log_terminal_ratio());
    const double far = std::exp(approach.log_far_ratio());
    constexpr double beside = 14;  // exp(-14) = 1e-6
    const double from_ray = (approach.side() == reduction::Approach::Side::above ? 1 : -1) * approach.log_far_ratio();
    const double k = far == 0          ? std::min(1 / steepest_, 1e-3 * end)
                     : std::isinf(far) ? std::max(steepest_, 1e3 * end)
                                       : std::exp(approach.log_ratio(from_ray + beside));
    return columns(exact({1 / mu, k}, distance), {1 / mu, k});
  }

  StopProfile profile() const {
    const double farthest = std::log(steepest_);
    constexpr double step = 0.1;
    const auto rows = static_cast<Eigen::Index>(2 * farthest / step) + 3;
    StopProfile profile{Eigen::ArrayXd(rows), Eigen::ArrayXd(rows)};
    profile.ln_k << -infinity, Eigen::ArrayXd::LinSpaced(rows - 2, -farthest, farthest), infinity;
    for (Eigen::Index i = 0; i < rows; ++i) {
      const double angle = std::atan(std::exp(profile.ln_k[i]));
      const bool sliding = i == rows - 1;
      profile.tau[i] = stop_time({sliding ? 0 : std::cos(angle) / system_.mu(), std::sin(angle)});
    }
    return profile;
  }

  /// Starts along the right half of the border, at equal distances across the flow as it is seen on paper.
  std::vector<State> seeds() const {
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

    const int count = request_.orbits_per_side.value_or(standard_count(view_));
    std::vector<State> result;
    for (int i = 0; i < count; ++i) {
      const double wanted = across * (i + 0.5) / count;
      result.push_back(std::ranges::lower_bound(border, wanted, {}, &Step::across)->at);
    }
    return result;
  }

  std::vector<Isochrone> isochrones() const {
    std::vector<Isochrone> result;
    if (request_.isochrones == 0) return result;
    const double longest = stop_time({window_.u, window_.v});
    const double step = round_down(longest / request_.time_unit / request_.isochrones * 1.7) * request_.time_unit;
    for (int i = 1; i * step < 0.95 * longest; ++i) {
      if (request_.drawn_only) {
        result.push_back({i * step, {}, {}});
      } else {
        add_isochrone(i * step, result);
      }
    }
    return result;
  }

 private:
  double stop_time(State start) const { return flow_.orbit(start).stop_time(); }

  Track exact(State start, const Distance& distance) const { return exact_track(flow_.orbit(start), distance); }

  PortraitOrbit columns(const Track& track, State start) const {
    const double k_stop =
        flow_.terminal().end_of(start.u == 0 ? infinity : start.v / (system_.mu() * std::abs(start.u))).k;
    const auto rows = static_cast<Eigen::Index>(track.size());
    const Eigen::ArrayXd empty(rows);
    PortraitOrbit result{empty, empty, empty, empty, empty};
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto& [point, left] = track[static_cast<std::size_t>(i)];
      result.u[i] = point.u;
      result.v[i] = point.v;
      result.ln_v[i] = point.ln_v;
      const bool rest = point.u == 0 && point.v == 0;
      result.ln_k[i] = rest ? std::log(k_stop) : log_ratio(point, system_.mu());
      result.tau_left[i] = left;
    }
    return result;
  }

  double on_window(const OrbitPoint& a, const OrbitPoint& b) const {
    const double u = std::abs(a.u - b.u) / window_.u / 0.02;
    const double v = std::abs(a.v - b.v) / window_.v / 0.02;
    const double ratio = std::abs(seen_log_ratio(a, system_.mu()) - seen_log_ratio(b, system_.mu())) / 0.4;
    // By ratio next to the axes, where the curve may turn sharply.
    const auto fold = [](double x, double y) { return std::abs(std::log(std::max(x, 1e-3) / std::max(y, 1e-3))); };
    const double folds = std::max(fold(std::abs(a.u) / window_.u, std::abs(b.u) / window_.u) / 0.15,
                                  fold(a.v / window_.v, b.v / window_.v) / 0.4);
    return std::max({u, v, ratio, folds});
  }

  /// Where the orbit through a point enters the window: backwards along its curve, scaled onto the point.
  State entry(State point) const {
    const double mu = system_.mu();
    const double ln_k = std::log(point.v / (mu * std::abs(point.u)));
    const reduction::SimilarityCurve& curve = *flow_.solution().through(ln_k);
    const double here = curve.approach().coordinate(ln_k);
    const auto upstream = [&](double xi) {
      if (xi == here) return point;
      const double w = mu * std::abs(point.u) * std::exp(curve.log_rim(xi) - curve.log_rim(here));
      return State{std::copysign(w / mu, point.u), w * std::exp(curve.approach().log_ratio(xi))};
    };
    const auto outside = [this](State state) { return !(std::abs(state.u) <= window_.u && state.v <= window_.v); };
    double inside = here;
    double step = 1;
    while (!outside(upstream(inside + step))) {
      inside += step;
      step *= 1.5;
    }
    for (int i = 0; i < 50; ++i) {
      step /= 2;
      if (!outside(upstream(inside + step))) inside += step;
    }
    return upstream(inside);
  }

  Track stepped(State start) const {
    const auto motion = reduction::integrate_regularised(system_, start);
    if (!motion.outcome.ok()) throw std::runtime_error(motion.outcome.sentence);
    Track track;
    for (Eigen::Index i = 0; i < motion.points.rows(); ++i) {
      const OrbitPoint point = motion.points.row(i);
      track.push_back({point, std::max(0.0, motion.stop_time - point.tau)});
    }
    return track;
  }

  /// The isochrone in the window: by scaling, the point on each ray through the origin is known at once.
  void add_isochrone(double tau_stop, std::vector<Isochrone>& result) const {
    const auto on_ray = [&](double angle) {
      const State direction{window_.u * std::cos(angle), window_.v * std::sin(angle)};
      const double scale = tau_stop / stop_time(direction);
      return State{scale * direction.u, scale * direction.v};
    };
    // Stop times grow with u and with v: along the curve u falls and v grows.
    const auto first_angle = [&](auto reached) {
      double low = 0;
      double high = pi / 2;
      for (int i = 0; i < 50; ++i) {
        const double middle = (low + high) / 2;
        (reached(on_ray(middle)) ? high : low) = middle;
      }
      return high;
    };
    const bool from_axis = on_ray(0).u <= window_.u;
    const bool to_axis = on_ray(pi / 2).v <= window_.v;
    const double first = from_axis ? 0 : first_angle([&](State at) { return at.u <= window_.u; });
    const double last = to_axis ? pi / 2 : first_angle([&](State at) { return at.v >= window_.v; });

    // Evenly on paper, and down to k = 1e-4 next to the axis v = 0, where ln k changes fast.
    constexpr int pieces = 48;
    std::vector<double> angles;
    for (int i = 0; i <= pieces; ++i) angles.push_back(first + (last - first) * i / pieces);
    for (int decade = -4; decade <= 3; ++decade) {
      const double angle = std::atan(std::pow(10, decade) * system_.mu() * window_.u / window_.v);
      if (angle > first && angle < last) angles.push_back(angle);
    }
    std::ranges::sort(angles);
    std::vector<State> right;
    for (double angle : angles) right.push_back(on_ray(angle));
    if (to_axis) right.back().u = 0;
    const auto emit = [&](const std::vector<State>& states) {
      const auto rows = static_cast<Eigen::Index>(states.size());
      Isochrone isochrone{tau_stop, Eigen::ArrayXd(rows), Eigen::ArrayXd(rows)};
      for (Eigen::Index i = 0; i < rows; ++i) {
        isochrone.u[i] = states[static_cast<std::size_t>(i)].u;
        isochrone.v[i] = states[static_cast<std::size_t>(i)].v;
      }
      result.push_back(std::move(isochrone));
    };
    std::vector<State> left = right;
    std::ranges::reverse(left);
    for (State& state : left) state.u = -state.u;
    if (to_axis) {
      right.insert(right.end(), left.begin() + 1, left.end());
      emit(right);
    } else {
      emit(right);
      emit(left);
    }
  }

  const Flow& flow_;
  const ReducedSystem& system_ = flow_.system();
  View view_;
  Window window_;
  const PortraitRequest& request_;
  double steepest_ = std::max(largest_k, 1e3 * window_.v / (system_.mu() * window_.u));
};

PortraitOrbit mirrored(PortraitOrbit orbit) {
  orbit.u = -orbit.u + 0.0;
  return orbit;
}

void require(const PortraitRequest& request) {
  if (request.orbits_per_side.value_or(0) < 0 || request.isochrones < 0) {
    throw std::domain_error(fmt::format("phase_portrait: numbers of orbits and isochrones must be >= 0, got {} and {}",
                                        request.orbits_per_side.value_or(0), request.isochrones));
  }
  if (request.highlight) reduction::require_state("phase_portrait", *request.highlight);
  for (const State& point : request.through) {
    reduction::require_state("phase_portrait", point);
    if (point.u != 0 && point.v != 0) continue;
    throw std::domain_error(fmt::format(
        "phase_portrait: the orbit through ({}, {}) is an axis, which is drawn anyway; u and v must not be 0", point.u,
        point.v));
  }
}

void require(Window window, const PortraitRequest& request) {
  // Stop times and squares of speeds across the window must be doubles.
  constexpr double smallest = 1e-150;
  const auto reasonable = [](double side) { return side >= smallest && side <= 1 / smallest; };
  if (!reasonable(window.u) || !reasonable(window.v)) {
    throw std::domain_error(fmt::format(
        "phase_portrait: the sides of the window must be between {} and {}, got {} by {}: use another unit of speed",
        smallest, 1 / smallest, window.u, window.v));
  }
  for (const State& point : request.through) {
    if (std::abs(point.u) <= window.u && point.v <= window.v) continue;
    throw std::domain_error(fmt::format("phase_portrait: the point ({}, {}) lies outside the window |u| <= {}, v <= {}",
                                        point.u, point.v, window.u, window.v));
  }
}

PhasePortrait portrait_in(const Flow& flow, View view, Window window, const PortraitRequest& request) {
  const Painter painter(flow, view, window, request);
  PhasePortrait portrait{
      flow.system(), reduction::phase_plane(flow.system()), view, window, {}, {}, {}, painter.profile(), {}, {}, {}};
  const bool whole = !request.drawn_only || view == View::pair;
  const bool speeds = view == View::uv || view == View::patch;
  if (whole || speeds) {
    portrait.isochrones = painter.isochrones();
    for (const State& seed : painter.seeds()) {
      portrait.orbits.push_back(painter.orbit(seed));
      portrait.orbits.push_back(mirrored(portrait.orbits.back()));
    }
  }
  if (whole || !speeds) portrait.curves = painter.whole_curves();
  if (request.highlight && (request.highlight->u != 0 || request.highlight->v != 0)) {
    portrait.highlight = painter.orbit(*request.highlight);
  }
  for (const State& point : request.through) portrait.through.push_back(painter.orbit_through(point));
  return portrait;
}

}  // namespace

std::string_view name(View view) {
  return std::ranges::find(view_names, view, [](const auto& entry) { return entry.first; })->second;
}

std::optional<View> find_view(std::string_view name) {
  for (const auto& [view, its_name] : view_names) {
    if (name == its_name) return view;
  }
  return std::nullopt;
}

const std::vector<View>& views() {
  static const std::vector<View> all = [] {
    std::vector<View> list;
    for (const auto& entry : view_names) list.push_back(entry.first);
    return list;
  }();
  return all;
}

double round_down(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (double digit : {5.0, 2.0}) {
    if (digit * power <= x) return digit * power;
  }
  return power;
}

PortraitOrbit::Instant PortraitOrbit::at(Eigen::Index row, double factor) const {
  return {factor * u[row], factor * v[row], ln_v[row] + std::log(factor), ln_k[row], factor * tau_left[row]};
}

PhasePortrait phase_portrait(const Flow& flow, const PortraitRequest& request) {
  require(request);
  const ReducedSystem& system = flow.system();
  std::vector<State> shown = request.through;
  if (request.highlight) shown.push_back(*request.highlight);
  const View view = request.view.value_or(system.mu() < pair_below ? View::pair : View::uv);
  const Window window = request.window.value_or(default_window(system, view, shown));
  require(window, request);
  PhasePortrait portrait = portrait_in(flow, view, window, request);
  if (request.against) {
    const ReducedSystem other(*request.against, system.mu(), system.inertia());
    portrait.against.push_back(portrait_in(other, view, window, request));
  }
  return portrait;
}

}  // namespace contensou::portraits
