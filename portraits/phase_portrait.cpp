#include "contensou/portraits/phase_portrait.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/reduction/regularised_motion.hpp"

namespace contensou::portraits {

using reduction::Orbit;
using reduction::OrbitPoint;
using reduction::ReducedSystem;
using reduction::Route;
using reduction::State;
using std::numbers::pi;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Below this patch ratio the plane (u, v) alone shows a comb of verticals.
constexpr double pair_below = 0.1;

constexpr int orbits_per_side = 12;
constexpr double isochrones_wanted = 7;

/// The largest of 1, 2, 5 times a power of ten that is at most x.
double round_down(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  for (double digit : {5.0, 2.0}) {
    if (digit * power <= x) return digit * power;
  }
  return power;
}

Window default_window(const ReducedSystem& system, const std::optional<State>& highlight) {
  if (highlight && highlight->u != 0 && highlight->v != 0) return {1.2 * std::abs(highlight->u), 1.2 * highlight->v};
  if (highlight && highlight->u != 0) return {1.2 * std::abs(highlight->u), 1.2 * std::abs(highlight->u)};
  if (highlight && highlight->v != 0) return {1.2 * highlight->v, 1.2 * highlight->v};
  // Sliding and pivoting take the same time along the two borders: neither is squeezed against an axis.
  return {1, round_down(system.pivoting_limit(1) / system.sliding_limit(1))};
}

/// States from first to stop; v and u may underflow, ln v does not.
struct Track {
  std::vector<OrbitPoint> points;
  double stop_time;
};

class Painter {
 public:
  Painter(const ReducedSystem& system, Window window, const PortraitRequest& request)
      : system_(system), window_(window), request_(request) {
    solution_ = request.route == Route::quadrature ? reduction::quadrature_solution(system.law(), system.r())
                                                   : reduction::similarity_solution(system.law(), system.r());
  }

  PortraitOrbit orbit(State start) const {
    const Track track = request_.route == Route::regularised ? stepped(start) : exact(start);
    std::vector<const OrbitPoint*> kept;
    for (const OrbitPoint& point : track.points) {
      const bool last = &point == &track.points.back();
      if (last || kept.empty() || far_apart(*kept.back(), point)) kept.push_back(&point);
    }
    const auto rows = static_cast<Eigen::Index>(kept.size());
    PortraitOrbit result{Eigen::ArrayXd(rows), Eigen::ArrayXd(rows), Eigen::ArrayXd(rows), Eigen::ArrayXd(rows)};
    for (Eigen::Index i = 0; i < rows; ++i) {
      const OrbitPoint& point = *kept[static_cast<std::size_t>(i)];
      result.u[i] = point.u;
      result.v[i] = point.v;
      result.ln_k[i] = ln_k(point);
      result.tau_left[i] = std::max(0.0, track.stop_time - point.tau);
    }
    return result;
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

    std::vector<State> result;
    for (int i = 0; i < orbits_per_side; ++i) {
      const double wanted = across * (i + 0.5) / orbits_per_side;
      result.push_back(std::ranges::lower_bound(border, wanted, {}, &Step::across)->at);
    }
    return result;
  }

  std::vector<Isochrone> isochrones() const {
    const double longest = stop_time({window_.u, window_.v});
    const double step = round_down(longest / request_.time_unit / isochrones_wanted * 1.7) * request_.time_unit;
    std::vector<Isochrone> result;
    for (int i = 1; i * step < 0.95 * longest; ++i) add_isochrone(i * step, result);
    return result;
  }

 private:
  double stop_time(State start) const { return Orbit(system_, start, solution_).stop_time(); }

  double ln_k(const OrbitPoint& point) const {
    return point.u == 0 ? (point.v > 0 ? infinity : -infinity)
                        : point.ln_v - std::log(system_.mu() * std::abs(point.u));
  }

  /// Far enough apart to matter on paper, in (u, v) or in ln k.
  bool far_apart(const OrbitPoint& a, const OrbitPoint& b) const {
    constexpr double smallest = 1.0 / 300;
    const double distance = std::hypot((a.u - b.u) / window_.u, (a.v - b.v) / window_.v);
    return distance > smallest || std::abs(ln_k(a) - ln_k(b)) > 1;
  }

  Track exact(State start) const {
    const Orbit orbit(system_, start, solution_);
    Track track{{}, orbit.stop_time()};
    constexpr int instants = 100;
    double left = track.stop_time;
    if (start.u != 0 && start.v != 0) {
      // While sliding is seen, by k, in steps that neither speed shows on paper; then by time, in which u falls evenly.
      constexpr double share_of_window = 0.02;
      constexpr double invisible = 1e-6;
      double xi = orbit.start_coordinate();
      OrbitPoint point = orbit.at_coordinate(xi);
      while (point.v > invisible * window_.v && track.points.size() < 2000) {
        track.points.push_back(point);
        const auto rate = system_.field({point.u, point.v});
        const double speed = std::hypot(rate.u / window_.u, rate.v / window_.v) * orbit.curve().time_rate(xi) *
                             (system_.mu() * std::abs(point.u) + point.v) / system_.scaled_time_rate();
        xi -= std::min(share_of_window / speed, 0.4);
        point = orbit.at_coordinate(xi);
      }
      track.points.push_back(point);
      left = track.stop_time - point.tau;
    } else {
      track.points.push_back(orbit.at_time(0));
    }
    // Finer towards the stop, where ln k falls fastest.
    for (int i = instants - 1; i >= 0; --i) {
      const double share = static_cast<double>(i) / instants;
      track.points.push_back(orbit.at_time_left(left * share * share));
    }
    return track;
  }

  Track stepped(State start) const {
    const auto motion = reduction::integrate_regularised(system_, start);
    if (!motion.outcome.ok()) throw std::runtime_error(motion.outcome.sentence);
    Track track{{}, motion.stop_time};
    for (Eigen::Index i = 0; i < motion.points.rows(); ++i) track.points.push_back(motion.points.row(i));
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

  const ReducedSystem& system_;
  Window window_;
  const PortraitRequest& request_;
  reduction::SimilaritySolution solution_;
};

PortraitOrbit mirrored(PortraitOrbit orbit) {
  orbit.u = -orbit.u + 0.0;
  return orbit;
}

}  // namespace

std::string_view name(View view) { return view == View::uv ? "uv" : "pair"; }

PhasePortrait phase_portrait(const ReducedSystem& system, const PortraitRequest& request) {
  if (request.route == Route::direct) {
    throw std::domain_error("phase_portrait: orbits are drawn by closed, quadrature or regularised, not by direct");
  }
  if (request.highlight) reduction::require_state("phase_portrait", *request.highlight);
  const Window window = request.window.value_or(default_window(system, request.highlight));
  // Stop times and squares of speeds across the window must be doubles.
  constexpr double smallest = 1e-150;
  const auto reasonable = [](double side) { return side >= smallest && side <= 1 / smallest; };
  if (!reasonable(window.u) || !reasonable(window.v)) {
    throw std::domain_error(fmt::format(
        "phase_portrait: the sides of the window must be between {} and {}, got {} by {}: use another unit of speed",
        smallest, 1 / smallest, window.u, window.v));
  }
  const Painter painter(system, window, request);
  const double pivoting = system.r() * system.law().pivoting_moment();

  PhasePortrait portrait;
  portrait.law = system.law().name();
  portrait.mu = system.mu();
  portrait.view = system.mu() < pair_below ? View::pair : View::uv;
  portrait.window = window;
  portrait.pivoting_slope = system.law().force_slope() / pivoting - 1;
  for (const State& seed : painter.seeds()) {
    portrait.orbits.push_back(painter.orbit(seed));
    portrait.orbits.push_back(mirrored(portrait.orbits.back()));
  }
  portrait.isochrones = painter.isochrones();
  if (request.highlight && (request.highlight->u != 0 || request.highlight->v != 0)) {
    portrait.highlight = painter.orbit(*request.highlight);
  }
  return portrait;
}

}  // namespace contensou::portraits
