#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/symmetries.hpp"

namespace contensou::reduction {

struct Onward;

/// The part of the plane about an orbit in which no switching function of a field changes its sign, and the field
/// there, continued smoothly beyond the border of this part. Orbits are computed region by region, so that no step or
/// series crosses a jump or a kink. A part of a switching curve along which motions slide is a region, too; its field
/// is Filippov's convex combination, planar.md (R62).
class Region {
 public:
  /// @param x    point of the orbit, perhaps on a border
  /// @param way  direction in which the orbit leaves x
  /// @param from  region that the orbit leaves at x; null if it begins at x
  Region(const SmoothField& field, const Eigen::Vector2d& x, const Eigen::Vector2d& way, const Region* from = nullptr);

  /// Makes the region about a point at which no switching function is 0.
  Region(const SmoothField& field, const Eigen::Vector2d& inside);

  const SmoothField& field() const { return continued_ ? *continued_ : *whole_; }

  /// Returns true if no switching function has the sign opposite to that in the region. If motions slide, also both
  /// sides of the curve must not point away from it.
  bool contains(const Eigen::Vector2d& x) const;

  /// Returns true if motions slide along a switching curve.
  bool slides() const { return slide_.has_value(); }

  /// Returns the point of the switching curve that is nearest to x, a point beside it; x itself without sliding.
  Eigen::Vector2d on_curve(const Eigen::Vector2d& x) const;

  /// Returns the sizes of the terms that cancel in a sliding velocity, at a point of the curve; 0 without sliding.
  Eigen::Vector2d cancelled(const Eigen::Vector2d& x) const;

  /// Returns the share of the way from one state to a later one at which a switching function, as a cubic through its
  /// values and rates at the two, has its extreme beyond 0 although both states lie in the region.
  /// @param time  time between the states
  std::optional<double> dip(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double time) const;

  /// Returns true if the linear motion from `rest` + `offset` to an equilibrium `rest` of the field, with the slopes
  /// `flow`, stays in the region, whose border may contain the equilibrium.
  bool keeps(const Eigen::Vector2d& rest, const Eigen::Vector2d& offset, const Eigen::Matrix2d& flow) const;

  /// Returns the motion that leaves this region at a point x of its border.
  /// @param size  length that states are compared with
  Onward leave(const Eigen::Vector2d& x, double size) const;

 private:
  friend class Junction;

  /// Two fields that point towards the curve on which a switching function is 0.
  struct Slide {
    Eigen::Index function;
    double sign;  ///< sign of the function on the first side
    SmoothField first, second;
  };

  bool crosses_to(const Region& next, const Eigen::Vector2d& x) const;
  bool grazes(const Region& next, const Eigen::Vector2d& x) const;
  std::vector<int> signs_at(const Eigen::Vector2d& x) const;

  const SmoothField* whole_;
  std::optional<SmoothField> continued_ = {};
  std::vector<int> signs_ = {};  ///< 0: the function is 0 or has no value at the point that defines the region
  std::optional<Slide> slide_ = {};
};

/// The motion that leaves a point, by Filippov's definition.
struct Onward {
  Eigen::Vector2d x;                  ///< the point, moved onto the switching curves on which it lies within errors
  std::optional<Region> region = {};  ///< the region that the motion enters
  bool rests = false;                 ///< true if the motion stays at the point
  std::string_view reason = {};       ///< reason why neither is known
  bool ambiguous = false;             ///< true if several motions leave the point
};

/// Returns the motion that leaves a point x; empty if x lies on no switching curve, within 1e-10 of `size`.
std::optional<Onward> onward(const SmoothField& field, const Eigen::Vector2d& x, double size);

/// Filippov's convex combination of the two fields beside a switching curve: the velocity of sliding motions.
/// @param first, second              values of the fields
/// @param rate_first, rate_second    rates of the switching function along them
Eigen::Vector2d sliding_velocity(const Eigen::Vector2d& first, const Eigen::Vector2d& second, double rate_first,
                                 double rate_second);

}  // namespace contensou::reduction
