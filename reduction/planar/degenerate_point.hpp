#pragma once

#include <array>
#include <optional>
#include <string_view>

#include <Eigen/Core>

#include "contensou/reduction/symmetries.hpp"

namespace contensou::reduction {

/// A power series in s up to s^8.
using Series = Eigen::Array<double, 9, 1>;

/// A polynomial of degree 8 in two variables.
struct TaylorPolynomial {
  static constexpr int degree = 8, terms = (degree + 1) * (degree + 2) / 2;

  /// Returns the place of the coefficient of z1^i z2^j.
  static constexpr std::size_t place(int i, int j) {
    const int place = (i + j) * (i + j + 1) / 2 + j;
    return static_cast<std::size_t>(place);
  }

  double& operator()(int i, int j) { return coefficients[place(i, j)]; }
  double operator()(int i, int j) const { return coefficients[place(i, j)]; }

  /// Returns the series of the polynomial at z1 = first, z2 = second.
  Series at(const Series& first, const Series& second) const;

  /// Returns the derivative by z1 (variable 0) or z2 (variable 1).
  TaylorPolynomial derivative(int variable) const;

  /// Returns the polynomial in z - shift.
  TaylorPolynomial shifted(const Eigen::Vector2d& shift) const;

  /// Returns the largest absolute value of the coefficients of one degree.
  double largest(int of_degree) const;

  std::array<double, terms> coefficients{};
};

/// The polynomial that fits g(z) = f(x)/radii, x = centre + radii z, in the disc |z| <= 1 by least squares.
struct Taylor {
  std::array<TaylorPolynomial, 2> g;
  double size = 0;    ///< largest |g| at the points of the fit
  double misfit = 0;  ///< largest difference between g and the polynomial at the points of the fit

  /// Returns a bound of the error of a coefficient. The error comes from the misfit and from rounding.
  double error(int of_degree) const;
};

/// Fits the polynomial; empty if the field has no value at a point of the disc.
std::optional<Taylor> taylor(const PlanarField& field, const Eigen::Vector2d& centre, const Eigen::Vector2d& radii);

/// Returns a(s + shift).
Series shifted(const Series& a, double shift);

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

/// Returns the sign of the first Lyapunov coefficient of a zero with the eigenvalues +-i omega: -1 for a stable focus,
/// 1 for an unstable one; 0 if the coefficient is 0 within its error, or not known.
int lyapunov_sign(const PlanarField& field, const Eigen::Vector2d& x, const Eigen::Vector2d& radii);

/// Returns the point of few decimals next to x, if it lies within `known` (in units of `radii`) and the field is 0
/// there or smaller than at x; else x. Returns nothing if the field has no value at the point of few decimals.
std::optional<Eigen::Vector2d> few_decimals(const PlanarField& field, const Eigen::Vector2d& x,
                                            const Eigen::Vector2d& radii, double known);

}  // namespace contensou::reduction
