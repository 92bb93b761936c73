#pragma once

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// The state of a motion at the time tau, with partial derivatives by the speeds at the start and by tau.
struct InstantGradient {
  struct Part {
    double value;
    double by_u, by_v;  ///< derivatives by the speeds at the start
    double by_tau;
  };
  Part u, v;
  Part slip_length;  ///< the integral of v dtau
  Part turned;       ///< the integral of u dtau; has the sign of u

  /// Returns the derivative, by a speed at the start, of the time tau at which u or v has a given value: -by/by_tau.
  /// @param by    derivative of `part` by this speed: its by_u or by_v
  /// @param part  the speed with the given value: u or v
  static double time_by(double by, const Part& part) { return -by / part.by_tau; }
};

/// Returns the state, the slip length and the angle at the time tau, with their gradients (README (R61)). The gradients
/// are algebraic in the state and in the field at both ends. After the stop the speeds are 0 and the lengths constant.
/// @throws std::domain_error  if start is not a state, or lies on an axis; as Orbit::instant
///
/// Accuracy  u by_u and v by_v: 1e-13 of the largest part of the same kind, times the ratio of the larger term of
///           D = Phi - r k Psi to D. On an invariant ray and next to it 1e-9, as the mean of both sides (smooth law).
InstantGradient instant_gradient(const Flow& flow, State start, double tau);

}  // namespace contensou::reduction
