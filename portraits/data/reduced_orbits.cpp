#include "contensou/portraits/reduction_figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "contensou/portraits/planar_portrait.hpp"
#include "contensou/reduction/detail/root.hpp"
#include "contensou/reduction/flow.hpp"

namespace contensou::portraits {

using Eigen::Vector2d;
using std::numbers::pi;

namespace {

constexpr double beyond = 12;  // distance of p from its value at the start to which orbits are followed

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
  for (int i = 0; i < most && from.orbit[0].back().y - from.orbit[0].back().x > ln_u + ln_mu - beyond; ++i) {
    from.orbit[0].push_back(at(there));
    there -= 0.05 + 0.02 * std::max(0.0, std::abs(there) - 8);
  }
  from.in_plane = [=](Point point) {
    return Point{std::copysign(std::exp(point.y - point.x - ln_mu), start[0]),
                 std::copysign(std::exp(point.y), start[1])};
  };
  return from;
}

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// The coordinates of the strip of a shift, of a turn about the origin, or of a scaling with A = diag(1, m). The place
/// is linear in q, and its derivative by p is X = A x + b.
class Chart {
 public:
  Chart(const reduction::Generator& symmetry, const Vector2d& start)
      : A_(symmetry.matrix),
        b_(symmetry.shift),
        scales_(symmetry.scales()),
        centre_(scales_ ? symmetry.centre() : Vector2d(0, 0)),
        side_(start[0] < centre_[0] ? -1 : 1) {}

  bool scales() const { return scales_; }
  bool turns() const { return !scales_ && !A_.isZero(0); }

  /// Returns p of a point in the plane.
  double p(const Vector2d& x) const {
    if (turns()) return std::atan2(x[1], x[0]);
    if (scales_) return std::log(std::abs(x[0] - centre_[0]));
    return b_[0] == 0 ? x[1] / b_[1] : x[0] / b_[0];
  }
  Point canonical(const Vector2d& x) const {
    const Vector2d zero = place({0, p(x)}), across = place({1, p(x)}) - zero;
    return {(x - zero).dot(across.stableNormalized()) / across.stableNorm(), p(x)};
  }
  Vector2d place(Point at) const {
    const auto [q, p] = at;
    if (turns()) return {q * std::cos(p), q * std::sin(p)};
    if (!scales_) return p * b_ + q * (b_[0] == 0 ? Vector2d(1, 0) : Vector2d(0, 1));
    // A power that is not whole is that of the absolute value.
    const double x = side_ * std::exp(p), m = A_(1, 1);
    return centre_ + Vector2d(x, q * std::pow(m == std::round(m) ? x : std::abs(x), m));
  }
  /// Returns the rates of q and p at a point of the strip. X leaves them unchanged, up to a factor of both.
  Vector2d rates(Point at, const reduction::PlanarField& field) const {
    const Vector2d x = place(at), across = place({1, at.y}) - place({0, at.y}), along = A_ * x + b_, f = field(x);
    const Vector2d a = across.stableNormalized(), b = along.stableNormalized();  // the squares can underflow
    return Vector2d(cross(f, b) / across.stableNorm(), cross(a, f) / along.stableNorm()) / cross(a, b);
  }

 private:
  Eigen::Matrix2d A_;
  Vector2d b_;
  bool scales_;
  Vector2d centre_;
  double side_;
};

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
    const int turns = growth < 1e-9 ? 0 : static_cast<int>(std::min(40.0, std::ceil(beyond / growth)));
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

ReducedOrbits reduced_orbits(const reduction::PlanarReduction& plane, const Vector2d& start,
                             const reduction::Generator& symmetry) {
  const Chart chart(symmetry, start);
  ReducedOrbits from{.start = chart.canonical(start), .orbit = {}};
  from.in_plane = [chart](Point at) {
    const Vector2d x = chart.place(at);
    return Point{x[0], x[1]};
  };
  double half = 10 * std::max(1.0, std::abs(from.start.x));
  if (!chart.scales()) {
    const PortraitRequest request{.highlight = reduction::State{start[0], start[1]}, .orbits = 0, .isochrones = 0};
    const Vector2d sides = planar_portrait(plane, "", request).window.sides();
    constexpr int copies_in_window = 8, copies_in_turn = 7;
    half = 3 * sides.maxCoeff();
    from.step = chart.turns() ? 2 * pi / copies_in_turn : std::abs(chart.p(sides)) / copies_in_window;
  }
  const auto rates = [&](double q) { return chart.rates({q, from.start.y}, plane.field()); };
  // On an invariant line q is constant.
  const double low = chart.turns() ? 1e-3 * half : from.start.x - half, high = from.start.x + half;
  const auto across = [&](double q) {
    try {
      return rates(q)[0];
    } catch (const std::exception&) {
      return std::numeric_limits<double>::quiet_NaN();
    }
  };
  constexpr int pieces = 997;
  for (int i = 0; i < pieces; ++i) {
    const double left = std::lerp(low, high, i / double{pieces}),
                 right = std::lerp(low, high, (i + 1) / double{pieces});
    const double before = across(left), after = across(right);
    if (after == 0) from.rays.push_back(right);
    if (before * after < 0) {
      const double root = reduction::root_between(across, left, right);
      if (std::abs(across(root)) < std::min(std::abs(before), std::abs(after))) from.rays.push_back(root);
    }
  }
  if (across(from.start.x) == 0) refuse_ray();
  std::vector<double> between{low};
  between.insert(between.end(), from.rays.begin(), from.rays.end());
  between.push_back(high);
  const auto sector = [&](double q) { return std::ranges::upper_bound(from.rays, q) - from.rays.begin(); };
  PortraitRequest request{.orbits = 0, .isochrones = 0};
  request.through = {{from.start.x, from.start.y}};
  for (std::size_t i = 0; i + 1 < between.size(); ++i) {
    // The outer sectors are wide; their orbit passes near the start, too.
    const double near = half / (chart.scales() ? 5 : 6);
    const double q = (std::max(between[i], from.start.x - near) + std::min(between[i + 1], from.start.x + near)) / 2;
    if (q > low && std::isfinite(across(q)) && sector(q) != sector(from.start.x))
      request.through.push_back({q, from.start.y});
  }
  // Orbits are followed in the strip, farther than its picture, so that their copies fill the picture.
  constexpr double farther = 10;
  request.window = Window{{low, from.start.y - farther * from.step}, {high, from.start.y + farther * from.step}};
  const reduction::PlanarReduction strip =
      reduction::by_steps(reduction::SmoothField([&](const Vector2d& at) { return rates(at[0]); }));
  for (const PortraitOrbit& part : planar_portrait(strip, "", request).through) {
    Polyline line;
    for (Eigen::Index i = 0; i < part.rows(); ++i) line.push_back({part.u[i], part.v[i]});
    const bool of_start = sector(line[line.size() / 2].x) == sector(from.start.x);
    (of_start ? from.orbit : from.elsewhere).push_back(std::move(line));
  }
  return from;
}

}  // namespace contensou::portraits
