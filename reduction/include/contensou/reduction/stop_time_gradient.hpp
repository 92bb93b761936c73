#pragma once

namespace contensou::reduction {

/// A stop time and its partial derivatives by the speeds at the start and by the numbers of ReducedSystem.
///
/// The stop time is homogeneous: u by_u + v by_v = tau (Euler's identity). It is even in u, so by_u is 0 at u = 0.
/// Without a drive by_v is 0 at v = 0.
struct StopTimeGradient {
  double tau;
  double by_u, by_v;        ///< derivatives by the speeds at the start
  double by_mu;             ///< derivative by mu, which is (patch radius)/R
  double by_chi, by_gamma;  ///< derivatives by the two numbers of Inertia
  double by_drive;          ///< derivative by rho, the drive along the slip
};

}  // namespace contensou::reduction
