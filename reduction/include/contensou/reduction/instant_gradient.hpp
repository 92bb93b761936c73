#pragma once

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// The state of a motion at the time tau, and its partial derivatives by the speeds at the start and by tau.
struct InstantGradient {
  struct Part {
    double value;
    double by_u, by_v;  ///< derivatives by the speeds at the start
    double by_tau;
  };
  Part u, v;
  Part slip_length;  ///< the integral of v dtau
  Part turned;       ///< the integral of u dtau; has the sign of u

  /// Returns the derivative, by a speed at the start, of the tau at which u or v has a given value: -by/by_tau.
  /// @param by    by_u or by_v of that part
  /// @param part  u or v
  static double time_by(double by, const Part& part) { return -by / part.by_tau; }
};

/// Returns the state at the time tau, slip length and angle with their gradients, README (R61). They are algebraic in
/// the state and in the field at both ends. From the stop on the speeds are 0 and the lengths constant.
/// @throws std::domain_error  if start is not a state, or lies on an axis; as Orbit::instant
///
/// Accuracy  u by_u and v by_v: 1e-13 of the largest part of the same kind, times the larger term of D divided by D;
///           next to a ray and on it 1e-9, as the mean of both sides (for a law that is smooth there).
InstantGradient instant_gradient(const Flow& flow, State start, double tau);

}  // namespace contensou::reduction
