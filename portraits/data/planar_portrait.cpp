#include "contensou/portraits/planar_portrait.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "contensou/portraits/layout.hpp"
#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/planar_reduction.hpp"
#include "data/planar_window.hpp"
#include "data/round_numbers.hpp"
#include "data/tracing.hpp"
#include "data/widest_gaps.hpp"

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
    return parts(line(x, from_here));
  }
  std::vector<PortraitOrbit> parts(const Polyline& line) const {
    std::vector<PortraitOrbit> parts;
    for (const Polyline& visible : clipped(panel_, line)) {
      if (visible.size() < 2) continue;
      PortraitOrbit part = columns(visible, infinity);
      for (Eigen::Index i = 0; i < part.rows(); ++i) {
        // A chord may change the order of times in the last digits.
        part.tau_left[i] = std::min(time_left({part.u[i], part.v[i]}), i > 0 ? part.tau_left[i - 1] : infinity);
      }
      parts.push_back(std::move(part));
    }
    return parts;
  }

  /// Returns the parts in the window of an ordinary orbit. It may end early, so that lines do not cover each other.
  virtual std::vector<PortraitOrbit> ordinary(const Vector2d& x) const { return orbit(x); }

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
    if ((sector.to_ray || slides_along(sector.to)) && seen(end.second)) {
      const Polyline rest = ray(sector.to, end.second, std::nullopt);
      line.insert(line.end(), rest.begin(), rest.end());
    }
    return line;
  }

  bool seen(double p) const { return p > lowest_ && p < highest_; }

  /// Returns true if motions meet a jump of the field at this angle and slide along it.
  bool slides_along(double q) const {
    return std::ranges::any_of(plane_.rays(), [&](const reduction::PlanarRay& ray) {
      return std::abs(std::remainder(ray.q - q, 2 * pi)) < 1e-9 && ray.attracts && ray.order == 0 && ray.angular < 0 &&
             std::isinf(ray.angular);
    });
  }

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
  /// @param in_disc  true: motions stay in the disc |x| < 1
  TimedTracer(const PlanarReduction& plane, const Window& window, const std::vector<reduction::LimitCycle>& cycles,
              bool in_disc = false)
      : PlanarTracer(plane, window),
        in_disc_(in_disc),
        forth_{plane, reduction::by_steps(plane.field()), {}, {}},
        back_{plane.reversed(), forth_.by_steps.reversed(), {}, {}} {
    for (const reduction::LimitCycle& cycle : cycles) {
      for (const Vector2d& x : cycle.line) {
        for_cells_about(cell_of(x, coarse), 12, [&](int cell) { beside_cycle_.insert(cell); });
      }
      for (std::size_t i = 1; i < cycle.line.size(); ++i) {
        const Vector2d step = cycle.line[i] - cycle.line[i - 1];
        const int pieces = 1 + static_cast<int>(2 * fine * step.cwiseQuotient(window.sides()).norm());
        for (int k = 0; k < pieces; ++k) {
          Way& way = cycle.stable ? forth_ : back_;
          const int here = cell_of(cycle.line[i - 1] + step * k / pieces, fine);
          for_cells_about(here, 3, [&](int cell) { way.cycles.insert(cell); });
          for_cells_about(here, 1, [&](int cell) { way.on_cycles.insert(cell); });
        }
      }
    }
  }

  /// Returns true if a point beside an equilibrium on the circle lies on the circle, too.
  bool is_on_circle(const Vector2d& x, const Vector2d& equilibrium) const {
    constexpr double flat = 1e-3;
    return in_disc_ && 1 - x.norm() < flat * (x - equilibrium).norm();
  }

  /// Returns the motion from a point on, or the motion before it from the point backwards.
  Polyline branch(const Vector2d& x, bool back) const { return follow(back ? back_ : forth_, x); }

  std::vector<PortraitOrbit> ordinary(const Vector2d& x) const override {
    Polyline line = follow(back_, x, true);
    std::ranges::reverse(line);
    line.push_back({x[0], x[1]});
    std::ranges::copy(follow(forth_, x, true), std::back_inserter(line));
    for (const Point& at : line) {
      if (window_.contains({at.x, at.y})) passed_.insert(cell_of(vector_of(at), coarse));
    }
    return parts(line);
  }

  std::optional<std::size_t> sector(const Vector2d& x) const override {
    if (in_disc_ && x.norm() >= 1) return std::nullopt;
    return rate_of(plane_.field(), x) ? std::optional<std::size_t>(0) : std::nullopt;
  }

 private:
  // The window and its surroundings are divided into cells, which have numbers. Two coarse cells are a visible
  // distance.
  static constexpr int fine = 300, coarse = 150;  ///< cells along a side of the window
  static constexpr int row = 1 << 14;             ///< difference of the numbers of two cells one above the other

  /// A system, its orbits by steps in time, and the fine cells about the limit cycles that its motions near.
  struct Way {
    PlanarReduction plane, by_steps;
    std::unordered_set<int> cycles, on_cycles;  ///< fine cells beside limit cycles that attract, and on them
  };

  int cell_of(const Vector2d& x, int cells) const {
    const Vector2d place = (x - window_.low).cwiseQuotient(window_.sides()).cwiseMax(-9).cwiseMin(9) * cells;
    return row * static_cast<int>(std::floor(place[1])) + static_cast<int>(std::floor(place[0]));
  }
  /// Calls a function for the cells about a cell.
  template <class Function>
  static void for_cells_about(int cell, int around, const Function& function) {
    for (int i = -around; i <= around; ++i) {
      for (int j = -around; j <= around; ++j) function(cell + row * i + j);
    }
  }

  Polyline line(const Vector2d& x, bool from_here) const override {
    Polyline line;
    if (!from_here) line = follow(back_, x);
    std::ranges::reverse(line);
    line.push_back({x[0], x[1]});
    std::ranges::copy(follow(forth_, x, false, from_here), std::back_inserter(line));
    return line;
  }
  /// @param onto_cycle  true: a motion is followed until it and a limit cycle are one line
  Polyline follow(const Way& way, const Vector2d& x, bool is_ordinary = false, bool onto_cycle = false) const;

  bool in_disc_;
  Way forth_, back_;
  std::unordered_set<int> beside_cycle_ = {};    ///< coarse cells about limit cycles, which all orbits come near
  mutable std::unordered_set<int> passed_ = {};  ///< coarse cells of ordinary orbits
};

/// Finds where an ordinary orbit becomes useless in a picture: beside a cycle where it follows another orbit, and
/// where it follows its own last turn for a whole turn.
class Crowding {
 public:
  /// Adds the next point.
  /// @param cell        its coarse cell; empty outside the window
  /// @param neighbours  calls its argument for the coarse cells about the point
  template <class Neighbours>
  void add(std::optional<int> cell, bool beside_other, const Neighbours& neighbours) {
    ++index_;
    followed_ = beside_other ? followed_ + 1 : 0;
    if (!cell || cell == cell_) return;
    cell_ = cell;
    constexpr int apart = 12;
    int nearest = -1;
    neighbours([&](int other) {
      const auto last = last_.find(other);
      if (last != last_.end() && index_ - last->second > apart) nearest = std::max(nearest, last->second);
    });
    last_[*cell] = index_;
    if (nearest < 0) {
      since_ = index_;
    } else {
      turn_ = index_ - nearest;
    }
  }
  bool ends() const { return follows_other() || index_ - since_ > turn_ / 4; }
  bool follows_other() const { return followed_ > most; }
  static constexpr int most = 15;  ///< points beside another orbit

 private:
  std::unordered_map<int, int> last_;  ///< number of the last point in a cell
  std::optional<int> cell_;
  int index_ = 0, since_ = 0, turn_ = 1 << 30, followed_ = 0;
};

/// Follows a motion until it is some window sides beyond the window, because it may return from nearer places.
Polyline TimedTracer::follow(const Way& way, const Vector2d& x, bool is_ordinary, bool onto_cycle) const {
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
  // Beside a saddle the motion becomes faster: a longer first step could pass over a whole loop to the saddle.
  constexpr double first = 1e-4;
  double time = 0, step = (is_ordinary ? 1 : first) * near / speed;
  const double last = motion.period().value_or(infinity);
  // An orbit that tends to a closed orbit visits the same cells of the picture again and again.
  constexpr int turns = 3;
  std::unordered_map<int, std::pair<int, int>> visits;  // index of the last point in a cell, and number of visits
  const auto& cycles = onto_cycle ? way.on_cycles : way.cycles;
  bool apart = !cycles.contains(cell_of(x, fine));
  Crowding crowding;
  for (int i = 0; i < most && time < last; ++i) {
    const double next = std::min(time + step, last);
    Vector2d there;
    try {
      there = motion.at(next);
    } catch (const std::domain_error&) {
      step /= 2;
      if (step > 1e-6 * near / speed) continue;
      // The reduction ends here, but steps in time may continue the orbit.
      const PlanarEnd end = motion.end();
      const bool ends = end == PlanarEnd::border || end == PlanarEnd::infinity || end == PlanarEnd::rest;
      // Where rounding decides, as beside a saddle, steps continue another orbit.
      if (std::exchange(stepped, true) || ends || motion.undecided().starts_with("rounding")) break;
      motion = way.by_steps.part_of_orbit(here);
      time = 0;
      step = 1e-3 * near / speed;
      continue;
    }
    if (in_disc_ && there.norm() >= 1) break;  // rounding has carried the motion across the circle
    const Vector2d outside = (there - window_.low).cwiseMin(0) + (there - window_.high).cwiseMax(0);
    const double beyond = outside.cwiseQuotient(sides).norm();
    const double moved = (there - here).cwiseQuotient(sides).norm(), allowed = near * (1 + 10 * beyond);
    if (!(moved <= allowed)) {
      step /= 2;
      if (!(time + step > time)) break;
      continue;
    }
    // The cycle itself is drawn, so the orbit ends before it covers the cycle.
    const int cell = cell_of(there, fine);
    const bool at_cycle = cycles.contains(cell);
    if (apart && at_cycle) break;
    apart = !at_cycle;
    if (beyond == 0) {
      auto& [when, count] = visits[cell];
      const bool again = count > 0 && static_cast<int>(line.size()) - when > fine / 10;
      when = static_cast<int>(line.size());
      count += count == 0 || again ? 1 : 0;
      if (count > turns) break;
    }
    line.push_back({there[0], there[1]});
    here = there;
    time = next;
    if (is_ordinary) {
      const auto place = beyond == 0 ? std::optional(cell_of(here, coarse)) : std::nullopt;
      bool beside_other = false;
      if (place && beside_cycle_.contains(*place)) {
        for_cells_about(*place, 1, [&](int near_by) { beside_other = beside_other || passed_.contains(near_by); });
      }
      crowding.add(place, beside_other, [&](const auto& look) { for_cells_about(*place, 1, look); });
      if (crowding.follows_other()) line.resize(line.size() - std::min<std::size_t>(line.size(), Crowding::most));
      if (crowding.ends()) break;
    }
    if (beyond > far) break;
    if (moved < allowed / 2) step *= 1.5;
    if (moved < rest && step * speed > 1e3) break;  // the motion tends to an equilibrium
  }
  return line;
}

/// A motion along a manifold of a saddle, from the saddle on. A motion along a stable manifold is traced backwards.
struct SaddleBranch {
  std::size_t saddle;
  bool stable;
  Polyline line;
  std::size_t to = 0;  ///< number of the saddle at the other end, if the branch joins two saddles
  bool joins = false;
};

/// Returns the direction of the eigenvector of an eigenvalue, with the length of a fraction of the window.
Vector2d eigenvector(const reduction::Equilibrium& point, double value, double part, const Window& window) {
  const Matrix2d rest = point.slopes - value * Matrix2d::Identity();
  const Vector2d along =
      rest.row(0).norm() > rest.row(1).norm() ? Vector2d(-rest(0, 1), rest(0, 0)) : Vector2d(-rest(1, 1), rest(1, 0));
  return part / along.cwiseQuotient(window.sides()).norm() * along;
}

/// Returns the motions that leave or enter the saddles and degenerate equilibria, from points just beside them.
std::vector<SaddleBranch> branches_of(const TimedTracer& tracer, const reduction::SmoothField& field,
                                      const reduction::Equilibria& equilibria, const Window& window) {
  std::vector<SaddleBranch> all;
  for (std::size_t i = 0; i < equilibria.points.size(); ++i) {
    const reduction::Equilibrium& saddle = equilibria.points[i];
    const auto follow = [&](const Vector2d& x, bool stable) {
      if (!tracer.sector(x) || tracer.is_on_circle(x, saddle.x)) return;
      SaddleBranch branch{i, stable, {{saddle.x[0], saddle.x[1]}}};
      std::ranges::copy(tracer.branch(x, stable), std::back_inserter(branch.line));
      all.push_back(std::move(branch));
    };
    const auto is_one_of = [&](std::initializer_list<std::string_view> kinds) {
      return std::ranges::find(kinds, saddle.kind) != kinds.end();
    };
    if (!saddle.eigenvalues || !is_one_of({"saddle", "saddle-node", "cusp", "degenerate"})) continue;
    const double values[] = {saddle.eigenvalues->first.real(), saddle.eigenvalues->second.real()};
    const int zeros = (values[0] == 0 ? 1 : 0) + (values[1] == 0 ? 1 : 0);
    if (saddle.eigenvalues->first.imag() != 0) continue;
    if (zeros == 2) {
      for (const reduction::SeparatrixPoint& point :
           reduction::degenerate_separatrices(field, saddle.x, window.sides())) {
        follow(point.x, point.stable);
      }
      continue;
    }
    if (is_one_of({"cusp", "degenerate"})) continue;
    constexpr double beside = 1e-6;
    for (const double value : values) {
      if (value == 0) continue;
      const Vector2d along = eigenvector(saddle, value, beside, window);
      follow(saddle.x + along, value < 0);
      follow(saddle.x - along, value < 0);
    }
    if (zeros == 0) continue;
    // On the sides on which the saddle repels, along the eigenvector of 0, motions that run in the sense in which the
    // other eigenvalue attracts tend to the separatrix.
    constexpr double from = 2e-3;
    const bool back = values[0] + values[1] > 0;
    const Vector2d along = eigenvector(saddle, 0, from, window);
    for (const Vector2d& x : {Vector2d(saddle.x + along), Vector2d(saddle.x - along)}) {
      if (!tracer.sector(x)) continue;
      const Polyline line = tracer.branch(x, back);
      constexpr double left = 10;
      if (std::ranges::any_of(line, [&](Point at) {
            return (vector_of(at) - saddle.x).cwiseQuotient(window.sides()).norm() > left * from;
          }))
        follow(x, back);
    }
  }
  return all;
}

/// Ends branches at the saddle that they come to, and leaves out the second branch of each connection. A connection
/// is certain if the unstable branch of one saddle comes to the other, and the stable branch of the other to the first.
void join_branches(std::vector<SaddleBranch>& branches, const reduction::Equilibria& equilibria, const Window& window) {
  constexpr double left = 0.02, arrived = 3e-4;  // fractions of the window
  const auto distance = [&](Point a, std::size_t saddle) {
    return (vector_of(a) - equilibria.points[saddle].x).cwiseQuotient(window.sides()).norm();
  };
  std::vector<std::optional<std::size_t>> ends;  // index of the point at which a branch comes to a saddle
  for (SaddleBranch& branch : branches) {
    std::optional<std::size_t>& end = ends.emplace_back();
    std::optional<std::size_t> border;  // index of the first point outside the window
    bool away = false;
    for (std::size_t k = 0; k < branch.line.size() && !end; ++k) {
      const Point& here = branch.line[k];
      away |= distance(here, branch.saddle) > left;
      if (!border && !window.contains({here.x, here.y})) border = k;
      for (const SaddleBranch& other : branches) {
        if (end || !away || other.stable == branch.stable || !(distance(here, other.saddle) < arrived)) continue;
        end = k;
        branch.to = other.saddle;
      }
    }
    if (!end || !border) continue;
    // Outside the window the branch has passed another saddle. Behind it, rounding has chosen the side.
    branch.line.resize(*border + 1);
    end.reset();
  }
  for (std::size_t i = 0; i < branches.size(); ++i) {
    SaddleBranch& out = branches[i];
    if (out.stable || !ends[i]) continue;
    for (std::size_t j = 0; j < branches.size() && !out.joins; ++j) {
      SaddleBranch& in = branches[j];
      if (!in.stable || !ends[j] || in.saddle != out.to || in.to != out.saddle || in.line.empty()) continue;
      // Both run along one curve: the middle of one lies near the other.
      const Vector2d middle = vector_of(in.line[*ends[j] / 2]);
      if (std::ranges::none_of(out.line, [&](Point at) {
            return (vector_of(at) - middle).cwiseQuotient(window.sides()).norm() < left;
          })) {
        continue;
      }
      out.joins = true;
      out.line.resize(*ends[i]);
      const Vector2d& saddle = equilibria.points[out.to].x;
      out.line.push_back({saddle[0], saddle[1]});
      in.line.clear();
    }
  }
  std::erase_if(branches, [](const SaddleBranch& branch) { return branch.line.empty(); });
}

Vector2d middle_of(const PlanarReduction& plane) {
  return plane.scaling() ? plane.centre() : Vector2d(Vector2d::Zero());
}

/// Returns a point ahead of the end of a line.
/// @param distance  in sides of the window
Vector2d ahead_of(const Window& window, const Vector2d& end, const Vector2d& before, double distance) {
  const Vector2d sides = window.sides();
  return end + distance * (end - before).cwiseQuotient(sides).stableNormalized().cwiseProduct(sides);
}

/// Returns a point just beyond the end of an orbit at which the motion would turn back, because the field has a pole
/// there, as y' = -x/y at y = 0. The orbit beyond continues the solution curve.
std::optional<Vector2d> beyond_pole(const PlanarReduction& plane, const Window& window, Point end, Point before) {
  constexpr double near = 0.004, opposite = -0.9;  // at a jump rates are opposite, too, but do not grow
  const auto at = [&](double distance) { return ahead_of(window, vector_of(end), vector_of(before), distance); };
  const Vector2d beyond = at(near);
  const auto here = rate_of(plane.field(), at(-near)), there = rate_of(plane.field(), beyond);
  const auto farther = rate_of(plane.field(), at(4 * near));
  if (!window.contains({beyond[0], beyond[1]}) || !here || !there || !farther) return std::nullopt;
  const bool turns = here->normalized().dot(there->normalized()) < opposite;
  return turns && there->norm() > 2 * farther->norm() ? std::optional(beyond) : std::nullopt;
}

/// Returns orbits that fill the window. Each goes through the middle of the widest gap. If the mirror images of an
/// orbit have as much room, they are added, too, because most systems have such a symmetry.
/// @param drawn  other lines of the picture, which need room, too
std::vector<PortraitOrbit> filling(const PlanarTracer& tracer, const PlanarReduction& plane, const Window& window,
                                   std::optional<int> count, const std::vector<Polyline>& drawn) {
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
  for (const Polyline& line : drawn) {
    for (const Point& at : line) gaps.pass(0, on_paper(panel, at));
  }
  std::vector<PortraitOrbit> orbits;
  std::vector<Point> mirrored;  // places to try first
  const Vector2d middle = middle_of(plane);
  const Point centre = on_paper(panel, {middle[0], middle[1]});
  const auto is_drawn_to = [&](const Vector2d& x) {
    constexpr double near = 0.0045;  // a little more than in beyond_pole
    return std::ranges::any_of(orbits, [&](const PortraitOrbit& orbit) {
      const Eigen::Index last = orbit.rows() - 1;
      return std::min(paper_distance(panel, {x[0], x[1]}, {orbit.u[0], orbit.v[0]}),
                      paper_distance(panel, {x[0], x[1]}, {orbit.u[last], orbit.v[last]})) < near;
    });
  };
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
    std::vector<Vector2d> open{widest->state};
    if (!from_mirror) {
      mirrored = {{here.x, 2 * centre.y - here.y},
                  {2 * centre.x - here.x, here.y},
                  {2 * centre.x - here.x, 2 * centre.y - here.y}};
    }
    ++traced;
    widest->gap = 0;
    while (!open.empty()) {
      const Vector2d through = open.back();
      const auto its_sector = tracer.sector(through);
      open.pop_back();
      if (!its_sector) continue;
      for (PortraitOrbit& piece : tracer.ordinary(through)) {
        const auto at = [&](Eigen::Index row) { return Point{piece.u[row], piece.v[row]}; };
        const Eigen::Index last = piece.rows() - 1;
        for (Eigen::Index row = 0; row <= last; ++row) gaps.pass(*its_sector, on_paper(panel, at(row)));
        for (const auto& [end, before] : {std::pair{Eigen::Index{0}, Eigen::Index{1}}, {last, last - 1}}) {
          const auto beyond = beyond_pole(plane, window, at(end), at(before));
          constexpr double crowded = 0.05;  // distance at which the turns of spirals would cover each other
          const bool is_free = !plane.scaling() || paper_distance(panel, at(end), {middle[0], middle[1]}) > crowded;
          if (beyond && is_free && !is_drawn_to(*beyond)) open.push_back(*beyond);
        }
        orbits.push_back(std::move(piece));
      }
    }
    gaps.drop_below(count ? 1e-9 : gap);
  }
  return orbits;
}

/// Returns a chosen view, wider by a margin, by the separatrices and by the orbit of the start. Lines that go far from
/// the view do not count.
Window widened(const PlanarReduction& plane, const PlanarView& view, const PortraitRequest& request) {
  const Vector2d sides = view.window.sides();
  const Window room{view.window.low - sides, view.window.high + sides};
  const PlanarReduction steps = reduction::by_steps(plane.field());
  const TimedTracer tracer(steps, room, view.cycles);
  std::vector<Polyline> lines;
  const reduction::Equilibria equilibria = reduction::find_equilibria(plane.field(), view.window.low, view.window.high);
  for (SaddleBranch& branch : branches_of(tracer, plane.field(), equilibria, room))
    lines.push_back(std::move(branch.line));
  Window window = view.window;
  const auto include = [&](const Polyline& line, const Window& within) {
    Window around{window};
    for (const Point& at : line) around = united(around, vector_of(at));
    bool stays = true;
    for (int axis = 0; axis < 2; ++axis) {
      stays &= view.periodic[static_cast<std::size_t>(axis)] ||
               (around.low[axis] >= within.low[axis] && around.high[axis] <= within.high[axis]);
    }
    if (stays) window = around;
  };
  for (const Polyline& line : lines) include(line, room);
  if (request.highlight && tracer.sector(vector_of(*request.highlight))) {
    constexpr double farther = 30;
    const Window wide{view.window.low - farther * sides, view.window.high + farther * sides};
    include(TimedTracer(steps, wide, view.cycles).branch(vector_of(*request.highlight), false), wide);
  }
  constexpr double margin = 0.08;
  for (int axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double added = margin * window.sides()[axis];
    window.low[axis] = view.periodic[i] || view.fixed_low[i] ? view.window.low[axis] : window.low[axis] - added;
    window.high[axis] = view.periodic[i] ? view.window.high[axis] : window.high[axis] + added;
  }
  return window;
}

/// Adds the parts of a line on which a condition holds.
/// @param holds  function of the index of a point
template <class Holds>
void add_parts(std::vector<Polyline>& lines, const Polyline& line, const Holds& holds) {
  Polyline part;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && holds(i)) {
      part.push_back(line[i]);
    } else if (part.size() > 1) {
      lines.push_back(std::exchange(part, {}));
    } else {
      part.clear();
    }
  }
}

/// Returns the parts of a window's curves f = 0 on which a condition holds, for one component of the field.
template <class Holds>
std::vector<PortraitOrbit> zero_curves(const reduction::SmoothField& field, int component, const Window& window,
                                       const Holds& holds) {
  const auto value = [&](const Vector2d& x) {
    const auto rate = rate_of(field, x);
    return rate ? (*rate)[component] : std::numeric_limits<double>::quiet_NaN();
  };
  std::vector<Polyline> parts;
  for (const Polyline& line : zero_lines({window.low, window.high, value}, window.sides()))
    add_parts(parts, line, [&](std::size_t i) { return holds(vector_of(line[i])); });
  std::vector<PortraitOrbit> curves;
  for (const Polyline& part : parts) curves.push_back(columns(part, infinity));
  return curves;
}

/// Returns true if the motion at a point of a line runs along the line, as on a curve V = 0. Where such curves are
/// closer together than the grid that finds them, a line joins points of several curves.
bool runs_along(const reduction::SmoothField& field, const Polyline& line, std::size_t i) {
  constexpr double steepest = 0.2;
  const Vector2d here = vector_of(line[i]);
  const auto rate = rate_of(field, here);
  const auto along = [&](std::size_t k) {
    const Vector2d way = k < line.size() ? Vector2d(vector_of(line[k]) - here) : Vector2d(0, 0);
    return std::abs(way[0] * (*rate)[1] - way[1] * (*rate)[0]) <= steepest * way.norm() * rate->norm();
  };
  return !rate || (along(i + 1) && along(i - 1));
}

/// Returns the curves of equilibria in a window.
std::vector<PortraitOrbit> curves_of_equilibria(const reduction::SmoothField& field, const Window& window) {
  double largest = 0;
  constexpr int across = 7;
  const auto speed = [&](const Vector2d& x) {
    const auto rate = rate_of(field, x);
    return rate ? rate->norm() : infinity;
  };
  for (int i = 0; i < across * across; ++i) {
    const int column = i % across, row = i / across;
    const double at =
        speed(window.low + Vector2d((column + 0.41) / across, (row + 0.43) / across).cwiseProduct(window.sides()));
    if (std::isfinite(at)) largest = std::max(largest, at);
  }
  constexpr double zero = 1e-6;
  const auto vanishes = [&](const Vector2d& x) { return speed(x) <= zero * largest; };
  std::vector<PortraitOrbit> curves = zero_curves(field, 0, window, vanishes);
  return curves.empty() ? zero_curves(field, 1, window, vanishes) : curves;
}

/// Returns the requested window or the default window, and checks the request.
/// @param shown  the view that may be requested, if any
PlanarView view_of(const PlanarReduction& plane, const PortraitRequest& request, std::optional<View> shown = {}) {
  if ((request.view && request.view != shown) || request.comparison || request.uncoupled || request.stepped ||
      request.linear || request.drawn_only || request.time_unit != 1) {
    throw std::domain_error("portrait: views, laws, routes, scales and units of time are only for (2.6)");
  }
  PlanarView view{request.window.value_or(Window{{0, 0}, {1, 1}})};
  const Vector2d middle = middle_of(plane);
  std::vector<Vector2d> points;
  for (const State& x : request.through) points.push_back(vector_of(x));
  if (request.highlight) points.insert(points.begin(), vector_of(*request.highlight));
  if (request.sides && !request.window) {
    view.window = {middle - *request.sides, middle + *request.sides};
  } else if (!request.window && plane.scaling() != nullptr) {
    double half = 0;
    constexpr double room = 1.2;
    for (const Vector2d& x : points) half = std::max(half, room * (x - middle).lpNorm<Eigen::Infinity>());
    const Vector2d sides = Vector2d::Constant(half > 0 ? half : 1);
    view.window = {middle - sides, middle + sides};
  } else if (!request.window && std::ranges::all_of(points, [](const Vector2d& x) { return x.allFinite(); })) {
    view = chosen_view(plane, points);
    view.window = widened(plane, view, request);
  }
  const Window& window = view.window;
  if (!(window.sides().minCoeff() > 0) || !window.sides().allFinite() || !window.low.allFinite()) {
    throw std::domain_error(
        fmt::format("portrait: the window must be finite and have two positive sides, got {} to {} by {} to {}",
                    window.low[0], window.high[0], window.low[1], window.high[1]));
  }
  require(request, window);
  if ((request.window || request.sides) && plane.scaling() == nullptr) view.cycles = cycles_within(plane, window);
  return view;
}

}  // namespace

namespace {

/// Returns the invariant curves V = 0 in a window. An invariant curve ends at the border, at an equilibrium, at a jump,
/// or where the field has no value. Lines that end elsewhere are left out: either V is another one beyond, as V that is
/// quadratic in y may be, or rounding made V = 0.
std::vector<Polyline> invariant_lines(const PlanarReduction& plane, const Window& window,
                                      const reduction::Equilibria& equilibria) {
  std::vector<Polyline> lines;
  for (const reduction::FactorPiece& piece : plane.factor_pieces(window.low, window.high))
    for (const Polyline& line : zero_lines(piece, window.sides()))
      add_parts(lines, line, [&](std::size_t i) { return runs_along(plane.field(), line, i); });
  constexpr double near = 0.02, alike = 0.5;
  const auto at_one_place = [&](const Vector2d& a, const Vector2d& b) {
    return (a - b).cwiseQuotient(window.sides()).norm() < near;
  };
  // The other end of a closed curve is at its end.
  const auto ends_well = [&](const Vector2d& end, const Vector2d& before) {
    const Vector2d beyond = ahead_of(window, end, before, near);
    if (!window.contains({beyond[0], beyond[1]})) return true;
    for (const reduction::Equilibrium& each : equilibria.points) {
      if (at_one_place(end, each.x)) return true;
    }
    const auto meets = [&](const Point& other) { return at_one_place(end, vector_of(other)); };
    if (std::ranges::count_if(lines, [&](const Polyline& line) { return meets(line.front()); }) +
            std::ranges::count_if(lines, [&](const Polyline& line) { return meets(line.back()); }) >
        1)
      return true;
    const auto here = rate_of(plane.field(), before), there = rate_of(plane.field(), beyond);
    return !here || !there || here->normalized().dot(there->normalized()) < alike;
  };
  for (bool removed = true; std::exchange(removed, false);) {
    for (std::size_t k = lines.size(); k-- > 0;) {
      const Polyline& line = lines[k];
      const std::size_t last = line.size() - 1;
      if (ends_well(vector_of(line[0]), vector_of(line[1])) &&
          ends_well(vector_of(line[last]), vector_of(line[last - 1])))
        continue;
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(k));
      removed = true;
    }
  }
  return lines;
}

/// Computes the portrait in a view.
/// @param disc  the Poincaré disc, if the field is that of the disc; else null
PlanarPortrait portrait_in(PlanarView view, const PlanarReduction& plane, std::string name,
                           const PortraitRequest& request, const reduction::PoincareDisc* disc = nullptr) {
  const Window& window = view.window;
  const auto equilibria_beside = [&](const Vector2d& beside) {
    if (disc == nullptr) return reduction::find_equilibria(plane.field(), window.low - beside, window.high + beside);
    reduction::Equilibria all = disc->equilibria;
    all.points.insert(all.points.end(), disc->at_infinity.begin(), disc->at_infinity.end());
    return all;
  };
  PlanarPortrait portrait{{window, {}, {}, 0, {}, {}, request.through}, std::move(name), plane};
  portrait.cycles = std::move(view.cycles);
  portrait.equilibria = equilibria_beside(Vector2d::Zero());
  if (disc == nullptr) compare_kinds(portrait.equilibria, plane);
  portrait.switching = switching_parts(plane.field(), window.low, window.high);
  leave_out_rests(portrait.equilibria, portrait.switching);
  std::unique_ptr<const PlanarTracer> traced;
  std::vector<Polyline> drawn;  // lines beside which ordinary orbits are not needed
  if (plane.scaling() != nullptr) {
    traced = std::make_unique<const ScaledTracer>(portrait.plane, window);
  } else {
    auto timed = std::make_unique<const TimedTracer>(portrait.plane, window, portrait.cycles, disc != nullptr);
    for (const reduction::LimitCycle& cycle : portrait.cycles) {
      Polyline& line = drawn.emplace_back();
      for (const Vector2d& x : cycle.line) line.push_back({x[0], x[1]});
    }
    // Separatrices of equilibria beside the window cross the window, too.
    const reduction::Equilibria around = equilibria_beside(window.sides() / 2);
    std::vector<SaddleBranch> branches = branches_of(*timed, plane.field(), around, window);
    join_branches(branches, around, window);
    for (SaddleBranch& branch : branches) {
      if (branch.stable) std::ranges::reverse(branch.line);
      for (PortraitOrbit& part : timed->parts(branch.line)) {
        portrait.separatrices.push_back({std::move(part), branch.joins    ? "connection"
                                                          : branch.stable ? "stable"
                                                                          : "unstable"});
      }
      drawn.push_back(std::move(branch.line));
    }
    for (const Polyline& line : invariant_lines(plane, window, portrait.equilibria))
      portrait.invariant.push_back(columns(line, infinity));
    traced = std::move(timed);
  }
  if (portrait.equilibria.on_curve) {
    const auto inside = [&](const Vector2d& x) -> Vector2d {
      constexpr double circle = 0.999;
      const bool holds = disc == nullptr || x.norm() < circle;
      return holds ? plane.field()(x) : Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
    };
    portrait.lines_of_equilibria = curves_of_equilibria(reduction::SmoothField(inside), window);
  }
  const PlanarTracer& tracer = *traced;
  portrait.orbits = filling(tracer, plane, window, request.orbits, drawn);
  const auto asked = [&](const State& x, bool from_here) {
    plane.end(vector_of(x));  // throws for a point without a value
    return tracer.orbit(vector_of(x), from_here);
  };
  if (request.highlight) portrait.highlight = asked(*request.highlight, true);
  for (const State& x : request.through) std::ranges::move(asked(x, false), std::back_inserter(portrait.through));
  if (request.nullclines) {
    for (int i : {0, 1}) {
      portrait.nullclines[static_cast<std::size_t>(i)] =
          zero_curves(disc ? disc->plain : plane.field(), i, window,
                      [&](const Vector2d& x) { return disc == nullptr || x.norm() < 1; });
    }
  }
  const std::vector<double> times = tracer.times_at_border();
  if (!times.empty() && !is_slope_field(plane.field(), window)) {
    // Next to a ray that leads away from the centre, times are unbounded.
    const double last = 0.95 * std::min(times.back(), 3 * times[times.size() / 2]);
    const auto [at, step] = isochrone_times(request, last);
    portrait.isochrones = tracer.isochrones(at);
    portrait.isochrone_step = step;
  }
  return portrait;
}

}  // namespace

PlanarPortrait portrait_on_disc(const PlanarReduction& plane, std::string name, const PortraitRequest& request) {
  const PlanarView flat = view_of(plane, request, View::disc);
  // The radius is a round number, and what the usual window shows lies well inside the circle.
  const Window& window = flat.window;
  constexpr double part = 1.5;
  const double largest = window.low.cwiseAbs().cwiseMax(window.high.cwiseAbs()).maxCoeff();
  reduction::PoincareDisc disc = reduction::poincare_disc(plane.field(), round_down(part * largest));
  const auto onto = [&](const Vector2d& x) { return disc.onto(x); };
  const auto from = [&](const Vector2d& X) {
    constexpr double highest = 1 - 1e-9;  // about a thousand million times the radius
    return disc.from(X.norm() > highest ? X * (highest / X.norm()) : X);
  };
  // The proofs that a point is a center need the plane.
  reduction::Equilibria in_plane = disc.equilibria;
  in_plane.low = window.low;
  in_plane.high = window.high;
  for (reduction::Equilibrium& each : in_plane.points) each.x = from(each.x);
  if (in_plane.on_curve) in_plane.on_curve = from(*in_plane.on_curve);
  compare_kinds(in_plane, plane);
  in_plane.low = Vector2d::Constant(-infinity);
  in_plane.high = Vector2d::Constant(infinity);
  for (std::size_t i = 0; i < in_plane.points.size(); ++i) disc.equilibria.points[i].kind = in_plane.points[i].kind;

  PortraitRequest on_disc = request;
  const auto move = [&](State& x) {
    const Vector2d X = onto(vector_of(x));
    x = {X[0], X[1]};
  };
  if (on_disc.highlight) move(*on_disc.highlight);
  std::ranges::for_each(on_disc.through, move);
  PlanarView round{{Vector2d(-1, -1), Vector2d(1, 1)}, flat.cycles};
  for (reduction::LimitCycle& cycle : round.cycles) std::ranges::transform(cycle.line, cycle.line.begin(), onto);
  constexpr double fine = 1e-9;  // tolerance of steps; the picture shows less
  PlanarPortrait portrait =
      portrait_in(std::move(round), reduction::by_steps(disc.field, fine), std::move(name), on_disc, &disc);

  const auto unroll = [&](PortraitOrbit& line) {
    for (Eigen::Index i = 0; i < line.rows(); ++i) {
      const Vector2d x = from({line.u[i], line.v[i]});
      line.u[i] = x[0];
      line.v[i] = x[1];
    }
  };
  for (std::vector<PortraitOrbit>* lines :
       {&portrait.orbits, &portrait.highlight, &portrait.through, &portrait.lines_of_equilibria,
        &portrait.nullclines[0], &portrait.nullclines[1]}) {
    std::ranges::for_each(*lines, unroll);
  }
  std::ranges::for_each(portrait.separatrices, unroll);
  portrait.window = window;
  portrait.points = request.through;
  portrait.cycles = flat.cycles;
  portrait.plane = plane;
  portrait.equilibria = std::move(in_plane);
  portrait.disc = std::move(disc);
  return portrait;
}

PlanarPortrait planar_portrait(const PlanarReduction& plane, std::string name, const PortraitRequest& request) {
  return portrait_in(view_of(plane, request), plane, std::move(name), request);
}

}  // namespace contensou::portraits
