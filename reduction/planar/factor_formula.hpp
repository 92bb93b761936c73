#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/planar_reduction.hpp"

namespace contensou::reduction {

/// Returns the inverse integrating factor V and the first integral H of a system as formulas. V is a sum with rational
/// coefficients of monomials in u, v of degree 4 or less, or of products of the field with 1, u, v, or of functions of
/// the field's own basis.
///
/// @param field  field whose V is such a sum
FactorFormula recognised(const SmoothField& field, const Eigen::Vector2d& start);

}  // namespace contensou::reduction
