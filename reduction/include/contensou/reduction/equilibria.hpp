#pragma once

#include <complex>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/integrating_factor.hpp"

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

/// A zero of a field.
struct Equilibrium {
  Eigen::Vector2d x;
  Eigen::Matrix2d slopes;  ///< Jacobian of the field

  /// True if the eigenvalues are imaginary and x is proved to be a center. There are two proofs. Either x lies on the
  /// axis of a reflection that is a reversor; then every motion that meets this axis twice is closed. Or the inverse
  /// integrating factor V is not 0 at x; then motions are level lines of the first integral H.
  bool closes = false;

  /// Returns the eigenvalues of the Jacobian, the one with the smaller real or imaginary part first.
  std::pair<std::complex<double>, std::complex<double>> eigenvalues() const;

  /// Returns the type by the linear part, one of planar_kinds. Real eigenvalues: "saddle", "stable node" or "unstable
  /// node". Complex eigenvalues: "stable focus" or "unstable focus". Imaginary eigenvalues: "center" if `closes`, else
  /// "center or focus". An eigenvalue 0: "degenerate".
  std::string_view kind() const;
};

/// Finds the isolated equilibria in a rectangle by Newton's method from a grid of 40 x 40 points.
/// @return equilibria in the order of u, then v; two closer than 1e-6 of the rectangle's size count as one
std::vector<Equilibrium> find_equilibria(const SmoothField& field, const Eigen::Vector2d& low,
                                         const Eigen::Vector2d& high);

/// Finds the isolated equilibria in the square about the origin whose half side is 2.5 times the larger coordinate of a
/// start: the usual window of a picture.
std::vector<Equilibrium> find_equilibria(const SmoothField& field, const Eigen::Vector2d& start);

/// Sets `closes` of the equilibria at which the inverse integrating factor V (PlanarReduction::factor) is not 0.
void prove_centers(std::vector<Equilibrium>& equilibria, const PlanarReduction& plane);

}  // namespace contensou::reduction
