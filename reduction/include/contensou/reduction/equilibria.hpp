#pragma once

#include <complex>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/integrating_factor.hpp"

namespace contensou::reduction {

/// A zero of a field.
struct Equilibrium {
  Eigen::Vector2d x;
  Eigen::Matrix2d slopes;  ///< Jacobian of the field

  /// Returns the eigenvalues of the Jacobian, the one with the smaller real or imaginary part first.
  std::pair<std::complex<double>, std::complex<double>> eigenvalues() const;

  /// Returns the type by the linear part: "saddle", "stable node", "unstable node", "stable focus", "unstable focus",
  /// "center or focus" (purely imaginary eigenvalues), or "degenerate" (an eigenvalue 0).
  std::string_view kind() const;
};

/// Finds the equilibria in a rectangle by Newton's method from a grid of 40 x 40 points.
/// @return equilibria in the order of u, then v; those closer than 1e-6 of the rectangle count as one
std::vector<Equilibrium> find_equilibria(const SmoothField& field, const Eigen::Vector2d& low,
                                         const Eigen::Vector2d& high);

}  // namespace contensou::reduction
