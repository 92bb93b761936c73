#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/infinity.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The right side f of x' = f(x) in the plane. Where it has no value it throws or returns what is not finite.
using PlanarField = std::function<Eigen::Vector2d(const Eigen::Vector2d& x)>;

/// X = c t d/dt + (A x + b) . d/dx
struct Generator {
  double time;             ///< c
  Eigen::Matrix2d matrix;  ///< A
  Eigen::Vector2d shift;   ///< b

  /// Whether it maps the field onto itself throughout; else it does so within each sector between the lines where the
  /// field is not smooth, and not across them. (Of several such a combination may; it is looked for as `scaling`.)
  bool everywhere = true;

  /// How fast, at least, points leave the centre: the smaller real part of the eigenvalues of A.
  double growth() const;

  /// Where A x + b vanishes; A has an inverse.
  Eigen::Vector2d centre() const;
};

/// What was found of the generators of that form. Beside them every x' = f(x) admits d/dt.
struct PlanarSymmetries {
  enum class Verdict {
    found,
    none,      ///< the smallest singular value is no error
    undecided  ///< the errors of the derivatives hide what a generator would leave
  };

  Verdict verdict = Verdict::none;

  /// A basis of the generators, the largest entry of each 1; the first is `scaling` where there is one, as good as the
  /// field's own values. The others are good to about `level`.
  std::vector<Generator> generators = {};

  /// Of the determining equations (README (R41)), in ascending order, relative to the largest.
  std::array<double, 7> singular_values = {};

  /// A singular value below this is taken for 0: eight times the errors of the derivatives.
  double level = 0;

  /// How far those that are 0 are from the others: the least of these over the larger of level and the most of those.
  double gap = 0;

  /// A generator to reduce by, which holds everywhere, across jumps of the field, too: all eigenvalues of A have positive
  /// real parts, and A x + b vanishes at one point. Of
  /// several the simplest: about the origin and A = 1 if that is one; else about another point; else A diagonal. Its
  /// largest entry is 1 or -1, the trace of A positive.
  std::optional<Generator> scaling = {};

  /// max of |f(exp(s A) x) - exp(s (A - c)) f(x)| over |f|, with x about the centre, for the scaling and s = ln 2
  double residual = infinity;

  int points = 0;  ///< that the equations were sampled at
};

/// Finds the generators by a singular value decomposition of the determining equations at up to 96 points.
///
/// Derivatives are extrapolated differences (Ridders) that say their own error; they never cross the axes u = 0 and
/// v = 0, where dry friction is not smooth, and points next to another kink are left out.
///
/// @param around  a point whose |u| and |v| are the scale of the samples, which lie at 1/3 to 3 times that distance
///                from the origin, evenly over all directions and closer and closer to the axes
/// @throws std::domain_error  if `around` is not finite or 0, if the field is 0, and if it has values at too few
///                            points: then with the message of its own first exception
PlanarSymmetries find_symmetries(const PlanarField& field, const Eigen::Vector2d& around);

/// The right side of (2.6), x = (u, v); continued to v < 0 by its mirror image.
PlanarField planar_field(const ReducedSystem& system);

}  // namespace contensou::reduction
