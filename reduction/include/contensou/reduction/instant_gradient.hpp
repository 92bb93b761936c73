#pragma once

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// The state of a motion at the time tau, with its partial derivatives by the speeds at the start and by tau.
struct InstantGradient {
  struct Part {
    double value;
    double by_u, by_v;  ///< derivatives by the speeds at the start
    double by_tau;
  };
  Part u, v;
  Part slip_length;  ///< the integral of v dtau
  Part turned;       ///< the integral of u dtau; has the sign of u

  /// Returns the derivative, by a speed at the start, of the time at which u or v has a given value: -by/part.by_tau.
  /// @param by    derivative of `part` by this speed: its by_u or by_v
  /// @param part  the speed with the given value: u or v
  static double time_by(double by, const Part& part) { return -by / part.by_tau; }
};

/// Returns the state, the slip length and the angle at the time tau, with their gradients (README (R61)). Gradients are
/// algebraic in the state and in the field at the start and at tau. After the stop, speeds are 0 and lengths constant.
/// @throws std::domain_error  if start is not a state or lies on an axis; if tau is negative, as Orbit::instant
///
/// Accuracy  u by_u and v by_v: 1e-13 of the largest part of the same kind, times the ratio of the larger term of
///           D = Phi - r k Psi to D. On and next to an invariant ray 1e-9 (smooth law): mean of the ray's two sides.
InstantGradient instant_gradient(const Flow& flow, State start, double tau);

}  // namespace contensou::reduction
