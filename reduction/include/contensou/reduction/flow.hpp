#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include <Eigen/Core>

#include "contensou/reduction/detail/similarity_solution.hpp"
#include "contensou/reduction/orbit.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

class StopTimeTable;

/// The motions of one body under one friction law, solved once for all initial states.
///
/// A body slides at the speed v and pivots at the speed u = R omega_z on a circular contact patch of radius mu R. Dry
/// friction slows both speeds, with the force Phi and the moment Psi (Law). Both speeds vanish at one time, the stop
/// time. The equations of motion are (2.6) of V. F. Zhuravlev, 1998 (Zh98):
///   dv/dtau = -(2 chi/(3 pi)) Phi(k),  du/dtau = -(2 gamma mu/(3 pi)) Psi(k) sign(u),  k = v/(mu |u|)
/// The time tau is (3 pi/2) f g t with the coefficient of friction f; chi and gamma are those of Inertia. The equations
/// keep their form when u, v and tau are multiplied by one factor, so every motion is a scaled copy of one of a few
/// curves (SimilaritySolution). A Flow contains these curves, by quadrature or in closed form. It returns the stop
/// time and the state at any time without steps in time.
///
///     const Flow flow(HertzLaw{}, 0.1);  // a homogeneous ball with the patch radius 0.1 R, exact law
///     flow.stop_time({1, 1}).tau;          // from u = 1, v = 1
///     flow.orbit({1, 1}).at_time(16);      // the state at tau = 16
///     flow.terminal().ends;                // the limits of k = v/(mu |u|) at the stop
///     flow.stop_times(u0, v0, tau);        // for arrays
///
/// Pure sliding (u = 0), pure pivoting (v = 0), invariant rays and rest are ordinary initial states. A Flow never
/// changes. Copies share the solution and are cheap. Threads may share one Flow.
///
/// Accuracy  StopTime::accuracy: 1e-15 in closed form for mu <= 1; by quadrature 3e-15 for a smooth law.
/// Cost      0.2 ms for a law without closed form; the table of stop_times 10 ms, once.
/// Source    Zh98 (Prikl. Mat. Mekh. 62) for the model; reduction/theory.md and numerics.md for all formulas.
class Flow {
 public:
  /// Solves the system by the law's closed form if there is one, else by quadrature.
  /// @throws std::runtime_error  if the law has an invariant ray that terminal_ratios does not find
  Flow(const ReducedSystem& system);  // NOLINT(google-explicit-constructor): a system determines its flow

  /// Solves the system of the homogeneous ball on a level plane, ReducedSystem(law, patch_ratio).
  explicit Flow(const Law& law, double patch_ratio) : Flow(ReducedSystem(law, patch_ratio)) {}

  /// Solves the system by quadrature even if the law has a closed form.
  static Flow by_quadrature(const ReducedSystem& system);

  /// Takes a solution of the caller in place of a closed form. Its curves are not tested here; verify() tests them.
  /// @throws std::domain_error  if the curves are for another r than system.r(), do not cover every k, or tend to a
  ///                            ratio that terminal() does not contain
  Flow(const ReducedSystem& system, SimilaritySolution solution);

  const ReducedSystem& system() const;

  /// Returns the invariant rays and the limits of k = v/(mu |u|) at the stop.
  const TerminalRatios& terminal() const;

  /// Returns the curves. Every orbit is a scaled copy of a curve, except the invariant half-lines (PhasePlane).
  const SimilaritySolution& solution() const;

  /// Returns true if solution() was found by quadrature.
  bool is_by_quadrature() const;

  /// Returns the time from the start until u = v = 0; 0 at rest.
  /// @throws std::domain_error  if start is not a state (finite, v >= 0)
  StopTime stop_time(State start) const;

  /// Returns the stop time and its gradient, theory.md and numerics.md (R10), (R34), (R35). Only the first start needs
  /// an integration.
  /// @throws std::domain_error  if start is not a state, or if u = v = 0, at which no gradient exists
  ///
  /// Accuracy  the products u by_u, v by_v, ...: about 100 eps of tau; 1e-9 beside a ray of a law without slopes. In a
  ///           fast slide, k > 1000, the relative error of by_u is 1e-9 (exact, elliptic: 1e-11), for k up to 1e19.
  /// Cost      1 ms for the first start; the cost of a stop time for each further start.
  StopTimeGradient stop_time_gradient(State start) const;

  /// Returns the motion from this start.
  /// @throws std::domain_error  if start is not a state, or unless 1e-300 <= r <= 1e250
  Orbit orbit(State start) const;

  /// Returns H = ln |u| - ln w(k), the first integral of the equations of motion. w(k) is the speed w = mu |u| on the
  /// curve as a function of k; SimilarityCurve::ln_w is its logarithm.
  ///
  /// H is constant along every orbit and differs between orbits. The scaling (u, v) -> (c u, c v) adds ln c to H. The
  /// additive constant of H changes across an invariant ray. Pade law: ln [ |u| k^(-a) (A + B k)^b ] up to a constant,
  /// with A, B, a and b of PadeCurve (numerics.md (R40)).
  ///
  /// @param ln_v  natural logarithm of v; v itself underflows near the stop
  /// @throws std::domain_error  unless u and ln_v are finite and u is not 0; on an invariant ray (k within 4 eps)
  ///
  /// Accuracy  absolute, a few eps of |ln u| and of |ln w|.
  double log_first_integral(double u, double ln_v) const;

  /// Smallest number of starts for which stop_times makes a table.
  static constexpr std::size_t many_starts = std::size_t{1} << 15;

  /// Computes the stop times of starts (u0[i], v0[i]).
  /// Fewer starts than many_starts are computed one by one. For more starts, stop_times makes a table of polynomials
  /// once and tests each polynomial against the solution (numerics.md, Table). For a start that is no state tau is NaN.
  ///
  /// @param u0, v0   speeds of the starts, of any size; u0 of either sign, v0 >= 0
  /// @param tau      stop times, one for each start; tau may be the array u0 or v0 itself, but must not overlap them in
  ///                 another way
  /// @param threads  number of threads, >= 1, including the calling one
  /// @param whole    total number of starts, if u0 and v0 contain only a part of them
  /// @throws std::domain_error  if the three sizes differ, or threads is 0
  ///
  /// Accuracy  the table adds at most 4 eps to the relative error of stop_time.
  /// Cost      3 ns for each of many starts (AVX2; 6 ns without).
  /// Bits      equal for any division of many starts into arrays and threads, if `whole` is the same.
  void stop_times(std::span<const double> u0, std::span<const double> v0, std::span<double> tau, unsigned threads = 1,
                  std::size_t whole = 0) const;

  /// Returns the share of the table's polynomials that failed their test. Starts in the ranges of these polynomials are
  /// computed one by one, which is slow.
  /// @param whole  total number of starts; for fewer than many_starts the result is 0
  double refused(std::size_t whole) const;

 private:
  const StopTimeTable& table() const;
  bool by_table(std::size_t starts) const;

  struct Solved;
  struct Arrays;
  explicit Flow(std::shared_ptr<const Solved> solved);

  std::shared_ptr<const Solved> solved_;
  std::shared_ptr<const Arrays> arrays_;
};

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

/// Returns the state, the slip length and the angle at the time tau, with their gradients (theory.md (R11)). Gradients
/// are algebraic in the state and in the field at the start and at tau. After the stop, speeds are 0 and lengths
/// constant.
/// @throws std::domain_error  if start is not a state or lies on an axis; if tau is negative, as Orbit::instant
///
/// Accuracy  u by_u and v by_v: 1e-13 of the largest part of the same kind, times the ratio of the larger term of
///           D = Phi - r k Psi to D. On and next to an invariant ray 1e-9 (smooth law): mean of the ray's two sides.
InstantGradient instant_gradient(const Flow& flow, State start, double tau);

/// Returns the state of the motion from a start at the regularised time beta (ReducedSystem::regularising_weight). For
/// beta = infinity the state is rest.
///
/// @param beta  >= 0, in the inverse of the unit of speed
/// @throws std::domain_error  if beta is negative or not a number, or as Flow::orbit
///
/// Accuracy  as OrbitPoint::beta.
/// Cost      about ten times that of Orbit::at_time.
OrbitPoint at_beta(const Flow& flow, State start, double beta);

/// Returns the states at several beta, in the order given. Throws as at_beta.
OrbitColumns at_betas(const Flow& flow, State start, const Eigen::ArrayXd& betas);

}  // namespace contensou::reduction
