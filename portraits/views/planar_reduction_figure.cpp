// The symmetry of any planar system that has a scaling.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "contensou/portraits/reduction_figure.hpp"
#include "views/reduced_orbits.hpp"

namespace contensou::portraits {

using Eigen::Vector2d;
using std::numbers::pi;

Figure reduction_figure(const reduction::PlanarField& field, const reduction::PlanarReduction& plane,
                        const Vector2d& start, const std::string& name, const AskedSize& size) {
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
  /// From angle to angle, in the way of the motion.
  const auto line = [&](const std::vector<double>& angles, double constant) {
    Polyline points;
    for (double angle : angles) points.push_back({angle, constant - level(angle)});
    const Point &a = points[points.size() / 2], &b = points[points.size() / 2 + 1];
    const Vector2d here = plane.point(a.x, a.y), next = plane.point(b.x, b.y);
    if (field(here).dot(next - here) < 0) std::ranges::reverse(points);
    return points;
  };
  ReducedOrbits from{.start = {q, p}, .orbit = {}};
  std::vector<double> angles;
  if (plane.rays().empty()) {
    // Turns are copies of one another, too.
    constexpr int pieces = 400;
    constexpr double margin = 1e-9;  // L goes on from 2 pi to 0 by a turn
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
    constexpr int half = 500;  // closer and closer to the rays
    for (int j = -half; j <= half; ++j) angles.push_back(left + (right - left) / (1 + std::exp(-0.05 * j)));
    const bool of_start = left < start_q && start_q < right;
    if (of_start) from.start.x = start_q;
    (of_start ? from.orbit : from.elsewhere).push_back(line(angles, of_start ? integral : p + level(middle)));
  }
  from.in_plane = [plane](Point point) {
    const Vector2d x = plane.point(point.x, point.y);
    return Point{x[0], x[1]};
  };
  const Vector2d centre = plane.centre();
  const double half = plane_widths * (start - centre).lpNorm<Eigen::Infinity>(),
               first = from.rays.empty() ? 0 : from.rays[0];
  from.plane.x = {math("u"), centre[0] - half, centre[0] + half, false, {}};
  from.plane.y = {math("v"), centre[1] - half, centre[1] + half, false, {}};
  from.plane.to_scale = true;
  from.strip.x = {math("q") + ", the angle", first, first + 2 * pi, false, {}};
  from.strip.y = {math("p"), p - strip_below, p + strip_above, false, {}};
  return draw(std::move(from), "The reduction of  " + shortened(name), size);
}

}  // namespace contensou::portraits
