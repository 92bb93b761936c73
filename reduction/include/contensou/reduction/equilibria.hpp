#pragma once

#include <complex>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/integrating_factor.hpp"
#include "contensou/reduction/planar_kinds.hpp"

namespace contensou::reduction {

/// A linear map R of the plane that reverses motions in time: f(R x) = -R f(x).
struct Reversor {
  std::string_view name;  ///< formula of the point to which R moves (u, v), such as "(u, -v)"
  Eigen::Matrix2d matrix;
};

/// Finds the reversors among (u, -v), (-u, v), (v, u), (-v, -u) and (-u, -v).
///
/// f(R x) = -R f(x) is tested up to rounding, at points x whose coordinates are about as large as those of `around`.
/// @param around  not 0
std::vector<Reversor> find_reversors(const SmoothField& field, const Eigen::Vector2d& around);

/// An isolated zero of a field.
struct Equilibrium {
  using Eigenvalues = std::pair<std::complex<double>, std::complex<double>>;

  Eigen::Vector2d x;
  Eigen::Matrix2d slopes;  ///< Jacobian of the field; NaN if it does not exist

  /// One of planar_kinds. "not smooth": the field jumps at x, or its Jacobian differs between the sides of x.
  /// "degenerate": an eigenvalue is 0 within its error, and the terms of higher order do not decide. "center or focus":
  /// motions turn about x, and nothing proves that they are closed. There are three proofs. First, x lies on the axis
  /// of a reflection that is a reversor; then every motion that meets this axis twice is closed. Second, the inverse
  /// integrating factor V is not 0 at x; then motions are level lines of the first integral H. Third, x is the centre
  /// of a scaling, and a turn multiplies by 1.
  std::string_view kind = planar_kind("degenerate");

  /// The eigenvalues of the Jacobian, the one with the smaller real or imaginary part first. An eigenvalue or a part
  /// that is 0 within its error is 0. Empty if the field is not smooth at x.
  std::optional<Eigenvalues> eigenvalues = {};

  /// The number of counter-clockwise turns of the field on a small counter-clockwise circle; empty if not known.
  std::optional<int> index = {};
};

/// The isolated equilibria in a rectangle.
struct Equilibria {
  std::vector<Equilibrium> points;  ///< in the order of u, then v
  Eigen::Vector2d low, high;        ///< corners of the rectangle

  /// False if there might be more equilibria: the field changes much between neighbouring points of the search.
  bool complete = true;

  std::optional<Eigen::Vector2d> on_curve = {};  ///< a point of the rectangle on a curve of equilibria

  std::vector<Reversor> reversors = {};  ///< maps that reverse motions at points of the rectangle
};

/// Finds the isolated equilibria in a rectangle by Newton's method from a grid of 40 x 40 points. The grid is refined
/// where the field is not nearly linear between its points. Zeros closer than 1e-6 of the rectangle's size, and zeros
/// that rounding does not separate, count as one.
Equilibria find_equilibria(const SmoothField& field, const Eigen::Vector2d& low, const Eigen::Vector2d& high);

/// Finds the isolated equilibria in the square about the origin whose half side is 2.5 times the larger coordinate of a
/// start: the usual window of a picture.
Equilibria find_equilibria(const SmoothField& field, const Eigen::Vector2d& start);

/// Turns "center or focus" into "center" where V or the scaling of the solved system proves it. A kind that the kind of
/// the scaling's centre (PlanarReduction::kind) contradicts becomes "center or focus" or "degenerate".
void compare_kinds(Equilibria& equilibria, const PlanarReduction& plane);

}  // namespace contensou::reduction
