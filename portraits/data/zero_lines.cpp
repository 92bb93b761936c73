// The curves on which a function is 0, and the motions along such curves of switching functions.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <boost/math/tools/minima.hpp>

#include "contensou/portraits/planar_portrait.hpp"
#include "data/planar_window.hpp"

namespace contensou::portraits {

using Eigen::Vector2d;
using reduction::SwitchingMotion;
using Kind = SwitchingMotion::Kind;

namespace {

/// Returns the place between two corners of a square at which a function is 0: it changes its sign there, or touches 0
/// as v^2 does. Empty if the function stays away from 0, and at a pole.
/// @param values  at four points in one line; the middle two are the corners. At the border an outer point is missing:
///                its value repeats that of the corner
std::optional<Vector2d> zero_between(const reduction::FactorPiece& piece, const Vector2d& from, const Vector2d& to,
                                     const std::array<double, 4>& values) {
  std::array<double, 4> sizes{};
  std::ranges::transform(values, sizes.begin(), [](double value) { return std::abs(value); });
  const bool crosses = (values[1] < 0) != (values[2] < 0), turns = sizes[0] > sizes[1] && sizes[2] < sizes[3];
  if (!(crosses || turns) || !(sizes[1] + sizes[2] < INFINITY)) return std::nullopt;
  constexpr int bits = 26;
  const auto place = [&](double s) { return Vector2d(from + s * (to - from)); };
  const auto [nearest, least] =
      boost::math::tools::brent_find_minima([&](double s) { return std::abs(piece.value(place(s))); }, 0.0, 1.0, bits);
  constexpr double rounding = 1e-6;  // also of a V that was fitted to differences
  return least <= rounding * std::max(sizes[1], sizes[2]) ? std::optional(place(nearest)) : std::nullopt;
}

}  // namespace

std::vector<Polyline> zero_lines(const reduction::FactorPiece& piece, const Vector2d& sides) {
  constexpr double across = 160;
  const Vector2d extent = piece.high - piece.low;
  const int columns = std::max(2, static_cast<int>(std::lround(across * extent[0] / sides[0])));
  const int rows = std::max(2, static_cast<int>(std::lround(across * extent[1] / sides[1])));
  // The grid is shifted, because axes and lines of round numbers would otherwise run along sides of squares.
  const auto part = [](int i, int count) { return i == 0 ? 0 : i == count ? 1 : (i - 0.363) / count; };
  const auto corner = [&](int i, int j) {
    return Vector2d(piece.low + Vector2d(part(i, columns), part(j, rows)).cwiseProduct(extent));
  };
  std::vector<double> values;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) values.push_back(piece.value(corner(i, j)));
  }
  const auto value = [&](int i, int j) -> double& {
    return values[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns + 1) + static_cast<std::size_t>(i)];
  };
  // On a border at which the function is 0, rounding decides the sign. The value gets the sign opposite to that inside.
  constexpr double rounding = 1e-8;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double inside = value(std::clamp(i, 1, columns - 1), std::clamp(j, 1, rows - 1));
      double& here = value(i, j);
      if (std::abs(here) < rounding * std::abs(inside)) here = -rounding * inside;
    }
  }

  // Maps a side of a square (first corner; true: upwards) to the zero on the side and to the sides joined with it.
  using Side = std::pair<std::pair<int, int>, bool>;
  struct Crossing {
    Vector2d at;
    std::vector<Side> joined;
  };
  std::map<Side, Crossing> crossings;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      for (const bool up : {false, true}) {
        const int k = up ? i : i + 1, l = up ? j + 1 : j;
        if (k > columns || l > rows) continue;
        const double before = up ? value(i, std::max(j - 1, 0)) : value(std::max(i - 1, 0), j);
        const double after = up ? value(k, std::min(l + 1, rows)) : value(std::min(k + 1, columns), l);
        const auto zero = zero_between(piece, corner(i, j), corner(k, l), {before, value(i, j), value(k, l), after});
        if (zero) crossings[{{i, j}, up}] = {*zero, {}};
      }
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      std::vector<Side> crossed;
      for (const Side& side :
           {Side{{i, j}, false}, Side{{i + 1, j}, true}, Side{{i, j + 1}, false}, Side{{i, j}, true}}) {
        if (crossings.contains(side)) crossed.push_back(side);
      }
      // Sides are ordered counter-clockwise. If four sides are crossed, opposite crossings lie on one curve.
      const std::size_t lines = crossed.size() / 2;
      for (std::size_t k = 0; k < lines; ++k) {
        crossings[crossed[k]].joined.push_back(crossed[k + lines]);
        crossings[crossed[k + lines]].joined.push_back(crossed[k]);
      }
    }
  }
  std::vector<Polyline> lines;
  const auto follow = [&](Side side) {
    Polyline line;
    for (;;) {
      Crossing& here = crossings[side];
      line.push_back({here.at[0], here.at[1]});
      if (here.joined.empty()) break;
      const Side next = here.joined.back();
      here.joined.pop_back();
      std::erase(crossings[next].joined, side);
      side = next;
    }
    // Rounding produces dots where the function touches 0 without a change of sign. Such short lines are left out.
    const double length = std::abs(line.front().x - line[line.size() / 2].x) / sides[0] +
                          std::abs(line.front().y - line[line.size() / 2].y) / sides[1];
    if (length * across > 1) lines.push_back(std::move(line));
  };
  // Follow first the lines that have ends, then closed curves from any of their points.
  for (const std::size_t ways : {std::size_t{1}, std::size_t{2}}) {
    for (auto& [side, crossing] : crossings) {
      if (crossing.joined.size() == ways) follow(side);
    }
  }
  return lines;
}

namespace {

/// The motion at a point of a switching curve, with the sense in which it slides along a line of points.
struct PlaceOnLine {
  std::optional<SwitchingMotion> motion;
  int sense = 0;  ///< 1: from one point of the line to the next; -1: backwards; 0: neither

  bool continues(const PlaceOnLine& other) const {
    return motion && other.motion && motion->kind == other.motion->kind && sense == other.sense;
  }
};

/// Follows the curve of one switching function along a line of points near to it.
class SwitchingLine {
 public:
  SwitchingLine(const reduction::SmoothField& field, Eigen::Index function, double size)
      : field_(field), function_(function), size_(size) {}

  void follow(const Polyline& line, std::vector<SwitchingPart>& parts) {
    constexpr int pieces = 2, halvings = 45;
    std::optional<PlaceOnLine> before;
    Vector2d last = Vector2d::Zero();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Vector2d from(line[i].x, line[i].y), to(line[i + 1].x, line[i + 1].y), way = to - from;
      for (int k = i == 0 ? 0 : 1; k <= pieces; ++k) {
        const Vector2d x = from + way * k / pieces;
        const PlaceOnLine here = at(x, way);
        if (before && !before->continues(here)) {
          // Between the two motions there may be a third, as rest at a point between two senses of sliding.
          const auto last_that_continues = [&](const PlaceOnLine& place, Vector2d inside, Vector2d outside) {
            for (int step = 0; step < halvings; ++step) {
              const Vector2d middle = (inside + outside) / 2;
              (place.continues(at(middle, way)) ? inside : outside) = middle;
            }
            return at(inside, way);
          };
          add(last_that_continues(*before, last, x));
          finish(parts);
          add(last_that_continues(here, x, last));
        }
        add(here);
        before = here;
        last = x;
      }
    }
    finish(parts);
  }

 private:
  PlaceOnLine at(const Vector2d& x, const Vector2d& way) const {
    PlaceOnLine place{reduction::motion_on_curve(field_, function_, x, size_)};
    if (place.motion && place.motion->kind == Kind::slides) place.sense = place.motion->velocity.dot(way) > 0 ? 1 : -1;
    return place;
  }

  void add(const PlaceOnLine& place) {
    if (!place.motion || place.motion->kind == Kind::crosses) return;
    kind_ = place.motion->kind;
    backwards_ = place.sense < 0;
    points_.push_back(place.motion->x);
  }

  void finish(std::vector<SwitchingPart>& parts) {
    if (backwards_) std::ranges::reverse(points_);
    constexpr double shortest = 1e-6;
    if (points_.size() > 1 &&
        (points_.back() - points_.front()).norm() + (points_[1] - points_[0]).norm() > shortest * size_) {
      parts.push_back({kind_, points_});
    }
    points_.clear();
  }

  const reduction::SmoothField& field_;
  Eigen::Index function_;
  double size_;
  Kind kind_ = Kind::crosses;
  bool backwards_ = false;
  std::vector<Vector2d> points_ = {};
};

}  // namespace

std::vector<SwitchingPart> switching_parts(const reduction::SmoothField& field, const Vector2d& low,
                                           const Vector2d& high) {
  std::vector<SwitchingPart> parts;
  if (!field.switches || !field.branch) return parts;
  const Vector2d sides = high - low;
  const double size = sides.norm();
  const Eigen::Index count = field.switches(low).rows();
  const auto is_curve_of = [&](Eigen::Index function, const Vector2d& x) {
    constexpr double near = 1e-6;
    const Eigen::RowVector3d h = field.switches(x).row(function);
    return std::abs(h[0]) <= near * size * h.tail<2>().norm();
  };
  std::vector<std::pair<Eigen::Index, Polyline>> lines;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto value = [&](const Vector2d& x) { return field.switches(x)(i, 0); };
    for (const Polyline& line : zero_lines({low, high, value}, sides)) {
      // Several functions may have one curve, as in sign(v) and abs(v), and a diagonal is found twice.
      const Vector2d middle(line[line.size() / 3].x, line[line.size() / 3].y);
      bool known = std::ranges::any_of(lines, [&](const auto& earlier) {
        constexpr double cell = 0.01;
        return earlier.first == i && std::ranges::any_of(earlier.second, [&](const Point& x) {
                 return (Vector2d(x.x, x.y) - middle).cwiseQuotient(sides).norm() < cell;
               });
      });
      for (Eigen::Index k = 0; k < i; ++k) known |= is_curve_of(k, middle);
      lines.emplace_back(i, line);
      if (!known) SwitchingLine(field, i, size).follow(line, parts);
    }
  }
  return parts;
}

void leave_out_rests(reduction::Equilibria& equilibria, const std::vector<SwitchingPart>& parts) {
  const double near = 1e-6 * (equilibria.high - equilibria.low).norm();
  std::erase_if(equilibria.points, [&](const reduction::Equilibrium& each) {
    return std::ranges::any_of(parts, [&](const SwitchingPart& part) {
      for (std::size_t i = 1; part.motion == Kind::rests && i < part.points.size(); ++i) {
        const Vector2d from = part.points[i - 1], way = part.points[i] - from;
        const double share = std::clamp((each.x - from).dot(way) / way.squaredNorm(), 0., 1.);
        if ((each.x - from - share * way).norm() <= near) return true;
      }
      return false;
    });
  });
}

}  // namespace contensou::portraits
