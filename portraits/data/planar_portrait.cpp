#include "contensou/portraits/planar_portrait.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "data/isochrones.hpp"
#include "data/tracing.hpp"
#include "data/widest_gaps.hpp"
#include "data/zero_lines.hpp"

namespace contensou::portraits {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using reduction::PlanarEnd;
using reduction::PlanarReduction;
using reduction::PlanarSector;
using reduction::State;
using std::numbers::pi;

namespace {

/// Maps a number x to the directions q of a sector, or of a full turn without sectors. x grows in the direction of the
/// motion, and directions are dense towards both ends.
struct Course {
  std::function<double(double x)> q;
  double low, high;  ///< range of x
};

Course course_of(const PlanarSector& sector) {
  // Directions come nearer to a ray than to a border, because a border is accurate to some digits only.
  const auto nearest = [](bool ray) { return ray ? 25.0 : 12.0; };
  const auto q = [=, length = sector.to - sector.from](double x) {
    return x < 0 ? sector.from + length / (1 + std::exp(-x)) : sector.to - length / (1 + std::exp(x));
  };
  return {q, -nearest(sector.from_ray), nearest(sector.to_ray)};
}

Vector2d vector_of(const State& x) { return {x.u, x.v}; }
Vector2d vector_of(Point x) { return {x.x, x.y}; }

/// Returns the parts of an orbit that lie in a window.
/// @param time_left  returns the time left at a point
std::vector<PortraitOrbit> parts_of(const Polyline& orbit, const Window& window,
                                    const std::function<double(const Vector2d&)>& time_left) {
  std::vector<PortraitOrbit> parts;
  for (const Polyline& line : clipped(panel_of(window), orbit)) {
    if (line.size() < 2) continue;
    PortraitOrbit part = columns(line, infinity);
    for (Eigen::Index i = 0; i < part.rows(); ++i) {
      // A chord may change the order of times in the last digits.
      part.tau_left[i] = std::min(time_left({part.u[i], part.v[i]}), i > 0 ? part.tau_left[i - 1] : infinity);
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Traces orbits in a window.
class PlanarTracer {
 public:
  PlanarTracer(const PlanarReduction& plane, const Window& window)
      : plane_(plane), window_(window), panel_(panel_of(window)) {}
  PlanarTracer(const PlanarTracer&) = delete;
  PlanarTracer& operator=(const PlanarTracer&) = delete;
  virtual ~PlanarTracer() = default;

  /// Returns the parts in the window of the orbit through a point, or of its part after the point.
  std::vector<PortraitOrbit> orbit(const Vector2d& x, bool from_here = false) const {
    return parts_of(line(x, from_here), window_, [this](const Vector2d& at) { return time_left(at); });
  }

  /// Returns the number of the sector that contains a point, 0 without sectors; empty if the field has no value.
  virtual std::optional<std::size_t> sector(const Vector2d& x) const = 0;

  /// Returns the lines of equal time left, and the finite times left on the border of the window, increasing.
  virtual std::vector<Isochrone> isochrones(const std::vector<double>&) const { return {}; }
  virtual std::vector<double> times_at_border() const { return {}; }

 protected:
  virtual Polyline line(const Vector2d& x, bool from_here) const = 0;
  virtual double time_left(const Vector2d&) const { return infinity; }

  const PlanarReduction& plane_;
  Window window_;
  Panel panel_;
};

/// Traces orbits along the directions q of a scaling: each orbit is a scaled copy of the curve of its sector.
class ScaledTracer final : public PlanarTracer {
 public:
  ScaledTracer(const PlanarReduction& plane, const Window& window) : PlanarTracer(plane, window) {
    constexpr int pieces = 100;
    for (int i = 0; i < 4 * pieces; ++i) {
      const double s = static_cast<double>(i % pieces) / pieces;
      const Point places[] = {{s, 0}, {1, s}, {1 - s, 1}, {0, 1 - s}};
      border_.push_back(vector_of(from_paper(panel_, places[i / pieces])));
      const double p = plane.canonical(border_.back()).p;
      if (!std::isfinite(p)) continue;  // the centre
      highest_ = std::max(highest_, p);
      lowest_ = std::min(lowest_, p);
    }
    highest_ += 0.1;
    // Motions nearer to the centre are invisible.
    constexpr double deep = 9;
    lowest_ -= deep / plane.scaling()->growth();
    for (const PlanarSector& sector : plane.sectors()) courses_.push_back(course_of(sector));
    if (plane.turn() != nullptr) read_turn();
  }

  std::optional<std::size_t> sector(const Vector2d& x) const override {
    if (!has_value(x) || x == plane_.centre()) return std::nullopt;
    const double q = plane_.canonical(x).q;
    const std::vector<PlanarSector>& sectors = plane_.sectors();
    for (std::size_t i = 0; i < sectors.size(); ++i) {
      const auto [left, right] = std::minmax(sectors[i].from, sectors[i].to);
      if ((q > left && q < right) || (q + 2 * pi > left && q + 2 * pi < right)) return i;
    }
    if (sectors.empty()) return 0;
    return std::nullopt;
  }

  std::vector<Isochrone> isochrones(const std::vector<double>& times) const override {
    const double c = plane_.scaling()->time;
    std::vector<Isochrone> result;
    if (c == 0 || times.empty()) return result;
    std::vector<Polyline> curves;  // (q, ln of the time left at p = 0)
    const auto add_curve = [&](const Course& course) {
      Polyline curve;
      constexpr int pieces = 400;
      for (int i = 0; i <= pieces; ++i) {
        const double q = course.q(course.low + (course.high - course.low) * i / pieces);
        const double time = time_left(plane_.point(q, 0));
        if (time > 0 && std::isfinite(time)) {
          curve.push_back({q, std::log(time)});
        } else if (!curve.empty()) {
          curves.push_back(std::exchange(curve, {}));
        }
      }
      if (!curve.empty()) curves.push_back(std::move(curve));
    };
    for (const Course& course : courses_) add_curve(course);
    if (plane_.sectors().empty()) add_curve({[](double x) { return x; }, 0, 2 * pi});
    for (double time : times) {
      for (const Polyline& curve : curves) {
        Polyline line;
        for (const Point& at : curve) line.push_back(point(at.x, (std::log(time) - at.y) / c));
        for (const Polyline& part : clipped(panel_, line)) {
          PortraitOrbit line_of_time = columns(part, time);
          result.push_back({time, std::move(line_of_time.u), std::move(line_of_time.v)});
        }
      }
    }
    return result;
  }

  std::vector<double> times_at_border() const override {
    std::vector<double> times;
    for (const Vector2d& x : border_) {
      if (has_value(x) && std::isfinite(time_left(x))) times.push_back(time_left(x));
    }
    std::ranges::sort(times);
    return times;
  }

 private:
  Point point(double q, double p) const {
    const Vector2d x = plane_.point(q, p);
    return {x[0], x[1]};
  }
  bool has_value(const Vector2d& x) const {
    try {
      plane_.end_time(x);
      return true;
    } catch (const std::exception&) {
      return false;
    }
  }
  double time_left(const Vector2d& x) const override {
    try {
      // A picture shows one kind of times: to the centre, or to infinity if motions become slower with distance.
      const reduction::PlanarOrbit orbit = plane_.orbit(x);
      const PlanarEnd timed = plane_.scaling()->time < 0 ? PlanarEnd::infinity : PlanarEnd::centre;
      return orbit.end() == timed ? orbit.end_time() : infinity;
    } catch (const std::domain_error&) {
      return infinity;  // the chord leaves the region in which the field has values
    }
  }
  /// Returns p of the sector's curve at q.
  double level(double q) const { return -plane_.first_integral(plane_.point(q, 0)); }

  void read_turn() {
    constexpr double margin = 1e-9;  // between q = 2 pi and q = 0 level() jumps by its change in a turn
    growth_ = level(2 * pi - margin) - level(margin);
    const Vector2d here = plane_.point(1, level(1)), next = plane_.point(1.001, level(1.001));
    sense_ = plane_.field()(here).dot(next - here) > 0 ? 1 : -1;
  }

  Polyline line(const Vector2d& x, bool from_here) const override {
    if (x == plane_.centre()) return {};
    const auto [q, p, slope] = plane_.canonical(x);
    double integral = 0;
    try {
      integral = plane_.first_integral(x);
    } catch (const std::domain_error&) {
      return ray(q, from_here ? std::optional(p) : std::nullopt, std::nullopt);
    }
    if (plane_.turn() != nullptr) return spiral(q, p, integral, from_here);
    const std::size_t index = sector(x).value();
    const PlanarSector& sector = plane_.sectors()[index];
    const Course& course = courses_[index];
    const auto on_orbit = [&](double x_) { return std::pair(course.q(x_), integral + level(course.q(x_))); };
    // Find the place of the point on the course.
    double fraction = (q - sector.from) / (sector.to - sector.from);
    if (fraction < 0 || fraction > 1) fraction = (q + 2 * pi - sector.from) / (sector.to - sector.from);
    const double here = std::clamp(std::log(fraction / (1 - fraction)), course.low, course.high);
    Polyline line;
    const auto begin = on_orbit(course.low), end = on_orbit(course.high);
    if (!from_here && sector.from_ray && seen(begin.second)) line = ray(sector.from, std::nullopt, begin.second);
    if (!from_here) follow(line, on_orbit, course.low, here);
    line.push_back({x[0], x[1]});
    follow(line, on_orbit, here, course.high);
    if (sector.to_ray && seen(end.second)) {
      const Polyline rest = ray(sector.to, end.second, std::nullopt);
      line.insert(line.end(), rest.begin(), rest.end());
    }
    return line;
  }

  bool seen(double p) const { return p > lowest_ && p < highest_; }

  /// Returns the rate of the distance from the centre on a ray, or its sign alone; negative towards the centre.
  double radial_at(double q) const {
    for (const auto& ray : plane_.rays()) {
      if (std::abs(std::remainder(ray.q - q, 2 * pi)) < 1e-9) return ray.radial;
    }
    return plane_.end(plane_.point(q, 0)) == PlanarEnd::centre ? -1 : 1;
  }

  /// Returns the motion on a ray, between the ends of the visible range or between two values of p.
  Polyline ray(double q, std::optional<double> from, std::optional<double> to) const {
    Polyline line;
    const double radial = radial_at(q);
    if (radial == 0) return line;
    const bool inwards = radial < 0;
    const double begin = from.value_or(inwards ? highest_ : lowest_), end = to.value_or(inwards ? lowest_ : highest_);
    constexpr int pieces = 100;
    for (int i = 0; i <= pieces; ++i) line.push_back(point(q, std::lerp(begin, end, static_cast<double>(i) / pieces)));
    if (inwards && !to) line.push_back({plane_.centre()[0], plane_.centre()[1]});
    return line;
  }

  template <class OnOrbit>
  void follow(Polyline& line, const OnOrbit& on_orbit, double from, double to) const;

  Polyline spiral(double q, double p, double integral, bool from_here) const;

  std::vector<Vector2d> border_;
  double highest_ = -infinity, lowest_ = infinity;  ///< visible range of p
  std::vector<Course> courses_;
  double growth_ = 0;  ///< change of p in a counter-clockwise turn
  double sense_ = 1;   ///< 1: motions turn counter-clockwise, and q grows in time; -1: clockwise
};

/// Appends the orbit between two values of its parameter, such as x of Course, with visibly close points.
template <class OnOrbit>
void ScaledTracer::follow(Polyline& line, const OnOrbit& on_orbit, double from, double to) const {
  const auto at = [&](double x) {
    const auto [q, p] = on_orbit(x);
    return point(q, std::clamp(p, lowest_ - 1, highest_ + 1));
  };
  const auto clamped = [this](Point place) {
    const Point paper = on_paper(panel_, place);
    return Point{std::clamp(paper.x, -1.0, 2.0), std::clamp(paper.y, -1.0, 2.0)};
  };
  constexpr double near = 0.008, step = 0.5;
  const auto distance = [&](Point a, Point b) {
    const Point here = clamped(a), there = clamped(b);
    return std::hypot(here.x - there.x, here.y - there.y) / near;
  };
  std::vector<double> places;
  const int pieces = 1 + static_cast<int>(std::abs(to - from) / step);
  for (int i = 1; i <= pieces; ++i) places.push_back(from + (to - from) * i / pieces);
  line.push_back(at(from));
  refine(line, from, places, at, distance);
  line.back() = at(to);
}

Polyline ScaledTracer::spiral(double q, double p, double integral, bool from_here) const {
  if (q < 0) q += 2 * pi;
  // Returns q and p at an angle that continues over the turns.
  const auto on_orbit = [&](double angle) {
    const double turns = std::floor(angle / (2 * pi)), rest = std::clamp(angle - 2 * pi * turns, 1e-9, 2 * pi - 1e-9);
    return std::pair(rest, integral + level(rest) + growth_ * turns);
  };
  const double shrinking = growth_ * sense_;
  constexpr double most = 12;
  const auto turns = [&](double until) {
    return shrinking == 0 ? 0 : std::clamp(std::ceil(std::abs((until - p) / shrinking)) + 1, 0.0, most);
  };
  Polyline line;
  if (std::abs(growth_) < 1e-9) {
    follow(line, on_orbit, q, q + sense_ * 2 * pi);
    return line;
  }
  if (!from_here) follow(line, on_orbit, q - sense_ * 2 * pi * turns(shrinking < 0 ? highest_ : lowest_), q);
  follow(line, on_orbit, q, q + sense_ * 2 * pi * turns(shrinking < 0 ? lowest_ : highest_));
  return line;
}

/// Traces orbits forwards and backwards in time.
class TimedTracer final : public PlanarTracer {
 public:
  TimedTracer(const PlanarReduction& plane, const Window& window)
      : PlanarTracer(plane, window),
        forth_{plane, reduction::by_steps(plane.field())},
        back_{plane.reversed(), forth_.by_steps.reversed()} {}

  std::optional<std::size_t> sector(const Vector2d& x) const override {
    try {
      if (plane_.field()(x).allFinite()) return 0;
    } catch (const std::exception&) {
    }
    return std::nullopt;
  }

 private:
  /// A system and its orbits by steps in time.
  struct Way {
    PlanarReduction plane, by_steps;
  };

  Polyline line(const Vector2d& x, bool from_here) const override {
    Polyline line;
    if (!from_here) line = follow(back_, x);
    std::ranges::reverse(line);
    line.push_back({x[0], x[1]});
    std::ranges::copy(follow(forth_, x), std::back_inserter(line));
    return line;
  }
  Polyline follow(const Way& way, const Vector2d& x) const;

  Way forth_, back_;
};

/// Follows a motion until it is some window sides beyond the window, because it may return from nearer places.
Polyline TimedTracer::follow(const Way& way, const Vector2d& x) const {
  const Vector2d f = way.plane.field()(x);
  const Vector2d sides = window_.sides();
  const double speed = f.cwiseQuotient(sides).norm();
  if (!(speed > 0)) return {};
  bool stepped = false;
  reduction::PlanarOrbit motion = [&] {
    try {
      return way.plane.part_of_orbit(x);
    } catch (const std::domain_error&) {
      stepped = true;
      return way.by_steps.part_of_orbit(x);
    }
  }();
  constexpr double near = 0.008, far = 6, rest = 1e-5;
  constexpr int most = 4000;
  Polyline line;
  Vector2d here = x;
  double time = 0, step = near / speed;
  const double last = motion.period().value_or(infinity);
  // An orbit that tends to a closed orbit visits the same cells of the picture again and again.
  constexpr int cells = 300, turns = 3;
  std::map<std::pair<int, int>, std::pair<int, int>> visits;  // index of the last point in a cell, and number of visits
  for (int i = 0; i < most && time < last; ++i) {
    const double next = std::min(time + step, last);
    Vector2d there;
    try {
      there = motion.at(next);
    } catch (const std::domain_error&) {
      step /= 2;
      if (step > 1e-6 * near / speed) continue;
      // The reduction ends here, but steps in time may continue the orbit.
      if (std::exchange(stepped, true) || motion.end() != PlanarEnd::undecided) break;
      motion = way.by_steps.part_of_orbit(here);
      time = 0;
      step = 1e-3 * near / speed;
      continue;
    }
    const Vector2d outside = (there - window_.low).cwiseMin(0) + (there - window_.high).cwiseMax(0);
    const double beyond = outside.cwiseQuotient(sides).norm();
    const double moved = (there - here).cwiseQuotient(sides).norm(), allowed = near * (1 + 10 * beyond);
    if (!(moved <= allowed)) {
      step /= 2;
      if (!(time + step > time)) break;
      continue;
    }
    const Vector2d part = (there - window_.low).cwiseQuotient(sides) * cells;
    if (beyond == 0) {
      auto& [when, count] = visits[{static_cast<int>(part[0]), static_cast<int>(part[1])}];
      const bool again = count > 0 && static_cast<int>(line.size()) - when > cells / 10;
      when = static_cast<int>(line.size());
      count += count == 0 || again ? 1 : 0;
      if (count > turns) break;
    }
    line.push_back({there[0], there[1]});
    here = there;
    time = next;
    if (beyond > far) break;
    if (moved < allowed / 2) step *= 1.5;
    if (moved < rest && step * speed > 1e3) break;  // the motion tends to an equilibrium
  }
  return line;
}

/// Returns the orbits that leave or enter the saddles, from points just beside the saddles.
std::vector<PortraitOrbit> separatrices(const PlanarTracer& tracer, const reduction::Equilibria& equilibria,
                                        const Window& window) {
  std::vector<PortraitOrbit> all;
  for (const reduction::Equilibrium& saddle : equilibria.points) {
    // A saddle with an eigenvalue 0 has separatrices, too, but not all are tangent to eigenvectors that are known.
    if (saddle.kind != "saddle" || !saddle.eigenvalues) continue;
    const auto [stable, unstable] = *saddle.eigenvalues;
    if (stable == 0. || unstable == 0.) continue;
    for (const double value : {stable.real(), unstable.real()}) {
      const Matrix2d rest = saddle.slopes - value * Matrix2d::Identity();
      Vector2d along = rest.row(0).norm() > rest.row(1).norm() ? Vector2d(-rest(0, 1), rest(0, 0))
                                                               : Vector2d(-rest(1, 1), rest(1, 0));
      constexpr double beside = 1e-6;
      along *= beside / along.cwiseQuotient(window.sides()).norm();
      for (const Vector2d& x : {Vector2d(saddle.x + along), Vector2d(saddle.x - along)}) {
        if (!tracer.sector(x)) continue;
        std::ranges::move(tracer.orbit(x), std::back_inserter(all));
      }
    }
  }
  return all;
}

/// Returns orbits that fill the window. Each goes through the middle of the widest gap. If the mirror images of an
/// orbit have as much room, they are added, too, because most systems have such a symmetry.
std::vector<PortraitOrbit> filling(const PlanarTracer& tracer, const Window& window, const Vector2d& middle,
                                   std::optional<int> count) {
  const Panel panel = panel_of(window);
  constexpr double gap = 0.055;  // smallest gap that gets an orbit, as a fraction of the window's side
  constexpr int most = 80, across = 41;
  using Gaps = WidestGaps<std::size_t, Vector2d>;
  const auto seed_at = [&](Point place) -> std::optional<Gaps::Seed> {
    const Vector2d x = vector_of(from_paper(panel, place));
    const auto its = tracer.sector(x);
    return its ? std::optional(Gaps::Seed{place, x, *its}) : std::nullopt;
  };
  Gaps gaps(across, across, seed_at, {1, 1});
  std::vector<PortraitOrbit> orbits;
  std::vector<Point> mirrored;  // places to try first
  const Point centre = on_paper(panel, {middle[0], middle[1]});
  for (int traced = 0; traced < count.value_or(most) && !gaps.empty();) {
    auto widest = &gaps.widest();
    bool from_mirror = false;
    while (!mirrored.empty() && !from_mirror) {
      const auto its = &gaps.nearest(mirrored.back());
      mirrored.pop_back();
      from_mirror = its->gap > 0.7 * widest->gap;
      if (from_mirror) widest = its;
    }
    if (!count && widest->gap < gap) break;
    const Point here = widest->place;
    const std::size_t its_sector = widest->sector;
    const Vector2d through = widest->state;
    if (!from_mirror) {
      mirrored = {{here.x, 2 * centre.y - here.y},
                  {2 * centre.x - here.x, here.y},
                  {2 * centre.x - here.x, 2 * centre.y - here.y}};
    }
    ++traced;
    widest->gap = 0;
    for (PortraitOrbit& piece : tracer.orbit(through)) {
      for (Eigen::Index row = 0; row < piece.u.size(); ++row) {
        gaps.pass(its_sector, on_paper(panel, {piece.u[row], piece.v[row]}));
      }
      orbits.push_back(std::move(piece));
    }
    gaps.drop_below(count ? 1e-9 : gap);
  }
  return orbits;
}

Vector2d middle_of(const PlanarReduction& plane) {
  return plane.scaling() ? plane.centre() : Vector2d(Vector2d::Zero());
}

/// Returns the requested window or the default window, and checks the request.
Window window_of(const PlanarReduction& plane, const PortraitRequest& request) {
  if (request.view || request.comparison || request.uncoupled || request.stepped || request.linear ||
      request.drawn_only || request.time_unit != 1) {
    throw std::domain_error("portrait: views, laws, routes, scales and units of time are only for (2.6)");
  }
  const Vector2d middle = middle_of(plane);
  double half = 0;
  const double room = plane.scaling() ? 1.2 : 2.5;
  const auto include = [&](const State& x) {
    half = std::max(half, room * (vector_of(x) - middle).lpNorm<Eigen::Infinity>());
  };
  if (request.highlight) include(*request.highlight);
  std::ranges::for_each(request.through, include);
  const Vector2d half_sides = request.sides.value_or(Vector2d::Constant(half > 0 ? half : 1));
  const Window window = request.window.value_or(Window{middle - half_sides, middle + half_sides});
  if (!(window.sides().minCoeff() > 0) || !window.sides().allFinite() || !window.low.allFinite()) {
    throw std::domain_error(
        fmt::format("portrait: the window must be finite and have two positive sides, got {} to {} by {} to {}",
                    window.low[0], window.high[0], window.low[1], window.high[1]));
  }
  require(request, window);
  return window;
}

}  // namespace

PlanarPortrait planar_portrait(const PlanarReduction& plane, std::string name, const PortraitRequest& request) {
  const Window window = window_of(plane, request);
  PlanarPortrait portrait{{window, {}, {}, 0, {}, {}, request.through}, std::move(name), plane};
  std::unique_ptr<const PlanarTracer> traced;
  if (plane.scaling() != nullptr) {
    traced = std::make_unique<const ScaledTracer>(portrait.plane, window);
  } else {
    traced = std::make_unique<const TimedTracer>(portrait.plane, window);
  }
  const PlanarTracer& tracer = *traced;
  portrait.orbits = filling(tracer, window, middle_of(plane), request.orbits);
  const auto asked = [&](const State& x, bool from_here) {
    plane.end(vector_of(x));  // throws for a point without a value
    return tracer.orbit(vector_of(x), from_here);
  };
  if (request.highlight) portrait.highlight = asked(*request.highlight, true);
  for (const State& x : request.through) std::ranges::move(asked(x, false), std::back_inserter(portrait.through));
  portrait.equilibria = reduction::find_equilibria(plane.field(), window.low, window.high);
  compare_kinds(portrait.equilibria, plane);
  portrait.switching = switching_parts(plane.field(), window.low, window.high);
  leave_out_rests(portrait.equilibria, portrait.switching);
  if (plane.scaling() == nullptr) {
    portrait.separatrices = separatrices(tracer, portrait.equilibria, window);
    for (const reduction::FactorPiece& piece : plane.factor_pieces(window.low, window.high)) {
      for (const Polyline& line : zero_lines(piece, window.sides())) {
        portrait.invariant.push_back(columns(line, infinity));
      }
    }
  }
  const std::vector<double> times = tracer.times_at_border();
  if (!times.empty()) {
    // Next to a ray that leads away from the centre, times are unbounded.
    const double last = 0.95 * std::min(times.back(), 3 * times[times.size() / 2]);
    const auto [at, step] = isochrone_times(request, last);
    portrait.isochrones = tracer.isochrones(at);
    portrait.isochrone_step = step;
  }
  return portrait;
}

}  // namespace contensou::portraits
