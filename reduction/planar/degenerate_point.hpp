#pragma once

#include <optional>
#include <string_view>

#include <Eigen/Core>

#include "contensou/reduction/symmetries.hpp"

namespace contensou::reduction {

/// A multiple zero of a smooth field.
struct DegeneratePoint {
  Eigen::Vector2d x;
  std::string_view kind;  ///< "degenerate" if no rule decides
  double rate;            ///< the eigenvalue that is not 0, or 0; the other eigenvalue is 0
};

/// Finds the multiple zero next to a point and its kind.
///
/// @param near   a point at which the field is 0 except for rounding, and the Jacobian is singular
/// @param radii  half sides of the rectangle that sets the scale
/// @return empty if the Taylor polynomial at `near` has no multiple zero, or is not known
std::optional<DegeneratePoint> degenerate_point(const PlanarField& field, const Eigen::Vector2d& near,
                                                const Eigen::Vector2d& radii);

/// Returns the point of few decimals next to x, if it lies within `known` (in units of `radii`) and the field is 0
/// there or smaller than at x; else x. Returns nothing if the field has no value at the point of few decimals.
std::optional<Eigen::Vector2d> few_decimals(const PlanarField& field, const Eigen::Vector2d& x,
                                            const Eigen::Vector2d& radii, double known);

}  // namespace contensou::reduction
