#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contensou/portraits/figure.hpp"
#include "contensou/portraits/phase_portrait.hpp"
#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::portraits {

/// A part of the plane that shows a system without a scaling.
struct PlanarView {
  Window window;
  std::vector<reduction::LimitCycle> cycles = {};
  std::array<bool, 2> fixed_low = {}, periodic = {};  ///< sides that no curve moves: axes of a population; periods
};

/// Returns a view that contains the equilibria with their surroundings, the limit cycles and the requested points. If
/// the field is periodic along an axis, the view contains one and a half periods. If both axes are orbits, the points
/// are not negative, and no reflection maps the field onto itself, the field is that of a population, and the view is
/// the positive quadrant.
PlanarView chosen_view(const reduction::PlanarReduction& plane, const std::vector<Eigen::Vector2d>& points);

/// Returns the limit cycles that turn about equilibria of a window and its surroundings.
std::vector<reduction::LimitCycle> cycles_within(const reduction::PlanarReduction& plane, const Window& window);

/// Returns the field at a point; empty if it has no value there.
std::optional<Eigen::Vector2d> rate_of(const reduction::SmoothField& field, const Eigen::Vector2d& x);

/// Returns true for y' = F(x, y), the field (1, F), whose time is x.
bool is_slope_field(const reduction::SmoothField& field, const Window& window);

/// Returns the smallest window that contains a window and a point.
Window united(const Window& window, const Eigen::Vector2d& x);

/// Returns the curves on which a function is 0 within its rectangle, with or without a change of its sign. Squares are
/// 1/160 of a window.
/// @param sides  sides of the window
std::vector<Polyline> zero_lines(const reduction::FactorPiece& piece, const Eigen::Vector2d& sides);

}  // namespace contensou::portraits
