#pragma once

#include <functional>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// Residuals of the scaling generator X2 = tau d_tau + u d_u + v d_v of the equations of motion (2.6). The time shift
/// X1 = d_tau satisfies [X1, X2] = X1. In the regularised time beta, X2 = -beta d_beta + u d_u + v d_v. A field F
/// admits X2 exactly if F is homogeneous of a degree n:
///   u F_u + v F_v = n F,   n = 0 for (2.6) and dv/du, n = 2 for the regularised equations (2.7).
///
/// Each function returns the residual of this identity at a state, relative to |F|; it is 0 in exact arithmetic. The
/// derivative along X2 is a central difference between the states exp(+-h) (u, v), with an error of about 1e-9.
/// @throws std::domain_error  if F has no value: at u = v = 0, for v < 0, for dv/du also at u = 0

/// Returns the residual of any field.
/// @param degree  degree n of the field
double generator_residual(const std::function<Rate(State)>& field, int degree, State state);

/// Returns the residual of the equations of motion (2.6), degree 0.
double field_symmetry_residual(const ReducedSystem& system, State state);

/// Returns the residual of the regularised equations (2.7), degree 2.
double regularised_symmetry_residual(const ReducedSystem& system, State state);

/// Returns the residual of W = dv/du, degree 0, that is of u W_u + v W_v = 0.
double slope_symmetry_residual(const ReducedSystem& system, State state);

/// Returns dp/dq = Phi/(q D), D = Phi - r k Psi, the right side of the separated equation (README (R2)) in the
/// canonical coordinates q = v/u = mu k and p = ln v. The group (u, v) -> (c u, c v) keeps q and adds ln c to p. The
/// right side does not contain p, so one quadrature solves the equation. For a ball under the Pade law the right side
/// is 7 (16 mu + 15 pi q)/(q (mu A + B q)) with A = 8 (14 - 5 mu^2), B = 15 pi (7 - mu^2).
/// @throws std::domain_error  if q = 0 or not finite
double separated_slope(const ReducedSystem& system, double q);

}  // namespace contensou::reduction
