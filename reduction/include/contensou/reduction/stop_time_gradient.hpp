#pragma once

namespace contensou::reduction {

/// A stop time of (2.6) and its derivatives by all that it follows from, each with the others kept.
///
/// It is homogeneous: u by_u + v by_v = tau, Euler's identity. At u = 0 it is even in u, and by_u is 0; so is by_v at
/// v = 0 without a drive.
struct StopTimeGradient {
  double tau;
  double by_u, by_v;        ///< by the speeds at the start
  double by_mu;             ///< by the patch radius over R
  double by_chi, by_gamma;  ///< by the body's inertia
  double by_drive;          ///< by rho, the drive along the slip
};

}  // namespace contensou::reduction
