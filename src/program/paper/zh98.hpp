#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "contensou/reduction/reduced_system.hpp"

/// Formulas of V. F. Zhuravlev, 1998 (Zh98), exactly as printed, with errors. No argument is checked; 0/0 gives NaN.
namespace contensou::program::zh98 {

using std::numbers::pi;

// Section 1: force and moment of the patch as functions of k, in the units N f and N f eps.

/// Returns sigma eps^2/N; sigma is the normal stress at the distance rho eps from the centre.
inline double pressure(double rho) { return 3 / (2 * pi) * std::sqrt(1 - rho * rho); }

/// Returns q_- (sign = -1) or q_+ (sign = 1), the ends of the chord at the edge of the patch, for the angle theta.
inline double chord_end(double k, double theta, double sign) {
  return k * std::cos(theta) + sign * std::sqrt(1 - k * k * std::sin(theta) * std::sin(theta));
}

/// Return the force Phi of (1.3) for k <= 1 and for k > 1.
inline double inner_force(double k) { return 3.0 / 32 * pi * k * (4 - k * k); }
inline double outer_force(double k) {
  return 3 / (64 * k) * (4 * k * k * (4 - k * k) * std::asin(1 / k) + 4 * (k * k + 2) * std::sqrt((k - 1) * (k + 1)));
}

/// Returns the Pade law's force Phi, (1.4).
inline double pade_force(double k) { return 3 * pi * k / (8 + 3 * pi * k); }

/// Return the moment Psi of (1.5) for k <= 1 and for k > 1.
inline double inner_moment(double k) { return 3.0 / 128 * pi * (8 - 8 * k * k + 3 * k * k * k * k); }
inline double outer_moment(double k) {
  return 3.0 / 128 * 2 *
         ((8 - 8 * k * k + 3 * k * k * k * k) * std::asin(1 / k) + 3 * (2 - k * k) * std::sqrt((k - 1) * (k + 1)));
}

/// Returns the Pade law's moment Psi, (1.6).
inline double pade_moment(double k) { return 3 * pi / (16 + 15 * pi * k); }

// Section 2: the ball, in SI units.

/// The moment of inertia divided by m R^2.
constexpr double inertia = 2.0 / 5;

/// Returns the velocity of the contact point, (2.1).
inline Eigen::Vector2d contact_velocity(double R, const Eigen::Vector2d& velocity, const Eigen::Vector3d& omega) {
  return {velocity.x() - R * omega.y(), velocity.y() + R * omega.x()};
}

/// Returns F_x and F_y, (2.3).
/// @param friction  f N
/// @param contact   velocity of the contact point
inline Eigen::Vector2d force(double friction, double eps, double spin, const Eigen::Vector2d& contact) {
  const double v = contact.norm();
  return -3 * pi * friction * v / (8 * eps * std::abs(spin) + 3 * pi * v) * contact / v;
}

/// Returns M_x, M_y and M_z under the force F, (2.4).
inline Eigen::Vector3d moment(double friction, double eps, double R, double spin, double v, const Eigen::Vector2d& F) {
  return {R * F.y(), -R * F.x(), 3 * pi * friction * eps * eps * spin / (16 * eps * std::abs(spin) + 15 * pi * v)};
}

/// Returns d(omega_x, omega_y, u, v, alpha)/dtau. The paper prints these five equations before (2.6) and in (2.6).
inline Eigen::Matrix<double, 5, 1> rates(double mu, double R, double u, double v, double alpha) {
  const double sliding = 8 * mu * std::abs(u) + 3 * pi * v;
  return {-5 * v * std::sin(alpha) / (R * sliding), 5 * v * std::cos(alpha) / (R * sliding),
          -5 * mu * mu * u / (16 * mu * std::abs(u) + 15 * pi * v), -7 * v / sliding, 0};
}

// The plane (u, v) of a homogeneous ball, for u of either sign and v >= 0.

/// Returns d(u, v)/dtau, the equations of motion (2.6).
inline reduction::Rate field(double mu, reduction::State state) {
  const auto [u, v] = state;
  return {-5 * mu * mu * u / (16 * mu * std::abs(u) + 15 * pi * v), -7 * v / (8 * mu * std::abs(u) + 3 * pi * v)};
}

/// Returns dv/du, the equation of Fig. 4.
inline double slope(double mu, reduction::State state) {
  const auto [u, v] = state;
  return 7 * v * (16 * mu * std::abs(u) + 15 * pi * v) / (5 * mu * mu * u * (8 * mu * std::abs(u) + 3 * pi * v));
}

/// Returns d(u, v)/dbeta, the regularised equations (2.7). |u| replaces u, so that both half-planes are covered.
inline reduction::Rate regularised_field(double mu, reduction::State state) {
  const auto [u, v] = state;
  return {-5 * mu * mu * u * (8 * mu * std::abs(u) + 3 * pi * v), -7 * v * (16 * mu * std::abs(u) + 15 * pi * v)};
}

/// Returns dtau/dbeta, the integrand of (2.8).
inline double weight(double mu, reduction::State state) {
  const auto [u, v] = state;
  return (16 * mu * std::abs(u) + 15 * pi * v) * (8 * mu * std::abs(u) + 3 * pi * v);
}

}  // namespace contensou::program::zh98
