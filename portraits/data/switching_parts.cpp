#include <algorithm>
#include <cmath>
#include <optional>

#include "contensou/portraits/planar_portrait.hpp"
#include "data/zero_lines.hpp"

namespace contensou::portraits {

using Eigen::Vector2d;
using reduction::SwitchingMotion;
using Kind = SwitchingMotion::Kind;

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
    Vector2d last;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Vector2d from(line[i].x, line[i].y), to(line[i + 1].x, line[i + 1].y), way = to - from;
      for (int k = i == 0 ? 0 : 1; k <= pieces; ++k) {
        const Vector2d x = from + way * k / pieces;
        const PlaceOnLine here = at(x, way);
        if (before && !before->continues(here)) {
          Vector2d low = last, high = x;
          for (int step = 0; step < halvings; ++step) {
            const Vector2d middle = (low + high) / 2;
            (before->continues(at(middle, way)) ? low : high) = middle;
          }
          add(at(low, way));
          finish(parts);
          if (at(high, way).continues(here)) add(at(high, way));
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
