#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/symmetries.hpp"

namespace contensou::reduction {

/// The part of the plane about an orbit in which no switching function of a field changes its sign, and the field
/// there, continued smoothly beyond the border of this part. Orbits are computed region by region, so that no step or
/// series crosses a jump or a kink.
class Region {
 public:
  /// @param x    point of the orbit, perhaps on a border
  /// @param way  direction in which the orbit leaves x
  Region(const SmoothField& field, const Eigen::Vector2d& x, const Eigen::Vector2d& way);

  const SmoothField& field() const { return continued_ ? *continued_ : *whole_; }

  /// Returns true if no switching function has the sign opposite to that in the region.
  bool contains(const Eigen::Vector2d& x) const;

  /// Returns true if orbits leave the region at x: the rates of the crossed switching functions have the same signs
  /// inside and beyond the border. Otherwise no single motion leaves x.
  /// @param next  region beyond the border
  bool crosses_to(const Region& next, const Eigen::Vector2d& x) const;

 private:
  std::vector<int> signs_at(const Eigen::Vector2d& x) const;

  const SmoothField* whole_;
  std::optional<SmoothField> continued_ = {};
  std::vector<int> signs_ = {};  ///< 0: the function is 0 or has no value at the point that defines the region
};

}  // namespace contensou::reduction
