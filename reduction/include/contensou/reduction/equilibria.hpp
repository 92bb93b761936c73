#pragma once

#include <complex>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/integrating_factor.hpp"

namespace contensou::reduction {

/// A linear map R of the plane that turns motions back: f(R x) = -R f(x).
struct Reversor {
  std::string_view name;  ///< the image of (u, v), such as "(u, -v)"
  Eigen::Matrix2d matrix;
};

/// Finds the reversors among (u, -v), (-u, v), (v, u), (-v, -u) and (-u, -v).
///
/// The equation is compared, except for rounding, at points whose coordinates have the sizes of those of `around`.
/// @param around  not 0
std::vector<Reversor> find_reversors(const SmoothField& field, const Eigen::Vector2d& around);

/// A zero of a field.
struct Equilibrium {
  Eigen::Vector2d x;
  Eigen::Matrix2d slopes;  ///< Jacobian of the field

  /// True if the eigenvalues are imaginary and x is a center: x lies on the axis of a reflection that is a reversor,
  /// which closes motions that meet the axis twice, or V is not 0 there, so that they are levels of H.
  bool closes = false;

  /// Returns the eigenvalues of the Jacobian, the one with the smaller real or imaginary part first.
  std::pair<std::complex<double>, std::complex<double>> eigenvalues() const;

  /// Returns the type by the linear part, one of planar_kinds: "saddle", "stable node", "unstable node", "stable
  /// focus", "unstable focus", "center" (imaginary eigenvalues and `closes`), "center or focus" (imaginary
  /// eigenvalues), or "degenerate" (an eigenvalue 0).
  std::string_view kind() const;
};

/// Finds the isolated equilibria in a rectangle by Newton's method from a grid of 40 x 40 points.
/// @return equilibria in the order of u, then v; those closer than 1e-6 of the rectangle count as one
std::vector<Equilibrium> find_equilibria(const SmoothField& field, const Eigen::Vector2d& low,
                                         const Eigen::Vector2d& high);

/// Finds the isolated equilibria in the square about the origin whose half side is 2.5 times the larger coordinate of a
/// start: the usual window of a picture.
std::vector<Equilibrium> find_equilibria(const SmoothField& field, const Eigen::Vector2d& start);

/// Sets `closes` of the equilibria at which V of this system is not 0.
void prove_centers(std::vector<Equilibrium>& equilibria, const PlanarReduction& plane);

}  // namespace contensou::reduction
