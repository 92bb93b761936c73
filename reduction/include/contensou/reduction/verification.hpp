#pragma once

#include <functional>
#include <string>
#include <vector>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/friction_law.hpp"
#include "contensou/reduction/planar_reduction.hpp"
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

/// Returns dp/dq = Phi/(q D), D = Phi - r k Psi, the right side of the separated equation (theory.md (R2)) in the
/// canonical coordinates q = v/u = mu k and p = ln v. The group (u, v) -> (c u, c v) keeps q and adds ln c to p. The
/// right side does not contain p, so one quadrature solves the equation. For a ball under the Pade law the right side
/// is 7 (16 mu + 15 pi q)/(q (mu A + B q)) with A = 8 (14 - 5 mu^2), B = 15 pi (7 - mu^2).
/// @throws std::domain_error  if q = 0 or not finite
double separated_slope(const ReducedSystem& system, double q);

/// Coulomb friction of a circular patch by its definition: an integral of the local slip over the disc, equations (1.1)
/// and (1.2) of V. F. Zhuravlev, 1998 (Zh98). The integration is slow and shares no formula with any law, so tests
/// compare the laws with this class.
///
/// The unit of length is the radius of the patch. The pressure may have any unit, because it is divided by the load.
/// Accuracy  1e-12 of the largest value (1 for Phi, Psi(0) for Psi), for pressures that are smooth inside the disc and
///           a power of 1 - rho^2 at its edge, with an exponent above -1; rho is the distance from the centre.
class ContactPatch {
 public:
  /// @param pressure  pressure, >= 0, as a function of 1 - rho^2; this argument keeps its digits at the edge
  /// @throws std::domain_error  if the load, the integral of the pressure over the disc, is not positive and finite
  explicit ContactPatch(std::function<double(double)> pressure);

  /// Returns force and moment by the double integral (1.1), in polar coordinates about the centre of the patch.
  /// @throws std::domain_error  for a slip that require_slip rejects
  Resistance over_disc(Slip slip) const;

  /// Returns force F and moment M by (1.2), the integral over chords, in polar coordinates (q, theta) about the centre
  /// of velocity, at the distance k from the centre of the patch. Two misprints are corrected: cos(theta) is included,
  /// and M = M^h - k F, with the moment M^h about the centre of velocity. For k <= 1, theta goes from 0 to pi.
  /// @param k  sliding speed divided by rim speed, > 0, finite
  Resistance over_chords(double k) const;

  /// Returns Q_n of (1.2) divided by the load: the integral of pressure times q^n along a chord, from q_- to q_+.
  /// @param n      exponent, >= 0
  /// @param theta  angle of chord and line through the centres of velocity and patch; returns 0 if the chord misses
  double chord_moment(int n, double theta, double k) const;

 private:
  double pressure_at(double rest) const;
  double chord_moment_of(int n, double centre, double half_length) const;

  std::function<double(double)> pressure_;
  double load_ = 1;
};

/// One statement that must hold, with its measured error.
struct Check {
  std::string name;
  double measured;  ///< largest error; NaN counts as failed
  double allowed;
  bool passed() const { return measured <= allowed; }
};

/// Computes every statement of the theory about one motion as a number that must be small. It compares the routes to
/// the stop time with each other. It tests the scaling generator on the equations of motion (2.6), the regularised
/// equations (2.7) and dv/du. It tests the separated equation, the first integral, the time beta against its definition
/// (2.8), the limits on both axes and the law's bounds; for the exact law also the elementary orbit for k <= 1.
///
/// @param flow  motions to examine; its closed form, also one that the caller gave, is compared with quadrature
/// @throws std::domain_error  if start is not a state or is at rest, or r < 1e-100
std::vector<Check> verify(const Flow& flow, State start);

/// Computes the same statements over several starts of one system; each row is the worst result over the starts.
std::vector<Check> verify(const Flow& flow, const std::vector<State>& starts);

/// Computes statements about one motion of a planar system. If the system is solved by a quadrature, its orbit, the
/// first integral, V, and the period or end time are compared with steps in time. The other statements are about
/// symmetries, derivatives, equilibria, reversors and the motion backwards. A statement that does not apply is left
/// out. Each limit is a stated error times the factor by which the motion amplifies it.
/// @param found  symmetries of the field of `plane`
/// @throws std::domain_error  if the field is 0 or has no value at the start
std::vector<Check> verify(const PlanarReduction& plane, const PlanarSymmetries& found, const Eigen::Vector2d& start);

}  // namespace contensou::reduction
