#pragma once

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// What a motion has come to by a time tau, and its derivatives by the start and by tau, each with the others kept.
struct InstantGradient {
  struct Part {
    double value;
    double by_u, by_v;  ///< by the speeds at the start
    double by_tau;
  };
  Part u, v;
  Part slip_length;  ///< the integral of v dtau
  Part turned;       ///< the integral of u dtau, of the sign of u

  /// How the tau at which v or u has a value changes with the start: -by/by_tau.
  static double time_by(double by, const Part& part) { return -by / part.by_tau; }
};

/// The state after tau, and how far it has slid and turned, with their gradients, README (R61): algebraic in the state and
/// in the field at both ends. From the stop on the state is 0, and the rest that of the whole motion.
/// @throws std::domain_error  if start is not a state, or on an axis, where k stays and tells nothing of what is beside
///                            it; as Orbit::instant
///
/// Accuracy  u by_u and v by_v: 1e-13 of the largest part of the same kind, times the larger term of D over D; 1e-9
///           next to a ray and on it, where they are the mean of both sides (of a law that is smooth there).
InstantGradient instant_gradient(const Flow& flow, State start, double tau);

}  // namespace contensou::reduction
