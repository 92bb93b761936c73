#pragma once

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The equations of the plane (u, v) exactly as Zh98 prints them: homogeneous ball, Pade law, u of either sign, v >= 0.
///
/// A second spelling of ReducedSystem with PadeLaw, for readers who hold the paper and for tests that hold the two
/// against each other. Plain arithmetic: nothing is checked, 0/0 gives NaN.
namespace paper {

/// d(u, v)/dtau, (2.6).
Rate field(double mu, State state);

/// d(u, v)/dbeta, (2.7); |u| in place of u, so that both half-planes are covered.
Rate regularised_field(double mu, State state);

/// dtau/dbeta, the integrand of (2.8).
double regularising_weight(double mu, State state);

/// dv/du, the equation of Fig. 4.
double slope(double mu, State state);

}  // namespace paper

}  // namespace contensou::reduction
