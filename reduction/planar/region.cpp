#include "planar/region.hpp"

#include <algorithm>
#include <cmath>

#include "planar/section_field.hpp"

namespace contensou::reduction {

using Eigen::Vector2d;

Region::Region(const SmoothField& field, const Vector2d& x, const Vector2d& way) : whole_(&field) {
  if (!field.switches || !field.branch) return;
  // A point on a border belongs to the region that the orbit enters. The steps are longer than the rounding of x, and
  // grow until each switching function shows its sign.
  constexpr double shortest = 1e-13, longest = 1e-9;
  const double length = way.stableNorm();
  const double size = x.lpNorm<Eigen::Infinity>() > 0 ? x.lpNorm<Eigen::Infinity>() : 1;
  Vector2d inside = x;
  for (double step = shortest; step <= longest && length > 0; step *= 10) {
    inside = x + step * size / length * way;
    signs_ = signs_at(inside);
    if (std::ranges::count(signs_, 0) == 0) break;
  }
  if (length == 0) signs_ = signs_at(x);
  continued_ = field.branch(inside);
  continued_->basis = field.basis;
}

std::vector<int> Region::signs_at(const Vector2d& x) const {
  const Eigen::MatrixX3d switches = whole_->switches(x);
  std::vector<int> signs(static_cast<std::size_t>(switches.rows()));
  for (std::size_t i = 0; i < signs.size(); ++i) {
    const double value = switches(static_cast<Eigen::Index>(i), 0);
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
  return true;
}

bool Region::crosses_to(const Region& next, const Vector2d& x) const {
  const auto before = value_of(field().value, x), after = value_of(next.field().value, x);
  if (!before || !after) return false;
  const Eigen::MatrixX3d switches = whole_->switches(x);
  for (std::size_t i = 0; i < signs_.size(); ++i) {
    if (signs_[i] * next.signs_[i] >= 0) continue;
    const Eigen::RowVector2d gradient = switches.row(static_cast<Eigen::Index>(i)).tail<2>();
    if (gradient.allFinite() && gradient.dot(*before) * gradient.dot(*after) <= 0) return false;
  }
  return true;
}

}  // namespace contensou::reduction
