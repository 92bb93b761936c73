#include "data/planar_window.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "contensou/portraits/planar_portrait.hpp"
#include "contensou/reduction/detail/infinity.hpp"

namespace contensou::portraits {

using Eigen::Vector2d;
using reduction::Equilibria;
using reduction::Equilibrium;

std::optional<Vector2d> rate_of(const reduction::SmoothField& field, const Vector2d& x) {
  try {
    const Vector2d f = field(x);
    return f.allFinite() ? std::optional(f) : std::nullopt;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

namespace {

/// Returns true if f(map(x)) = sign * f(x), component by component, at points of a rectangle about the origin.
template <class Map>
bool maps_onto_itself(const reduction::SmoothField& field, const Vector2d& half, const Map& map, const Vector2d& sign) {
  constexpr int across = 6;
  constexpr double rounding = 1e-9;
  int compared = 0;
  for (int i = 0; i < across * across; ++i) {
    const int column = i % across, row = i / across;
    const Vector2d place(-0.93 + 0.37 * column, -0.91 + 0.36 * row);
    const Vector2d x = place.cwiseProduct(half);
    const auto here = rate_of(field, x), there = rate_of(field, map(x));
    if (here && there && !((sign.cwiseProduct(*here) - *there).norm() <= rounding * here->norm())) return false;
    compared += here && there ? 1 : 0;
  }
  return compared > across;
}

/// Returns equilibria of squares about the origin. Beyond about a dozen, more of them would hide each other.
Equilibria equilibria_about_origin(const reduction::SmoothField& field) {
  constexpr std::size_t most = 12;
  Equilibria all{{}, Vector2d::Ones(), -Vector2d::Ones()};
  for (const double half : {2., 16., 128., 1024.}) {
    const Equilibria found = reduction::find_equilibria(field, Vector2d(-half, -half), Vector2d(half, half));
    if (found.points.size() > most && all.points.size() > 4) break;
    std::ranges::copy_if(found.points, std::back_inserter(all.points),
                         [&](const Equilibrium& each) { return each.x.lpNorm<Eigen::Infinity>() > all.high[0]; });
    if (!all.on_curve) all.on_curve = found.on_curve;
    all.low = found.low;
    all.high = found.high;
  }
  return all;
}

/// Returns the period of the field along an axis, one of the distances between equilibria; empty if there is none.
std::optional<double> period_along(int axis, const reduction::SmoothField& field, const Equilibria& equilibria) {
  constexpr double same = 1e-6;
  std::vector<double> distances;
  for (const Equilibrium& one : equilibria.points) {
    for (const Equilibrium& other : equilibria.points) {
      const Vector2d way = other.x - one.x;
      if (way[axis] > same && std::abs(way[1 - axis]) < same && one.kind == other.kind) distances.push_back(way[axis]);
    }
  }
  std::ranges::sort(distances);
  for (const double period : distances) {
    const auto moved = [&](const Vector2d& x) { return Vector2d(x + period * Vector2d::Unit(axis)); };
    if (maps_onto_itself(field, Vector2d(period, period), moved, {1, 1})) return period;
  }
  return std::nullopt;
}

/// Returns true if both axes are orbits, as for numbers of animals, and no reflection maps the field onto itself.
bool is_population(const reduction::SmoothField& field, const Vector2d& size) {
  constexpr int points = 8;
  int values = 0;
  for (int i = 1; i <= points; ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      const auto rate = rate_of(field, 0.37 * i * size[axis] * Vector2d::Unit(axis));
      if (rate && (*rate)[1 - axis] != 0) return false;
      values += rate ? 1 : 0;
    }
  }
  const auto reflected = [&](const Vector2d& sign) {
    return maps_onto_itself(
        field, size, [&](const Vector2d& x) { return Vector2d(sign.cwiseProduct(x)); }, sign);
  };
  // A share such as y/x has no value on one axis.
  return values >= points && !reflected({-1, 1}) && !reflected({1, -1});
}

/// Returns the values y at which the slope of y' = F(x, y) changes its sign, and 0. Values beyond 1000 are left out,
/// and all but the nearest one if there are many, as for sin(x y).
std::vector<double> slope_zeros(const reduction::SmoothField& field) {
  constexpr double first = 0.02, ratio = 1.05, last = 1000;
  constexpr std::size_t most = 4;
  std::vector<double> zeros{0};
  for (const double side : {-1., 1.}) {
    double nearest = infinity;
    for (const double x : {-1.3, 0.3, 1.1}) {
      std::vector<double> changes;
      std::optional<Vector2d> before;
      for (double y = first; y < last * ratio; y *= ratio) {
        const auto rate = rate_of(field, {x, side * y});
        if (rate && before && ((*rate)[1] < 0) != ((*before)[1] < 0)) changes.push_back(side * y);
        before = rate;
      }
      if (changes.size() <= most) {
        zeros.insert(zeros.end(), changes.begin(), changes.end());
      } else {
        nearest = std::min(nearest, std::abs(changes.front()));
      }
    }
    if (std::isfinite(nearest)) zeros.push_back(side * nearest);
  }
  return zeros;
}

}  // namespace

bool is_slope_field(const reduction::SmoothField& field, const Window& window) {
  constexpr int across = 5;
  bool has_values = false;
  for (int i = 0; i < across * across; ++i) {
    const int column = i % across, row = i / across;
    const Vector2d part((column + 0.5) / across, (row + 0.5) / across);
    const auto rate = rate_of(field, window.low + part.cwiseProduct(window.sides()));
    if (rate && (*rate)[0] != 1) return false;
    has_values |= rate.has_value();
  }
  return has_values;
}

Window united(const Window& window, const Vector2d& x) { return {window.low.cwiseMin(x), window.high.cwiseMax(x)}; }

std::vector<reduction::LimitCycle> cycles_within(const reduction::PlanarReduction& plane, const Window& window) {
  if (plane.form() == "constant") return {};  // a field without divergence
  const Vector2d sides = window.sides();
  constexpr double reach = 3;
  return find_limit_cycles(
      plane.field(), reduction::find_equilibria(plane.field(), window.low - sides / 2, window.high + sides / 2), reach);
}

PlanarView chosen_view(const reduction::PlanarReduction& plane, const std::vector<Vector2d>& points) {
  const reduction::SmoothField& field = plane.field();
  Equilibria equilibria = equilibria_about_origin(field);
  PlanarView view{{Vector2d::Constant(infinity), Vector2d::Constant(-infinity)}};
  Vector2d middle = Vector2d::Zero();
  std::array<std::optional<double>, 2> periods;
  for (int axis = 0; axis < 2; ++axis) {
    periods[static_cast<std::size_t>(axis)] = period_along(axis, field, equilibria);
    const auto& period = periods[static_cast<std::size_t>(axis)];
    if (!period) continue;
    if (!points.empty()) middle[axis] = *period * std::round(points.front()[axis] / *period);
    constexpr double part = 0.75;  // half of one and a half periods
    std::erase_if(equilibria.points, [&](const Equilibrium& each) { return std::abs(each.x[axis]) > part * *period; });
    for (Equilibrium& each : equilibria.points) each.x[axis] += middle[axis];
    view.periodic[static_cast<std::size_t>(axis)] = true;
  }
  // The typical size of each coordinate. If all are 0 along one axis, the slopes at a center compare both axes.
  Vector2d size = Vector2d::Zero();
  double ratio = 1;
  const auto include = [&](const Vector2d& x) { size = size.cwiseMax((x - middle).cwiseAbs()); };
  for (const Equilibrium& each : equilibria.points) {
    include(each.x);
    const double product = each.slopes(0, 1) * each.slopes(1, 0);
    if (product < 0) ratio = std::sqrt(std::abs(each.slopes(1, 0) / each.slopes(0, 1)));
  }
  constexpr double tiny = 1e-9;
  const bool of_points = size.norm() < tiny;  // a start near the only equilibrium says nothing about limit cycles
  std::ranges::for_each(points, include);
  bool without_size = size.norm() < tiny;
  if (without_size) size[0] = 1;
  if (const Vector2d usual(3, 3); is_slope_field(field, {-usual, usual})) {
    size = usual;
    without_size = false;
    for (const double y : slope_zeros(field)) view.window = united(view.window, {0, y});
  }
  if (size[0] < tiny) size[0] = size[1] / ratio;
  if (size[1] < tiny) size[1] = size[0] * ratio;
  const bool population =
      is_population(field, size) && std::ranges::all_of(points, [](const Vector2d& x) { return x.minCoeff() >= 0; });
  if (population) {
    std::erase_if(equilibria.points, [&](const Equilibrium& each) { return each.x.minCoeff() < -tiny * size.norm(); });
    view.fixed_low = {true, true};
    view.window = united(view.window, Vector2d::Zero());
  }
  if (plane.form() != "constant") {
    constexpr double reach = 8;
    reduction::Equilibria about = equilibria;
    const Vector2d sought = of_points ? Vector2d(size.cwiseMax(Vector2d(1, ratio))) : size;
    about.low = middle - sought;
    about.high = middle + sought;
    view.cycles = find_limit_cycles(field, about, reach);
    if (population) {
      std::erase_if(view.cycles, [](const reduction::LimitCycle& cycle) { return cycle.x.minCoeff() < 0; });
    }
  }
  std::vector<Window> boxes;  // about the limit cycles
  for (const reduction::LimitCycle& cycle : view.cycles) {
    Window& box = boxes.emplace_back(Window{cycle.x, cycle.x});
    for (const Vector2d& x : cycle.line) box = united(box, x);
  }
  const auto distance = [&](const Vector2d& a, const Vector2d& b) { return (a - b).cwiseQuotient(size).norm(); };
  for (const Equilibrium& each : equilibria.points) {
    double nearest = 1;
    for (const Equilibrium& other : equilibria.points) {
      if (&other != &each) nearest = std::min(nearest, distance(each.x, other.x));
    }
    // Orbits about a center or focus fill the room up to the next equilibrium, or up to a limit cycle.
    const bool turns = each.kind.ends_with("focus") || each.kind.starts_with("center") || each.kind == "not smooth";
    const bool in_cycle = std::ranges::any_of(boxes, [&](const Window& box) {
      return box.contains({each.x[0], each.x[1]});
    });
    const Vector2d around = (in_cycle ? 0 : turns || equilibria.points.size() == 1 ? 1 : 0.5) * nearest * size;
    view.window = united(united(view.window, each.x - around), each.x + around);
  }
  if (equilibria.points.empty()) view.window = united(united(view.window, middle - size), middle + size);
  for (const Vector2d& x : points) {
    constexpr double room = 0.2;
    view.window = united(united(view.window, x - room * size), x + room * size);
  }
  constexpr double room = 0.1;
  for (const Window& box : boxes) {
    view.window = united(united(view.window, box.low - room * box.sides()), box.high + room * box.sides());
  }
  // Parts of a switching curve along which motions slide or rest, if they end nearby.
  constexpr double nearby = 8;
  const Window far{middle - nearby * size, middle + nearby * size};
  for (const SwitchingPart& part : switching_parts(field, far.low, far.high)) {
    if (part.motion == reduction::SwitchingMotion::Kind::leaves || part.points.empty()) continue;
    const Vector2d &from = part.points.front(), &to = part.points.back();
    constexpr double inner = 0.98;
    const auto ends = [&](const Vector2d& x) {
      return (x - middle).cwiseQuotient(size).lpNorm<Eigen::Infinity>() < inner * nearby;
    };
    if (!ends(from) || !ends(to)) continue;
    Window box{from, from};
    for (const Vector2d& x : part.points) box = united(box, x);
    constexpr double beside = 0.2;
    const Vector2d added = beside * united(united(view.window, box.low), box.high).sides();
    view.window = united(united(view.window, box.low - added), box.high + added);
  }
  // One equilibrium does not set a scale, and several on a line set only one.
  constexpr double thinnest = 0.6;
  Vector2d extent = view.window.sides().cwiseQuotient(size);
  if (without_size && view.cycles.empty()) extent *= 2;
  extent = extent.cwiseMax(thinnest * extent.maxCoeff());
  const Vector2d centre = (view.window.low + view.window.high) / 2, half = extent.cwiseProduct(size) / 2;
  if (view.cycles.empty()) view.window = united(united(view.window, centre - half), centre + half);
  for (int axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (population) view.window.low[axis] = 0;
    if (!periods[i]) continue;
    constexpr double part = 0.75;
    view.window.low[axis] = middle[axis] - part * *periods[i];
    view.window.high[axis] = middle[axis] + part * *periods[i];
  }
  return view;
}

}  // namespace contensou::portraits
