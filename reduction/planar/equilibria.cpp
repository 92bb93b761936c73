// Zeros of a field. Lengths are measured in half sides of the rectangle: z = x/half, g(z) = f(x)/half.
//
// Simple zeros. Newton's method ends at a point with a small g. If the Jacobian J has the least singular value s, the
// zero is at most d = 2 (|g| + rounding)/s away, if the Jacobian changes by less than s/4 over d (Kantorovich). The
// rounding of g is measured: close to the point g is linear, and what is left is rounding. Over d the Jacobian changes
// by at most e = d |J'|. Thus trace and determinant have the errors 2 e and 2 |J| e, and a number below its error has
// no sign. At a multiple zero s and the determinant vanish, and Taylor's polynomial decides (degenerate_point.cpp).
//
// Flat zeros. Newton's steps to an m-fold zero shrink by the factor 1 - 1/m, so m steps at once lead to it. At an order
// above that of the polynomial the place counts if the field is not 0 on a circle of radius 1e-6 about it, nor there on
// the curve on which the component across the flat direction is 0. "Not 0" means that a component of g is larger than
// its own rounding: x^12 is not 0 at 1e-6, but an expanded (x - 1)^12 is 0 within 0.05 of 1. If one eigenvalue is not
// 0, the index decides the kind by the reduction to the centre manifold: 0 saddle-node, 1 node, -1 saddle. If both are
// 0 and the Jacobian is not, the index -1 is that of a saddle (A. Andreev 1958). A curve of zeros is one only if the
// field vanishes far from the point, too.
//
// Sides. At small distances r in several directions, the increments of g are compared with the linear map that fits
// best. For a smooth field the misfit divided by r is proportional to r. At a kink it is constant; at a jump it grows.
//
// Search. A cell of the grid has no zero if a component of g is larger at its middle than its linear change over
// the cell and twice the deviations of the corners from linearity. Other cells are divided until the field is nearly
// linear in the cell. A cell for which neither holds in the end, and which has no zero found in it, is unexplained.
#include "contensou/reduction/planar_reduction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/LU>

#include "contensou/reduction/detail/infinity.hpp"
#include "numerics/decomposition.hpp"
#include "numerics/epsilon.hpp"
#include "planar/degenerate_point.hpp"
#include "planar/differences.hpp"
#include "planar/inverse_factor.hpp"
#include "planar/reversal.hpp"

namespace contensou::reduction {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using std::numbers::pi;

namespace {

constexpr double same = 2e-6;      ///< two zeros that are closer count as one, in half sides
constexpr double explained = 0.1;  ///< a flat place this near to a zero belongs to it

Vector2d direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// A field in units of the half sides of a rectangle, about any point x.
class ScaledField {
 public:
  ScaledField(const SmoothField& field, const Vector2d& half) : field_(field), half_(half) {}

  const PlanarField& unscaled() const { return field_.value; }
  const Vector2d& half() const { return half_; }
  Vector2d moved(const Vector2d& x, const Vector2d& z) const { return x + half_.cwiseProduct(z); }
  double distance(const Vector2d& a, const Vector2d& b) const { return (a - b).cwiseQuotient(half_).norm(); }

  std::optional<Vector2d> operator()(const Vector2d& x) const {
    const auto f = value_of(field_.value, x);
    return f ? std::optional<Vector2d>(f->cwiseQuotient(half_)) : std::nullopt;
  }

  struct Linear {
    Vector2d g;
    Matrix2d slopes;
    double error = 0;  ///< error of the slopes
  };

  /// Returns g with its Jacobian. Without a formula of the Jacobian, its digits are halved unless `exact`.
  std::optional<Linear> linear(const Vector2d& x, bool exact) const {
    const auto g = (*this)(x);
    if (!g) return std::nullopt;
    Linear result{*g, Matrix2d::Zero()};
    if (field_.jacobian) {
      try {
        result.slopes = half_.cwiseInverse().asDiagonal() * field_.jacobian(x) * half_.asDiagonal();
      } catch (const std::exception&) {
        return std::nullopt;
      }
    } else {
      constexpr double first = 1. / 64, nearest = 1e-5;
      const auto along = [&](const Vector2d& z) { return (*this)(moved(x, z)); };
      for (int i = 0; i < 2; ++i) {
        const Vector2d step = nearest * Vector2d::Unit(i);
        if (exact) {
          const auto found = slope(along, Vector2d(0, 0), i, first);
          if (!found) return std::nullopt;
          result.slopes.col(i) = found->value;
          result.error += found->error;
        } else {
          const auto ahead = along(step), behind = along(-step);
          if (!ahead || !behind) return std::nullopt;
          result.slopes.col(i) = (*ahead - *behind) / (2 * nearest);
        }
      }
    }
    return result.slopes.allFinite() ? std::optional(result) : std::nullopt;
  }

  /// Returns the rounding of the components of g: their second differences at a distance at which these are tiny.
  Vector2d rounding(const Vector2d& x, const Linear& at) const {
    constexpr double near = 1e-9;
    Vector2d largest = eps * at.slopes.cwiseAbs() * x.cwiseQuotient(half_).cwiseAbs();
    for (int i = 0; i < 8; ++i) {
      const Vector2d z = near * direction(2 * pi * (i + 0.37) / 16), ahead = moved(x, z), behind = moved(x, -z);
      const auto there = (*this)(ahead), back = (*this)(behind);
      if (!there || !back) continue;
      // The steps themselves are rounded.
      const Vector2d made = ((ahead - x) + (behind - x)).cwiseQuotient(half_);
      largest = largest.cwiseMax((*there + *back - 2 * at.g - at.slopes * made).cwiseAbs());
    }
    return largest;
  }

  /// Returns true if a component of g is certainly not 0, although it may be tiny, and exceeds its value elsewhere.
  bool differs_from_zero(const Vector2d& x, const Linear& at, const Vector2d& elsewhere = {0, 0}) const {
    constexpr double roundings = 8, times = 100;
    const Vector2d least = (roundings * rounding(x, at)).cwiseMax(times * elsewhere.cwiseAbs());
    return (at.g.cwiseAbs().array() > least.array()).any();
  }

  /// Returns true if x lies on a switching curve, or if the field has no switching functions.
  bool may_switch(const Vector2d& x, double nearer) const {
    if (!field_.switches) return true;
    try {
      const Eigen::MatrixX3d rows = field_.switches(x);
      for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        const double slope = rows.row(i).tail<2>().transpose().cwiseProduct(half_).norm();
        if (!(std::abs(rows(i, 0)) > nearer * slope) || !std::isfinite(slope)) return true;
      }
      return false;
    } catch (const std::exception&) {
      return true;
    }
  }
  bool has_switches() const { return static_cast<bool>(field_.switches); }

 private:
  const SmoothField& field_;
  Vector2d half_;
};

/// Comparison of the sides of a point.
struct Sides {
  bool smooth = true;  ///< true if one linear map fits on all sides
  bool jump = false;   ///< true if the field does not tend to its value at the point
};

Sides compare_sides(const ScaledField& field, const Vector2d& x) {
  constexpr double nearer = 1e-7, far = 1e-5;
  if (!field.may_switch(x, nearer)) return {};
  const auto here = field(x);
  if (!here) return {false, true};
  const int directions = field.has_switches() ? 64 : 16;
  struct Scale {
    double misfit = 0, slopes = 0, change = 0;
  };
  const auto at = [&](double radius) -> std::optional<Scale> {
    std::vector<Vector2d> changes;
    Matrix2d linear = Matrix2d::Zero();
    for (int i = 0; i < directions; ++i) {
      const Vector2d n = direction(2 * pi * (i + 0.37) / directions);
      const auto there = field(field.moved(x, radius * n));
      if (!there) return std::nullopt;
      changes.emplace_back((*there - *here) / radius);
      linear += 2. / directions * changes.back() * n.transpose();
    }
    Scale scale{0, linear.norm(), 0};
    for (int i = 0; i < directions; ++i) {
      const Vector2d& change = changes[static_cast<std::size_t>(i)];
      scale.misfit = std::max(scale.misfit, (change - linear * direction(2 * pi * (i + 0.37) / directions)).norm());
      scale.change = std::max(scale.change, radius * change.norm());
    }
    return scale;
  };
  const auto wide = at(far), close = at(nearer);
  if (!wide || !close) return {false, false};
  constexpr double constant = 0.3, visible = 1e-6;
  Sides sides;
  sides.smooth = !(close->misfit > constant * wide->misfit && close->misfit > visible * close->slopes);
  sides.jump = !sides.smooth && close->change > constant * wide->change;
  return sides;
}

/// Returns the turns of the field on a circle; empty if they are not known.
std::optional<int> turns(const ScaledField& field, const Vector2d& x, double radius) {
  constexpr int pieces = 32, deepest = 50;
  const auto at = [&](double angle) -> std::optional<Vector2d> {
    const auto g = field(field.moved(x, radius * direction(angle)));
    return g && g->norm() > 0 ? std::optional<Vector2d>(g->stableNormalized()) : std::nullopt;
  };
  const auto turned = [&](auto&& self, double from, const Vector2d& a, double to, const Vector2d& b,
                          int depth) -> std::optional<double> {
    constexpr double largest = 0.8;
    const double angle = std::atan2(cross(a, b), a.dot(b));
    if (std::abs(angle) < largest) return angle;
    if (depth == deepest) return std::nullopt;
    const double middle = (from + to) / 2;
    const auto there = at(middle);
    if (!there) return std::nullopt;
    const auto one = self(self, from, a, middle, *there, depth + 1);
    if (!one) return std::nullopt;
    const auto other = self(self, middle, *there, to, b, depth + 1);
    return other ? std::optional(*one + *other) : std::nullopt;
  };
  double sum = 0;
  auto before = at(0);
  const auto first = before;
  for (int i = 1; i <= pieces && before; ++i) {
    const auto here = i < pieces ? at(2 * pi * i / pieces) : first;
    if (!here) return std::nullopt;
    const auto part = turned(turned, 2 * pi * (i - 1) / pieces, *before, 2 * pi * i / pieces, *here, 0);
    if (!part) return std::nullopt;
    sum += *part;
    before = here;
  }
  return before ? std::optional(static_cast<int>(std::lround(sum / (2 * pi)))) : std::nullopt;
}

/// Returns true if the field vanishes at two places of a circle, as where a curve of zeros enters and leaves it. One
/// place suffices if the field has no value on a part of the circle.
bool vanishes_on_circle(const ScaledField& field, const Vector2d& x, double radius) {
  constexpr int pieces = 64;
  constexpr double zero = 1e-12;
  const auto size = [&](double angle) {
    const auto g = field(field.moved(x, radius * direction(angle)));
    return g ? g->norm() : infinity;
  };
  std::array<double, pieces> sizes;
  for (std::size_t i = 0; i < pieces; ++i) sizes[i] = size(2 * pi * static_cast<double>(i) / pieces);
  double largest = 0;
  int places = 0;
  for (const double each : sizes) {
    if (each < infinity) largest = std::max(largest, each);
    if (each == infinity) places = 1;
  }
  for (std::size_t i = 0; i < pieces && places < 2; ++i) {
    const double here = sizes[i];
    if (here > sizes[(i + 1) % pieces] || here > sizes[(i + pieces - 1) % pieces]) continue;
    // Golden sections also find the least value of |g| at a simple zero, where |g| has a corner.
    double low = 2 * pi * (static_cast<double>(i) - 1) / pieces, high = low + 4 * pi / pieces;
    for (int step = 0; step < 75; ++step) {
      const double part = (high - low) / (1 + std::numbers::phi), left = low + part, right = high - part;
      const bool nearer = size(left) < size(right);
      (nearer ? high : low) = nearer ? right : left;
    }
    const Vector2d at = field.moved(x, radius * direction((low + high) / 2));
    const auto g = field(at);
    if (!g || !(g->norm() <= zero * largest)) continue;
    // On a kink the field has no slopes.
    const auto there = field.linear(at, true).value_or(ScaledField::Linear{*g, Matrix2d::Zero()});
    const Vector2d by_angle = eps * radius * there.slopes.rowwise().norm();  // the angle has its own rounding
    if (!field.differs_from_zero(at, there, by_angle)) ++places;
  }
  return places > 1;
}

/// Returns true if Newton's method finds another zero beside `zero`, in the direction in which the field is constant.
/// @param beside  distance at which the method begins; its sign is the side
/// @param steps   Newton's method reaches a simple zero in a few steps, but a multiple zero only in many
bool on_simple_curve_of_zeros(const ScaledField& field, const Vector2d& zero, const Matrix2d& slopes, double beside,
                              int steps) {
  constexpr double left = 1e-12, apart = 0.5;
  const bool first = slopes.row(0).squaredNorm() >= slopes.row(1).squaredNorm();
  const Vector2d row = slopes.row(first ? 0 : 1);
  const Vector2d along = beside * (row.isZero(0) ? Vector2d(0, 1) : Vector2d(-row[1], row[0]).stableNormalized());
  Vector2d z = along;
  for (int i = 0; i < steps; ++i) {
    const auto here = field.linear(field.moved(zero, z), false);
    if (!here) break;
    if (!here->g.isZero(0)) z -= least_squares(here->slopes, here->g);
  }
  const auto there = field.linear(field.moved(zero, z), false);
  if (!there || z.norm() <= apart * along.norm()) return false;
  if (there->g.norm() > left * there->slopes.norm() * along.norm()) return false;
  if (!there->g.isZero(0)) z -= least_squares(there->slopes, there->g);
  const auto last = field.linear(field.moved(zero, z), true);
  return last && !field.differs_from_zero(field.moved(zero, z), *last);
}

/// Returns the eigenvalues of a matrix with a trace and a determinant, the square root in them being real if square >
/// 0.
Equilibrium::Eigenvalues eigenvalues_of(double trace, double determinant, double square) {
  const double half = trace / 2, root = std::sqrt(std::abs(square));
  if (square < 0) return {{half, -root}, {half, root}};
  if (square == 0) return {half, half};
  // The smaller eigenvalue is the quotient of the determinant and the larger one, so that no digits cancel.
  const double large = half + std::copysign(root, half), small = large == 0 ? 0 : determinant / large;
  return {std::min(large, small) + 0., std::max(large, small) + 0.};
}

/// The search for zeros in a rectangle.
class ZeroSearch {
 public:
  ZeroSearch(const SmoothField& field, const Vector2d& low, const Vector2d& high)
      : field_(field, (high - low) / 2), low_(low), high_(high) {}

  Equilibria run();

 private:
  struct Zero {
    Equilibrium point;
    double radius;  ///< multiple zeros nearer than this, in half sides, are the same
  };
  struct Cell {
    Vector2d x;
    double half;
  };

  Vector2d place(const Vector2d& x) const { return (x - low_).cwiseQuotient(high_ - low_); }
  bool found_near(const Vector2d& x, double distance) const {
    return std::ranges::any_of(zeros_, [&](const Zero& zero) { return field_.distance(x, zero.point.x) < distance; }) ||
           std::ranges::any_of(others_, [&](const Vector2d& other) { return field_.distance(x, other) < distance; });
  }
  void follow(Vector2d x, double reach);
  void examine(Vector2d x);
  std::optional<Equilibrium> simple(const Vector2d& x, const ScaledField::Linear& at) const;
  bool is_alone(const Vector2d& x, const ScaledField::Linear& at) const;
  void add(const Equilibrium& point, double radius) { zeros_.push_back({point, radius}); }
  void divide(const Cell& cell, const std::array<std::optional<Vector2d>, 4>& corners, int depth);
  void find_indices();
  void name_curve(const Vector2d& x);

  ScaledField field_;
  Vector2d low_, high_;
  std::vector<Zero> zeros_;
  std::vector<Vector2d> others_;  ///< zeros on curves of zeros, jumps, and points that look like zeros
  std::vector<Vector2d> curves_;  ///< multiple zeros on curves of zeros
  std::vector<Vector2d> flats_;   ///< points next to which rounding hides where the field is 0
  std::vector<Cell> unexplained_;
  int cells_ = 0;
  std::optional<Vector2d> on_curve_ = {};
  bool complete_ = true;
};

/// Follows Newton's method from x.
/// @param reach  largest distance from x; zeros farther away are found from the cells in which they lie
void ZeroSearch::follow(Vector2d x, double reach) {
  constexpr int most = 100, quick = 12;  // near a multiple zero a step only halves the distance
  constexpr double exact = 2e-13, multiple = 1e-3, slow = 0.8, steady = 0.01, tiny = 1e-12;
  const Vector2d from = x;
  Vector2d last(0, 0), before(0, 0);  // steps
  for (int step = 0; step < most; ++step) {
    const auto here = field_.linear(x, false);
    if (!here) return;
    // Beside a flat zero a component and its slopes are tiny, but right except for their own rounding.
    const Vector2d rows = here->slopes.rowwise().norm();
    const bool flat = rows.minCoeff() > 0 && rows.minCoeff() < tiny * rows.maxCoeff();
    const Vector2d unit = flat ? rows : Vector2d(1, 1);
    const auto lu = (unit.cwiseInverse().asDiagonal() * here->slopes).eval().fullPivLu();
    Vector2d way = here->g.isZero(0) ? Vector2d(0, 0) : Vector2d(lu.solve(here->g.cwiseQuotient(unit)));
    const auto shrinks = [&](const Vector2d& a, const Vector2d& b) { return a.dot(b) / b.squaredNorm(); };
    const double factor = shrinks(way, last);
    const bool steadily = factor > slow && factor < 1 && (way - factor * last).norm() <= steady * way.norm() &&
                          std::abs(shrinks(last, before) - factor) <= steady * (1 - factor);
    before = steadily ? Vector2d(0, 0) : last;
    last = steadily ? before : way;
    if (steadily) way /= 1 - factor;
    const Vector2d next = field_.moved(x, -way);
    if (!(field_.distance(next, from) <= reach)) {
      if (step <= quick) return;
      break;  // beside a multiple zero the Jacobian is at last only rounding
    }
    x = next;
    if (step > 0 && found_near(x, step > quick ? multiple : same)) return;
    if (way.norm() <= exact) break;
  }
  examine(x);
}

/// Returns true if the field is certainly not 0 close around a zero, also where its larger part is 0.
bool ZeroSearch::is_alone(const Vector2d& x, const ScaledField::Linear& at) const {
  constexpr int around = 16, steps = 3;
  constexpr double beside = 1e-6;
  const SingularValues svd(at.slopes);
  for (int i = 0; i < around + 2; ++i) {
    const bool flat = i >= around;
    Vector2d z = beside * (flat ? Vector2d((2 * (i - around) - 1) * svd.V.col(1)) : direction(2 * pi * i / around));
    for (int step = 0; flat && step < steps && svd.values[0] > 0; ++step) {
      const auto g = field_(field_.moved(x, z));
      if (g) z -= svd.U.col(0).dot(*g) / svd.values[0] * svd.V.col(0);
    }
    const Vector2d there = field_.moved(x, z);
    const auto beyond = field_.linear(there, true);
    if (!beyond || !field_.differs_from_zero(there, *beyond, at.g)) return false;
  }
  return true;
}

/// Returns the equilibrium if x is a simple zero by the bounds of its errors, else nothing.
std::optional<Equilibrium> ZeroSearch::simple(const Vector2d& x, const ScaledField::Linear& at) const {
  const Matrix2d& slopes = at.slopes;
  const double norm = slopes.norm(), determinant = slopes.determinant(), trace = slopes.trace();
  if (determinant == 0) return std::nullopt;
  const double least = std::abs(determinant) / norm;  // not above the least singular value
  constexpr double step = 1e-3, roundings = 8;
  double change = -1;
  for (int i = 0; i < 4; ++i) {
    const Vector2d z = step * direction(pi / 2 * i);
    const auto there = field_.linear(field_.moved(x, z), false);
    if (there) change = std::max(change, (there->slopes - slopes).norm() / step);
  }
  if (change < 0) return std::nullopt;
  const double away = 2 * (at.g.norm() + field_.rounding(x, at).norm()) / least;
  if (!(4 * away * change < least)) return std::nullopt;
  const double error = change * away + roundings * eps * norm + at.error;
  const double of_determinant = 2 * norm * error, of_trace = 2 * error;
  if (!(std::abs(determinant) > of_determinant)) return std::nullopt;
  const double true_trace = std::abs(trace) > of_trace ? trace : 0;
  double square = std::pow((slopes(0, 0) - slopes(1, 1)) / 2, 2) + slopes(0, 1) * slopes(1, 0);
  if (true_trace == 0) square = -determinant;
  if (std::abs(square) <= std::abs(trace) * error + of_determinant) square = 0;
  Equilibrium point{x, field_.half().asDiagonal() * slopes * field_.half().cwiseInverse().asDiagonal()};
  point.eigenvalues = eigenvalues_of(true_trace, determinant, square);
  point.index = determinant > 0 ? 1 : -1;
  const int turning = determinant > 0 && trace == 0 ? lyapunov_sign(field_.unscaled(), x, field_.half()) : 0;
  point.kind = determinant < 0   ? planar_kind("saddle")
               : turning != 0    ? (turning < 0 ? planar_kind("stable focus") : planar_kind("unstable focus"))
               : true_trace == 0 ? planar_kind("center or focus")
               : square < 0      ? (trace < 0 ? planar_kind("stable focus") : planar_kind("unstable focus"))
                                 : (trace < 0 ? planar_kind("stable node") : planar_kind("unstable node"));
  return point;
}

/// Keeps a point of a curve of zeros, if both components of the field vanish there, also a component that is tiny.
void ZeroSearch::name_curve(const Vector2d& x) {
  constexpr double small = 1e-6;
  const auto jet = jet_of(field_.unscaled(), x);
  if (on_curve_ || !jet) return;
  const Vector2d change = jet->slopes.cwiseAbs() * field_.half();
  if ((jet->f.cwiseAbs().array() <= small * change.array()).all()) on_curve_ = x;
}

/// Finds out whether Newton's method has ended at a zero, and of which kind.
void ZeroSearch::examine(Vector2d x) {
  constexpr double snap = 2e-9, coarse = 1e-5, apart = 0.02, beside = 0.05, slack = 1e-9, near = 0.04, far = 0.5;
  const auto inside = [&](const Vector2d& at) {
    return place(at).minCoeff() >= -slack && place(at).maxCoeff() <= 1 + slack;
  };
  if (!inside(x) || found_near(x, same)) return;
  const auto rounded = few_decimals(field_.unscaled(), x, field_.half(), snap);
  if (!rounded) return others_.push_back(x);  // the field has no value at the zero, such as 0/0
  x = *rounded;
  if (!inside(x) || found_near(x, same)) return;
  const Vector2d g = field_(x).value_or(Vector2d::Constant(infinity));
  double around = 0;
  for (int i = 0; i < 8; ++i) {
    const auto there = field_(field_.moved(x, beside * direction(pi / 4 * i)));
    if (there) around = std::max(around, there->norm());
  }
  // A singular Jacobian can give a step of length 0 at a point that is no zero. Therefore test the field itself.
  constexpr double small = 1e-9;
  if (!(g.norm() <= small * around)) return;
  const Matrix2d none = Matrix2d::Constant(std::numeric_limits<double>::quiet_NaN());
  const auto beside_it = [&](const Vector2d& other) { return field_.distance(x, other) < apart; };
  const auto vanishes = [&](double radius) { return vanishes_on_circle(field_, x, radius); };
  const auto vanishes_near = [&] { return vanishes(0.05) && vanishes(0.02); };
  const Sides sides = compare_sides(field_, x);
  if (!sides.smooth) {
    if (sides.jump && !g.isZero(0)) return others_.push_back(x);
    const bool known_curve = std::ranges::any_of(curves_, beside_it);
    if (!known_curve && !vanishes_near()) return add({x, none, planar_kind("not smooth")}, same);
    if (!known_curve) curves_.push_back(x);
    name_curve(x);
    return others_.push_back(x);
  }
  const auto at = field_.linear(x, true);
  if (!at) return add({x, none}, same);
  // Between waves that are shorter than the steps of the differences, these are no slopes.
  constexpr double like = 1e-3;
  const auto close = field_.linear(x, false);
  if (!close || (close->slopes - at->slopes).norm() > like * (at->slopes.norm() + around / beside)) {
    complete_ = false;
    return others_.push_back(x);
  }
  if (const auto point = simple(x, *at)) return add(*point, same);
  const auto meets_curve = [&](double distance, int steps) {
    return on_simple_curve_of_zeros(field_, x, at->slopes, distance, steps);
  };
  const bool near_curve = meets_curve(near, 3);
  if (near_curve && meets_curve(far, 8) && meets_curve(-far, 8)) {
    name_curve(x);
    return others_.push_back(x);
  }
  const auto of_multiple = [&](const Zero& zero) { return field_.distance(x, zero.point.x) < zero.radius; };
  if (std::ranges::any_of(zeros_, of_multiple) || std::ranges::any_of(curves_, beside_it)) return others_.push_back(x);
  if (std::ranges::any_of(flats_, beside_it) && (field_.differs_from_zero(x, *at) || !is_alone(x, *at))) return;
  // Newton's method halves the distance to a multiple zero only. If there is a point of few decimals at which the field
  // is smaller, it is the better zero.
  const auto better = few_decimals(field_.unscaled(), x, field_.half(), coarse);
  if (better && *better != x) return examine(*better);
  if ((near_curve || vanishes_near()) && vanishes(far) && vanishes(0.7 * far)) {
    curves_.push_back(x);
    name_curve(x);
    return others_.push_back(x);
  }
  const auto multiple = degenerate_point(field_.unscaled(), x, field_.half());
  Equilibrium point{x, field_.half().asDiagonal() * at->slopes * field_.half().cwiseInverse().asDiagonal()};
  if (multiple) {
    if (!inside(multiple->x) || found_near(multiple->x, same)) return;
    point.x = multiple->x;
    point.kind = multiple->kind;
    point.eigenvalues = {std::min(multiple->rate, 0.), std::max(multiple->rate, 0.)};
    if (const auto there = field_.linear(point.x, true)) {
      point.slopes = field_.half().asDiagonal() * there->slopes * field_.half().cwiseInverse().asDiagonal();
    }
  } else {
    // No polynomial describes the field. The point counts if the field vanishes within rounding, and not beside it.
    if (field_.differs_from_zero(x, *at)) return;
    if (!is_alone(x, *at)) return flats_.push_back(x);
    const double determinant = at->slopes.determinant(), trace = at->slopes.trace(), norm = at->slopes.norm();
    if (std::abs(determinant) > small * norm * norm) return add({x, none}, same);
    point.eigenvalues = {std::min(trace, 0.), std::max(trace, 0.)};
    if (std::abs(trace) <= std::sqrt(small) * norm) point.eigenvalues = {0, 0};
  }
  add(point, apart);
}

/// Divides a cell until the field is nearly linear in it or has no zero, and follows Newton's method from the parts.
/// @param corners  g at (-1, -1), (1, -1), (-1, 1) and (1, 1)
void ZeroSearch::divide(const Cell& cell, const std::array<std::optional<Vector2d>, 4>& corners, int depth) {
  constexpr int deepest = 5, deepest_without_value = 3, most = 8000;
  constexpr double widest = 0.2, bent = 0.5, clear = 0.2, like = 0.25;
  const auto here = field_.linear(cell.x, false);
  // Zeros farther away are found from the cells in which they lie.
  if (here) follow(cell.x, depth == 0 ? widest : 4 * cell.half);
  const bool all = here && std::ranges::all_of(corners, [](const auto& g) { return g.has_value(); });
  if (!here && std::ranges::none_of(corners, [](const auto& g) { return g.has_value(); })) return;
  bool linear = all, very_linear = all;
  if (all) {
    for (int i = 0; i < 2; ++i) {
      const double change = cell.half * here->slopes.row(i).lpNorm<1>();
      double deviation = 0;
      for (int j = 0; j < 4; ++j) {
        const Vector2d z = cell.half * Vector2d(j % 2 == 0 ? -1 : 1, j < 2 ? -1 : 1);
        deviation =
            std::max(deviation, std::abs((*corners[static_cast<std::size_t>(j)] - here->g - here->slopes * z)[i]));
      }
      if (std::abs(here->g[i]) > change + 2 * deviation) return;
      linear &= deviation <= bent * change;
      very_linear &= deviation <= clear * change;
    }
  }
  if (linear) {
    // Newton's method must have found the zero that the linear part predicts.
    const Vector2d z = here->slopes.fullPivLu().solve(here->g);
    if (very_linear && z.lpNorm<Eigen::Infinity>() <= cell.half) unexplained_.push_back(cell);
    return;
  }
  if (depth >= (all ? deepest : deepest_without_value) || cells_ > most) {
    complete_ &= cells_ <= most;
    // Beside a jump Newton's method does not lead to a point at which the field is 0 by definition.
    const auto simple = few_decimals(field_.unscaled(), cell.x, field_.half(), 2 * cell.half);
    if (simple && field_(*simple)->isZero(0)) examine(*simple);
    const auto is_clear = [&](const auto& of) {
      double least = infinity, largest = -infinity;
      const auto include = [&](const Vector2d& g) {
        least = std::min<double>(least, of(g));
        largest = std::max<double>(largest, of(g));
      };
      if (here) include(here->g);
      for (const auto& corner : corners) {
        if (corner) include(*corner);
      }
      return least * largest > 0 &&
             std::min(std::abs(least), std::abs(largest)) >= like * std::max(std::abs(least), std::abs(largest));
    };
    // Beside a jump or a pole a component of one sign, or |g|, does not come near to 0.
    if (is_clear([](const Vector2d& g) { return g[0]; }) || is_clear([](const Vector2d& g) { return g[1]; }) ||
        is_clear([](const Vector2d& g) { return g.norm(); })) {
      return;
    }
    unexplained_.push_back(cell);
    return;
  }
  std::array<std::optional<Vector2d>, 9> lattice;
  for (int j = 0; j < 9; ++j) {
    const int column = j % 3, row = j / 3;
    auto& g = lattice[static_cast<std::size_t>(j)];
    if (column != 1 && row != 1) {
      const int corner = column / 2 + row;
      g = corners[static_cast<std::size_t>(corner)];
    } else {
      g = field_(field_.moved(cell.x, cell.half * Vector2d(column - 1, row - 1)));
    }
  }
  for (int j = 0; j < 4; ++j) {
    const int column = j % 2, row = j / 2;
    const auto at = [&](int i, int k) {
      const int place = 3 * (row + k) + column + i;
      return lattice[static_cast<std::size_t>(place)];
    };
    ++cells_;
    divide({field_.moved(cell.x, cell.half * Vector2d(column - 0.5, row - 0.5)), cell.half / 2},
           {at(0, 0), at(1, 0), at(0, 1), at(1, 1)}, depth + 1);
  }
}

/// Finds the index of each zero that is not simple, and compares the index with the kind.
void ZeroSearch::find_indices() {
  constexpr double usual = 0.1, widest = 0.4, part = 0.3, smaller = 0.5;
  for (Zero& zero : zeros_) {
    Equilibrium& point = zero.point;
    if (point.index) continue;
    double allowed = widest;
    for (const Zero& other : zeros_) {
      if (&other != &zero) allowed = std::min(allowed, part * field_.distance(point.x, other.point.x));
    }
    for (const Vector2d& flat : flats_) {
      if (const double away = field_.distance(point.x, flat); away > zero.radius)
        allowed = std::min(allowed, part * away);
    }
    // On a small circle a flat field is only rounding.
    const double last = point.kind == "degenerate" ? widest : usual;
    for (double radius = usual; !point.index && radius <= last; radius *= 2) {
      const double used = std::min(radius, allowed);
      const auto index = turns(field_, point.x, used), again = turns(field_, point.x, smaller * used);
      if (index == again) point.index = index;
    }
    if (point.kind == "not smooth") continue;
    const bool none = point.kind == "cusp" || point.kind == "saddle-node";
    const bool known = point.kind == "saddle" || none || point.kind.ends_with("node") || point.kind.ends_with("focus");
    if (known && point.index != (none ? 0 : point.kind == "saddle" ? -1 : 1)) point.kind = planar_kind("degenerate");
    if (point.kind != "degenerate" || !point.eigenvalues || !point.index || point.slopes.isZero(0)) continue;
    const double rate = (point.eigenvalues->first + point.eigenvalues->second).real();
    if (*point.index == -1) {
      point.kind = planar_kind("saddle");
    } else if (rate != 0 && *point.index == 0) {
      point.kind = planar_kind("saddle-node");
    } else if (rate != 0 && *point.index == 1) {
      point.kind = rate < 0 ? planar_kind("stable node") : planar_kind("unstable node");
    }
  }
}

Equilibria ZeroSearch::run() {
  constexpr int across = 40;
  constexpr double near = 6;  // Newton's first step leads into a cell from as many cells as the multiplicity of a zero
  const auto lattice = [&](double column, double row) {
    return Vector2d(low_ + Vector2d(column, row).cwiseProduct(high_ - low_) / across);
  };
  std::vector<std::optional<Vector2d>> before, above;
  for (int row = 0; row <= across; ++row) {
    above.clear();
    for (int column = 0; column <= across; ++column) above.push_back(field_(lattice(column, row)));
    for (std::size_t column = 0; row > 0 && column < across; ++column) {
      divide({lattice(static_cast<double>(column) + 0.5, row - 0.5), 1. / across},
             {before[column], before[column + 1], above[column], above[column + 1]}, 0);
    }
    std::swap(before, above);
  }
  find_indices();
  Equilibria result{{}, low_, high_};
  for (const Zero& zero : zeros_) result.points.push_back(zero.point);
  result.on_curve = on_curve_;
  // Beside a multiple zero a cell in which the field is nearly constant, or not linear, is farther away.
  const auto belongs = [&](const Cell& cell) {
    return found_near(cell.x, near * cell.half) || std::ranges::any_of(zeros_, [&](const Zero& zero) {
             return field_.distance(cell.x, zero.point.x) < 2 * zero.radius;
           });
  };
  result.complete = complete_ && std::ranges::all_of(unexplained_, belongs) &&
                    std::ranges::all_of(flats_, [&](const Vector2d& x) { return found_near(x, explained); });
  return result;
}

}  // namespace

std::vector<Reversor> find_reversors(const SmoothField& field, const Vector2d& around) {
  constexpr int points = 60, least = 20;
  const double large = around.lpNorm<Eigen::Infinity>(), small = around.cwiseAbs().minCoeff();
  std::vector<Reversor> found;
  for (const Reversor& reversor : maps_to_try) {
    int compared = 0;
    const auto holds = [&](int i) {
      const double size = i % 2 == 0 || small == 0 ? large : small;
      const auto reversed =
          reverses(field, reversor.matrix, Vector2d::Zero(), size * (2 * evenly_spread(i) - Vector2d::Ones()));
      compared += reversed.has_value();
      return reversed.value_or(true);
    };
    bool all = true;
    for (int i = 1; i <= points && all; ++i) all = holds(i);
    if (all && compared >= least) found.push_back(reversor);
  }
  return found;
}

Equilibria find_equilibria(const SmoothField& field, const Vector2d& low, const Vector2d& high) {
  Equilibria found = ZeroSearch(field, low, high).run();
  found.reversors = find_reversors(field, low.cwiseAbs().cwiseMax(high.cwiseAbs()));
  for (const Reversor& reversor : found.reversors) {
    if (!is_reflection(reversor)) continue;
    for (Equilibrium& each : found.points) {
      const bool on_axis = (reversor.matrix * each.x - each.x).norm() < same * (high - low).norm();
      if (on_axis && each.kind == "center or focus") each.kind = planar_kind("center");
    }
  }
  std::ranges::sort(found.points, {}, [](const Equilibrium& each) { return std::pair(each.x[0], each.x[1]); });
  return found;
}

Equilibria find_equilibria(const SmoothField& field, const Vector2d& start) {
  const Vector2d corner = Vector2d::Constant(2.5 * start.lpNorm<Eigen::Infinity>());
  return find_equilibria(field, -corner, corner);
}

void compare_kinds(Equilibria& equilibria, const PlanarReduction& plane) {
  constexpr double least = 1e-3;
  const auto turning = [](std::string_view kind) { return kind.starts_with("center") || kind.ends_with("focus"); };
  const auto without_star = [](std::string_view kind) {
    return kind == "stable star"     ? planar_kind("stable node")
           : kind == "unstable star" ? planar_kind("unstable node")
                                     : kind;
  };
  for (Equilibrium& each : equilibria.points) {
    if (each.kind == "not smooth") continue;
    if (plane.scaling() != nullptr) {
      const double size = (equilibria.high - equilibria.low).norm();
      const std::string_view kind = without_star(plane.kind());
      if ((each.x - plane.centre()).norm() > same * size) continue;
      if (kind == each.kind) each.kind = plane.kind();  // a star is a node
      if (kind.empty() || kind == "bordered" || kind == "degenerate" || kind == without_star(each.kind)) continue;
      if (each.kind == "degenerate") {
        const bool none = kind == "cusp", saddle = kind == "saddle";
        if (kind != "mixed" && each.index == (none ? 0 : saddle ? -1 : 1)) each.kind = kind;
      } else if (!turning(each.kind) || !turning(kind)) {
        each.kind = planar_kind("degenerate");
      } else if (each.kind != "center or focus" || kind == "center") {
        each.kind = each.kind == "center or focus" ? planar_kind("center") : planar_kind("center or focus");
      }
      continue;
    }
    if (each.kind != "center or focus") continue;
    bool closes = plane.form() == name(FactorForm::constant);
    const Vector2d& radii = box_about(each.x).radii;
    for (const FactorPiece& piece : plane.factor_pieces(each.x - radii, each.x + radii)) {
      const bool within = (each.x - piece.low).minCoeff() >= 0 && (piece.high - each.x).minCoeff() >= 0;
      const double largest = std::max(std::abs(piece.value(piece.low)), std::abs(piece.value(piece.high)));
      closes |= within && std::abs(piece.value(each.x)) > least * largest;
    }
    if (closes) each.kind = planar_kind("center");
  }
}

}  // namespace contensou::reduction
