// Motions at switching curves, by Filippov's definition (A. F. Filippov, Differential equations with discontinuous
// righthand sides, 1988, section 4; M. di Bernardo, C. Budd, A. Champneys, P. Kowalczyk, Piecewise-smooth dynamical
// systems, 2008, chapter 2). The velocity of a motion at x lies in the convex hull of the limits of f at x.
//
// Let h be a switching function and f_1, f_2 the fields on the sides h > 0 and h < 0, with the rates a_i = grad h .
// f_i. If a_1 and a_2 have one sign, motions cross h = 0. If a_1 <= 0 <= a_2, they stay on it: the only velocity of the
// hull along the curve is (a_2 f_1 - a_1 f_2)/(a_2 - a_1), which keeps h constant also beside the curve. If a_1 > 0 >
// a_2, a motion may leave to either side at any time. At a tangent point a rate is 0. There the sign that the rate has
// a little later decides. Sliding ends at a tangent point at which the side turns away; the side's own motion leaves
// there. If the rate stays 0, the curve is an orbit of this side, and the combination is the field of this side.
//
// The tangents of several curves that meet divide a small circle into sectors. A motion leaves into a sector if its
// field points into it, and along a half tangent if both neighbours let it slide away from the point. If there is one
// such way, it is the motion. If there is none and the hull contains 0, the motion rests.
#include "planar/region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "contensou/reduction/planar_reduction.hpp"
#include "numerics/decomposition.hpp"
#include "planar/section_field.hpp"

namespace contensou::reduction {

using Eigen::Index;
using Eigen::Vector2d;
using std::numbers::pi;

namespace {

constexpr double tangent = 1e-9;  ///< a rate below this part of |grad h| |f| counts as 0

/// Returns the rate of a switching function along a velocity, and the size below which it counts as 0.
std::pair<double, double> rate_along(const SmoothField& field, Index function, const Vector2d& x, const Vector2d& f,
                                     double speed) {
  const Vector2d gradient = field.switches(x).row(function).tail<2>();
  return {gradient.dot(f), tangent * gradient.norm() * speed};
}

/// Goes from a point to the curve on which a switching function is 0, by a step of Newton's method.
Vector2d towards_curve(const SmoothField& field, Index function, const Vector2d& x) {
  const Eigen::RowVector3d h = field.switches(x).row(function);
  const Vector2d gradient = h.tail<2>();
  return x - h[0] / gradient.squaredNorm() * gradient;
}

}  // namespace

Vector2d sliding_velocity(const Vector2d& first, const Vector2d& second, double rate_first, double rate_second) {
  const double difference = rate_second - rate_first;
  return difference == 0 ? first : Vector2d((rate_second * first - rate_first * second) / difference);
}

Region::Region(const SmoothField& field, const Vector2d& inside) : whole_(&field) {
  if (!field.switches || !field.branch) return;
  signs_ = signs_at(inside);
  continued_ = field.branch(inside);
  continued_->basis = field.basis;
}

Region::Region(const SmoothField& field, const Vector2d& x, const Vector2d& way, const Region* from) : whole_(&field) {
  if (!field.switches || !field.branch) return;
  // A point on a border belongs to the region that the orbit enters. The steps are longer than the rounding of x, and
  // grow until each switching function shows its sign.
  constexpr double shortest = 1e-13, longest = 1e-9;
  const double length = way.stableNorm();
  const double size = x.lpNorm<Eigen::Infinity>() > 0 ? x.lpNorm<Eigen::Infinity>() : 1;
  Vector2d inside = x;
  for (double step = shortest; step <= longest && length > 0; step *= 10) {
    inside = x + step * size / length * way;
    const std::vector<int> signs = signs_at(inside);
    if (std::ranges::count(signs, 0) == 0 && !(from != nullptr && signs == from->signs_)) break;
  }
  *this = Region(field, inside);
}

std::vector<int> Region::signs_at(const Vector2d& x) const {
  const Eigen::MatrixX3d switches = whole_->switches(x);
  std::vector<int> signs(static_cast<std::size_t>(switches.rows()));
  for (std::size_t i = 0; i < signs.size(); ++i) {
    const double value = switches(static_cast<Index>(i), 0);
    signs[i] = value > 0 ? 1 : value < 0 ? -1 : 0;
  }
  return signs;
}

bool Region::contains(const Vector2d& x) const {
  if (!continued_) return true;
  const std::vector<int> there = signs_at(x);
  for (std::size_t i = 0; i < there.size(); ++i) {
    if (there[i] * signs_[i] < 0) return false;
  }
  if (!slide_) return true;
  const auto first = value_of(slide_->first.value, x), second = value_of(slide_->second.value, x);
  if (!first || !second) return false;
  const auto away = [&](const Vector2d& f, double sign) {
    const auto [rate, least] = rate_along(*whole_, slide_->function, x, f, first->norm() + second->norm());
    return sign * rate > least;
  };
  return !away(*first, slide_->sign) && !away(*second, -slide_->sign);
}

Vector2d Region::on_curve(const Vector2d& x) const {
  if (!slide_) return x;
  const Vector2d there = towards_curve(*whole_, slide_->function, x);
  return there.allFinite() ? there : x;
}

Vector2d Region::cancelled(const Vector2d& x) const {
  if (!slide_) return Vector2d::Zero();
  const Vector2d first = slide_->first.value(x), second = slide_->second.value(x);
  const Vector2d gradient = whole_->switches(x).row(slide_->function).tail<2>();
  const double difference = std::abs(gradient.dot(second - first));
  if (difference == 0) return Vector2d::Zero();
  // Rates along the gradient have the rounding of all their terms.
  return gradient.norm() / difference * (second.norm() * first.cwiseAbs() + first.norm() * second.cwiseAbs());
}

std::optional<double> Region::dip(const Vector2d& from, const Vector2d& to, double time) const {
  if (!continued_ || slide_) return std::nullopt;
  const auto f = value_of(field().value, from), g = value_of(field().value, to);
  if (!f || !g) return std::nullopt;
  const Eigen::MatrixX3d before = whole_->switches(from), after = whole_->switches(to);
  for (Index i = 0; i < before.rows(); ++i) {
    const double sign = signs_[static_cast<std::size_t>(i)], h = sign * before(i, 0), k = sign * after(i, 0);
    const double down = sign * time * before.row(i).tail<2>().dot(*f),
                 up = sign * time * after.row(i).tail<2>().dot(*g);
    if (!(down < 0 && up > 0)) continue;
    // The cubic has its minimum where a s^2 + 2 b s + down = 0.
    const double a = 3 * (down + up + 2 * (h - k)), b = 3 * (k - h) - 2 * down - up;
    const double s = -down / (b + std::sqrt(std::max(0., b * b - a * down)));
    if (h + s * (down + s * (b + s * a / 3)) < 0) return s;
  }
  return std::nullopt;
}

bool Region::keeps(const Vector2d& rest, const Vector2d& offset, const Eigen::Matrix2d& flow) const {
  if (!continued_) return true;
  constexpr double rounding = 1e-12, earliest = 1e-3, longest = 1e5, growth = 1.05;
  const Eigen::MatrixX3d there = whole_->switches(rest);
  const double unit = 1 / flow.norm();
  for (double time = earliest; time < longest; time *= growth) {
    const Vector2d away = matrix_exponential(time * unit * flow) * offset;
    for (Index i = 0; i < there.rows(); ++i) {
      const Vector2d gradient = there.row(i).tail<2>();
      const double least = rounding * gradient.norm() * (rest.norm() + offset.norm());
      const double h = std::abs(there(i, 0)) > least ? there(i, 0) : 0, change = gradient.dot(away);
      // On a border the equilibrium is neared with directions that turn less and less; rounding hides the last ones.
      if (std::abs(change) <= rounding * gradient.norm() * away.norm()) continue;
      if (signs_[static_cast<std::size_t>(i)] * (h + change) < 0) return false;
    }
  }
  return true;
}

/// Returns true if orbits leave the region at x: the rates of the crossed switching functions have the same signs
/// inside and beyond the border, and are not near 0.
bool Region::crosses_to(const Region& next, const Vector2d& x) const {
  const auto before = value_of(field().value, x), after = value_of(next.field().value, x);
  if (!before || !after) return false;
  for (std::size_t i = 0; i < signs_.size(); ++i) {
    if (signs_[i] * next.signs_[i] >= 0) continue;
    const double speed = before->norm() + after->norm();
    const auto [here, least] = rate_along(*whole_, static_cast<Index>(i), x, *before, speed);
    const double there = rate_along(*whole_, static_cast<Index>(i), x, *after, speed).first;
    if (std::isfinite(here) && (here * there <= 0 || std::min(std::abs(here), std::abs(there)) <= least)) return false;
  }
  return true;
}

/// Returns true if an orbit crosses to a region with another field at such a small angle that its error decides whether
/// it does.
bool Region::grazes(const Region& next, const Vector2d& x) const {
  constexpr double angle = 1e-5, apart = 1e-9;
  const Vector2d before = field()(x), after = next.field()(x);
  const double speed = before.norm();
  if ((before - after).norm() <= apart * speed) return false;
  for (std::size_t i = 0; i < signs_.size(); ++i) {
    if (signs_[i] * next.signs_[i] >= 0) continue;
    const Vector2d gradient = whole_->switches(x).row(static_cast<Index>(i)).tail<2>();
    if (std::abs(gradient.dot(before)) <= angle * gradient.norm() * speed) return true;
  }
  return false;
}

Onward Region::leave(const Vector2d& x, double size) const {
  if (const auto way = value_of(field().value, x); way && !slide_) {
    Region next(*whole_, x, *way, this);
    if (next.signs_ != signs_ && crosses_to(next, x)) {
      if (!grazes(next, x)) return {x, std::move(next)};
      return {x, {}, false, "the motion touches a jump, and rounding hides whether it crosses", true};
    }
  }
  return onward(*whole_, x, size).value_or(Onward{x, {}, false, "the field has no value beyond"});
}

std::optional<SwitchingMotion> motion_on_curve(const SmoothField& field, Index function, Vector2d x, double size) {
  using Kind = SwitchingMotion::Kind;
  constexpr int steps = 4;
  constexpr double part = 1e-9, near = 1e-3;
  const Vector2d from = x;
  for (int i = 0; i < steps; ++i) {
    x = towards_curve(field, function, x);
    if (!((x - from).norm() < near * size)) return std::nullopt;
  }
  const Vector2d normal = field.switches(x).row(function).tail<2>().normalized();
  const Region first(field, Vector2d(x + part * size * normal)), second(field, Vector2d(x - part * size * normal));
  const auto f = value_of(first.field().value, x), g = value_of(second.field().value, x);
  if (!f || !g) return std::nullopt;
  const double speed = f->norm() + g->norm(), least = tangent * speed, a = normal.dot(*f), b = normal.dot(*g);
  constexpr double rounding = 1e-12, apart = 1e-9;
  if (!((*f - *g).norm() > apart * speed)) return SwitchingMotion{Kind::crosses, x, *f};
  if (a > least && b < -least) return SwitchingMotion{Kind::leaves, x, sliding_velocity(*f, *g, a, b)};
  if (a > least || b < -least) return SwitchingMotion{Kind::crosses, x, *f};
  const Vector2d velocity = sliding_velocity(*f, *g, a, b);
  return SwitchingMotion{velocity.norm() > rounding * speed ? Kind::slides : Kind::rests, x, velocity};
}

/// The sectors about a point at which switching functions are 0.
class Junction {
 public:
  Junction(const SmoothField& field, const Vector2d& x, double size) : field_(field), size_(size), x_(x) {
    find_curves();
    move_onto_curves();
    if (!curves_.empty()) divide();
  }

  bool exists() const { return !curves_.empty(); }
  Onward onward() const;

 private:
  struct Curve {
    Index function;
    Vector2d normal;  ///< unit vector
  };
  struct Sector {
    double from;  ///< angle of the half tangent at its clockwise end
    Region region;
    Vector2d f;
  };

  static Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

  void find_curves() {
    constexpr double near = 1e-10;
    curves_.clear();
    const Eigen::MatrixX3d rows = field_.switches(x_);
    for (Index i = 0; i < rows.rows(); ++i) {
      const Vector2d gradient = rows.row(i).tail<2>();
      const double slope = gradient.norm();
      if (slope > 0 && std::isfinite(slope) && std::abs(rows(i, 0)) <= near * size_ * slope)
        curves_.push_back({i, gradient / slope});
    }
  }

  static bool parallel(const Vector2d& a, const Vector2d& b) { return std::abs(cross(a, b)) < 1e-6; }

  void move_onto_curves() {
    for (int step = 0; step < 2 && !curves_.empty(); ++step) {
      const Curve& one = curves_.front();
      const auto other = std::ranges::find_if_not(
          curves_, [&](const Vector2d& n) { return parallel(n, one.normal); }, &Curve::normal);
      const Eigen::MatrixX3d rows = field_.switches(x_);
      if (other == curves_.end()) {
        x_ = towards_curve(field_, one.function, x_);
      } else {
        Eigen::Matrix2d gradients;
        gradients << rows.row(one.function).tail<2>(), rows.row(other->function).tail<2>();
        x_ -= gradients.inverse() * Vector2d(rows(one.function, 0), rows(other->function, 0));
      }
      find_curves();
    }
  }

  void divide() {
    std::vector<double> angles;
    for (const Curve& curve : curves_) {
      const double angle = std::atan2(-curve.normal[0], curve.normal[1]);
      for (const double each : {angle, angle > 0 ? angle - pi : angle + pi}) {
        const auto same = [&](double known) { return std::abs(std::remainder(known - each, 2 * pi)) < 1e-6; };
        if (std::ranges::none_of(angles, same)) angles.push_back(each);
      }
    }
    std::ranges::sort(angles);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double next = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2 * pi;
      Region region(field_, beside((angles[i] + next) / 2));
      const auto f = value_of(region.field().value, x_);
      complete_ &= f.has_value();
      if (f) speed_ = std::max(speed_, f->norm());
      sectors_.push_back({angles[i], std::move(region), f.value_or(Vector2d(0, 0))});
    }
  }

  Vector2d beside(double angle) const {
    constexpr double part = 1e-11;  // longer than rounding, and shorter than the distance of curves that count as apart
    return x_ + part * size_ * direction(angle);
  }

  /// Returns the sign of the rate of a switching function along a field, at the point or, if the rate is 0 there, a
  /// little later on a way; 0 if it is 0 there, too.
  int heading(const SmoothField& along, Index function, const Vector2d& way) const {
    constexpr double ahead = 1e-4;
    for (const double part : {0., ahead}) {
      const Vector2d x = way.isZero(0) ? x_ : Vector2d(x_ + part * size_ / way.norm() * way);
      const auto f = value_of(along.value, x);
      if (!f) return 0;
      const auto [rate, least] = rate_along(field_, function, x, *f, speed_);
      if (std::abs(rate) > least) return rate > 0 ? 1 : -1;
    }
    return 0;
  }

  bool enters(const Sector& sector) const {
    return std::ranges::all_of(curves_, [&](const Curve& curve) {
      const int sign = sector.region.signs_[static_cast<std::size_t>(curve.function)];
      return heading(sector.region.field(), curve.function, sector.f) * sign > 0;
    });
  }

  std::optional<Region> slide(std::size_t i, bool& ambiguous) const;

  const SmoothField& field_;
  double size_, speed_ = 0;
  Vector2d x_;
  bool complete_ = true;  ///< the field has a value on all sides
  std::vector<Curve> curves_ = {};
  std::vector<Sector> sectors_ = {};
};

/// Returns the region of the motions that slide away from the point along the half tangent before a sector.
std::optional<Region> Junction::slide(std::size_t i, bool& ambiguous) const {
  const Sector &first = sectors_[i], &second = sectors_[(i + sectors_.size() - 1) % sectors_.size()];
  const Vector2d along = direction(first.from);
  const auto lies_along = [&](const Curve& curve) { return std::abs(curve.normal.dot(along)) < 1e-6; };
  const Index function = std::ranges::find_if(curves_, lies_along)->function;
  const double sign = first.region.signs_[static_cast<std::size_t>(function)];
  const SmoothField &f = first.region.field(), &g = second.region.field();
  const auto value = [switches = field_.switches, function, f = f.value, g = g.value](const Vector2d& x) -> Vector2d {
    const Vector2d gradient = switches(x).row(function).tail<2>(), one = f(x), other = g(x);
    return sliding_velocity(one, other, gradient.dot(one), gradient.dot(other));
  };
  // Both rates are 0 at the end of a curve that is an orbit of one side. There the point ahead decides.
  constexpr double rounding = 1e-13, apart = 1e-6, ahead = 1e-4;
  Vector2d from = x_;
  const auto rate_at = [&](const SmoothField& of) {
    const auto [rate, least] = rate_along(field_, function, from, of(from), speed_);
    return std::abs(rate) > least ? rate : 0;
  };
  if (rate_at(f) == 0 && rate_at(g) == 0) {
    from = towards_curve(field_, function, from + ahead * size_ * along);
  }
  const Vector2d velocity = value(from);
  if (!(velocity.dot(along) > rounding * speed_)) return std::nullopt;
  const bool moved = from != x_;
  const double of_first = sign * (moved ? rate_at(f) : heading(f, function, velocity));
  const double of_second = sign * (moved ? rate_at(g) : heading(g, function, velocity));
  if (of_first > 0 || of_second < 0) return std::nullopt;
  ambiguous |= of_first == 0 && of_second == 0 && (first.f - second.f).norm() > apart * speed_;

  Region region(field_, beside(first.from));
  for (const Curve& curve : curves_) {
    if (lies_along(curve)) region.signs_[static_cast<std::size_t>(curve.function)] = 0;
  }
  region.slide_ = Region::Slide{function, sign, f, g};
  // Newton's method and the linear flow near a zero need slopes, but not to the last digits.
  const double step = 1e-6 * size_;
  region.continued_ = SmoothField(value, [value, step](const Vector2d& x) {
    Eigen::Matrix2d slopes;
    for (int j = 0; j < 2; ++j) {
      const Vector2d aside = step * Vector2d::Unit(j);
      slopes.col(j) = (value(x + aside) - value(x - aside)) / (2 * step);
    }
    return slopes;
  });
  return region;
}

Onward Junction::onward() const {
  Onward result{x_};
  if (!complete_) {
    result.reason = "the field has no value beyond";
    return result;
  }
  int ways = 0;
  for (std::size_t i = 0; i < sectors_.size(); ++i) {
    if (enters(sectors_[i])) {
      ++ways;
      result.region = sectors_[i].region;
    }
    if (auto along = slide(i, result.ambiguous)) {
      ++ways;
      result.region = std::move(along);
    }
  }
  if (ways == 1 && !result.ambiguous) return result;
  result.region.reset();
  const bool cross_here = sectors_.size() > 2;
  if (ways > 0) {
    result.ambiguous = true;
    result.reason = cross_here ? "switching curves cross and the motion is not unique"
                               : "both sides point away from a switching curve and the motion is not unique";
    return result;
  }
  // The hull of the velocities contains 0 unless they lie within a half plane.
  constexpr double rounding = 1e-13, slack = 1e-9;
  std::vector<double> angles;
  for (const Sector& sector : sectors_) {
    result.rests |= sector.f.norm() <= rounding * speed_;
    angles.push_back(std::atan2(sector.f[1], sector.f[0]));
  }
  std::ranges::sort(angles);
  double widest = angles.front() + 2 * pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
  result.rests |= widest <= pi + slack;
  if (!result.rests) result.reason = "rounding hides which motion leaves a switching curve";
  return result;
}

std::optional<Onward> onward(const SmoothField& field, const Vector2d& x, double size) {
  if (!field.switches || !field.branch) return std::nullopt;
  const Junction junction(field, x, size);
  return junction.exists() ? std::optional(junction.onward()) : std::nullopt;
}

}  // namespace contensou::reduction
