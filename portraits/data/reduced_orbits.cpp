#include "contensou/portraits/reduction_figure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "contensou/reduction/flow.hpp"

namespace contensou::portraits {

using Eigen::Vector2d;
using std::numbers::pi;

namespace {

[[noreturn]] void refuse_ray() {
  throw std::domain_error(
      "the start lies on an axis or on an invariant ray, which the symmetry moves along itself: "
      "another start is needed");
}

/// Returns orbits of (2.6). The code uses ln v, which is finite even if v or the angle is too small for a double.
ReducedOrbits orbits_of_flow(const reduction::Flow& flow, const Vector2d& start) {
  const double ln_u = std::log(std::abs(start[0])), ln_v = std::log(std::abs(start[1]));
  const double ln_mu = std::log(flow.system().mu()), ln_k = ln_v - ln_mu - ln_u;
  if (!std::isfinite(ln_u) || !std::isfinite(ln_v)) refuse_ray();
  ReducedOrbits from{.start = {ln_k, ln_v}, .orbit = std::vector<Polyline>(1)};
  for (const auto& ray : flow.terminal().rays) {
    from.rays.push_back(std::log(ray.k));
    if (std::abs(from.rays.back() - ln_k) < 1e-12) refuse_ray();
  }
  const reduction::SimilarityCurve& curve = *flow.solution().through(ln_k);
  const double integral = flow.log_first_integral(start[0], ln_v), xi = curve.chart().coordinate(ln_k);
  const auto at = [&](double there) {
    const double x = curve.chart().log_ratio(there);
    return Point{x, integral + curve.ln_w(there) + ln_mu + x};
  };
  // Points are dense about k = 1 and sparser far from it: for small mu, ln k falls by thousands while u falls.
  constexpr int upstream = 400, most = 4000;
  for (int i = upstream; i > 0; --i) from.orbit[0].push_back(at(xi + 0.05 * i));
  double there = xi;
  for (int i = 0; i < most && from.orbit[0].back().y - from.orbit[0].back().x > ln_u + ln_mu - orbits_beyond; ++i) {
    from.orbit[0].push_back(at(there));
    there -= 0.05 + 0.02 * std::max(0.0, std::abs(there) - 8);
  }
  from.in_plane = [=](Point point) {
    return Point{std::copysign(std::exp(point.y - point.x - ln_mu), start[0]),
                 std::copysign(std::exp(point.y), start[1])};
  };
  return from;
}

}  // namespace

ReducedOrbits reduced_orbits(const reduction::PlanarReduction& plane, const Vector2d& start) {
  if (plane.flow()) return orbits_of_flow(*plane.flow(), start);
  if (plane.kind() == "bordered") throw std::domain_error("the field has borders or jumps: its sectors are not drawn");
  if (start == plane.centre() || plane.star()) refuse_ray();
  const auto [q, p, slope] = plane.canonical(start);
  const auto level = [&](double angle) { return plane.first_integral(plane.point(angle, 0)); };
  const double integral = [&] {
    try {
      return plane.first_integral(start);
    } catch (const std::domain_error&) {
      refuse_ray();
    }
  }();
  /// Returns the curve of points (angle, constant - level(angle)), in the direction of the motion.
  const auto line = [&](const std::vector<double>& angles, double constant) {
    Polyline points;
    for (double angle : angles) {
      try {
        points.push_back({angle, constant - level(angle)});
      } catch (const std::domain_error&) {
        // in a narrow sector there may be no double this close to its ray
      }
    }
    if (points.size() < 2) return Polyline();
    const Point &a = points[points.size() / 2 - 1], &b = points[points.size() / 2];
    const Vector2d here = plane.point(a.x, a.y), next = plane.point(b.x, b.y);
    if (plane.field()(here).dot(next - here) < 0) std::ranges::reverse(points);
    return points;
  };
  ReducedOrbits from{.start = {q, p}, .orbit = {}};
  std::vector<double> angles;
  if (plane.rays().empty()) {
    // In a focus the turns are copies of one another.
    constexpr int pieces = 400;
    constexpr double margin = 1e-9;  // between 2 pi and 0 level() jumps by its change in a turn
    for (int i = 0; i <= pieces; ++i) angles.push_back(margin + (2 * pi - 2 * margin) * i / pieces);
    if (q < 0) from.start.x += 2 * pi;
    const Polyline turn = line(angles, integral);
    const double growth = std::abs(turn.back().y - turn.front().y);
    const int turns = growth < 1e-9 ? 0 : static_cast<int>(std::min(40.0, std::ceil(orbits_beyond / growth)));
    for (int i = -turns; i <= turns; ++i) {
      from.orbit.push_back(turn);
      for (Point& point : from.orbit.back()) point.y += i * growth;
    }
  }
  for (std::size_t i = 0; i < plane.rays().size(); ++i) {
    const bool last = i + 1 == plane.rays().size();
    const double left = plane.rays()[i].q, right = last ? plane.rays()[0].q + 2 * pi : plane.rays()[i + 1].q;
    const double middle = (left + right) / 2, start_q = q < left ? q + 2 * pi : q;
    from.rays.push_back(left);
    if (last) from.rays.push_back(right);
    angles.clear();
    constexpr int half = 500;  // number of points on each side of the middle; they are dense towards the rays
    for (int j = -half; j <= half; ++j) angles.push_back(left + (right - left) / (1 + std::exp(-0.05 * j)));
    const bool of_start = left < start_q && start_q < right;
    if (of_start) from.start.x = start_q;
    Polyline copy = line(angles, of_start ? integral : p + level(middle));
    if (!copy.empty()) (of_start ? from.orbit : from.elsewhere).push_back(std::move(copy));
  }
  from.in_plane = [plane](Point point) {
    const Vector2d x = plane.point(point.x, point.y);
    return Point{x[0], x[1]};
  };
  return from;
}

}  // namespace contensou::portraits
