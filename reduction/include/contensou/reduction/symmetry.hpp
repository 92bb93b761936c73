#pragma once

#include <functional>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The scaling generator X2 = tau d_tau + u d_u + v d_v of (2.6), with X1 = d_tau and [X1, X2] = X1; in the regularised
/// time, X2 = -beta d_beta + u d_u + v d_v. A field F admits it exactly when it is homogeneous:
///   u F_u + v F_v = n F,   n = 0 for (2.6) and dv/du, n = 2 for (2.7).
///
/// Each function returns the residual of that identity at a state, relative to |F|: 0 in exact arithmetic. The
/// derivative along the generator is a central difference over exp(+-h), good to about 1e-9.
/// @throws std::domain_error  where F has no value: at rest, for v < 0, dv/du also at u = 0

/// Any field, by its degree n.
double generator_residual(const std::function<Rate(State)>& field, int degree, State state);

/// (2.6): degree 0.
double field_symmetry_residual(const ReducedSystem& system, State state);

/// (2.7): degree 2.
double regularised_symmetry_residual(const ReducedSystem& system, State state);

/// dv/du = w(u, v): the criterion u w_u + v w_v = 0.
double slope_symmetry_residual(const ReducedSystem& system, State state);

}  // namespace contensou::reduction
