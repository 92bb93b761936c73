#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "contensou/reduction/orbit.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "contensou/reduction/similarity_solution.hpp"
#include "contensou/reduction/stop_time_gradient.hpp"
#include "contensou/reduction/terminal_ratio.hpp"

namespace contensou::reduction {

class StopTimeTable;

/// A stop time and what is known of it.
struct StopTime {
  double tau;        ///< the paper's time; infinity where it exceeds the largest double
  double accuracy;   ///< relative error that is answered for
  long evaluations;  ///< of the friction law; 0 for a closed form
  Bounds bounds;     ///< ReducedSystem::stop_time_bounds
};

/// All motions of one system: solved once, then stop times and states of any start.
///
///     const Flow flow({HertzLaw{}, 0.1});
///     flow.stop_time({1, 1}).tau;          // from u = 1, v = 1
///     flow.orbit({1, 1}).at_time(16);      // the state at tau = 16
///     flow.terminal().ends;                // what k tends to
///     flow.stop_times(u0, v0, tau);        // for arrays
///
/// A value that never changes. Copies share the solution: they are cheap, and threads may share one.
///
/// Cost  0.2 ms for a law without closed form; the table of stop_times 10 ms, once.
class Flow {
 public:
  /// By the law's closed form where it has one, else by quadrature.
  /// @throws std::runtime_error  if the law has an invariant ray that terminal_ratios does not find
  Flow(const ReducedSystem& system);  // NOLINT(google-explicit-constructor): a system determines its flow

  /// By quadrature, whatever closed form the law has.
  static Flow by_quadrature(const ReducedSystem& system);

  /// With a solution of your own, in place of a closed form. Its curves are taken at their word: verify examines them.
  /// @throws std::domain_error  if the curves are of another r than system.r(), do not cover every k, or tend to
  ///                            another ratio than terminal() says
  Flow(const ReducedSystem& system, SimilaritySolution solution);

  const ReducedSystem& system() const;

  /// Where k goes: the invariant rays, and the ends of the motions.
  const TerminalRatios& terminal() const;

  /// The curves that every orbit off the invariant half-lines is a scaled copy of.
  const SimilaritySolution& solution() const;

  /// Whether solution() was found by quadrature.
  bool is_by_quadrature() const;

  /// The time until u = v = 0; 0 at rest.
  /// @throws std::domain_error  if start is not a state (finite, v >= 0)
  StopTime stop_time(State start) const;

  /// The stop time and its gradient, README (R10), (R57), (R58): nothing is integrated again for a further start.
  /// @throws std::domain_error  if start is not a state, or at rest, where there is no gradient
  ///
  /// Accuracy  u by_u, v by_v, mu by_mu and so on: some 100 eps of tau. Beside a fast slide, k > 1000, by_u has 1e-9 of
  ///           itself (exact and elliptic: 1e-11), up to k = 1e19.
  /// Cost      1 ms, once; then that of a stop time.
  StopTimeGradient stop_time_gradient(State start) const;

  /// The motion from this start.
  /// @throws std::domain_error  if start is not a state, or unless 1e-300 <= r <= 1e250
  Orbit orbit(State start) const;

  /// ln |u| - ln w(k), the first integral of (2.6) and (2.7): constant along every orbit, different on different ones,
  /// and shifted by ln c under (u, v) -> (c u, c v). Its constant is another one on either side of a ray.
  ///
  /// For the Pade law it is ln [ |u| k^(-a) (A + B k)^b ] up to a constant (README (R8)).
  ///
  /// @param ln_v  in place of v, which underflows near the stop
  /// @throws std::domain_error  unless u and ln_v are finite and u is not 0: on the axes it has no value, and on an invariant ray
  ///                            (k within 4 eps of it) neither
  ///
  /// Accuracy  absolute, a few eps of |ln u| and of the curve's |ln w|.
  double log_first_integral(double u, double ln_v) const;

  /// From so many starts a table of them pays for itself.
  static constexpr std::size_t many_starts = std::size_t{1} << 15;

  /// Stop times of starts (u0[i], v0[i]): one by one, or, of many_starts, by polynomials that are made once and prove
  /// themselves (README, Table). u0 is of either sign, v0 >= 0, of any size; what stop_time rejects becomes NaN.
  ///
  /// @param tau      as many as there are starts; may be u0 or v0 itself, but must not overlap them otherwise
  /// @param threads  how many share the work of many starts, >= 1; the calling thread is one of them
  /// @param whole    how many starts there are in all, where these are a part of them
  /// @throws std::domain_error  if the three sizes differ, or threads is 0
  ///
  /// Accuracy  by polynomials 4 eps more than stop_time has.
  /// Cost      of many starts, 3 ns each (AVX2; 6 ns without).
  /// Bits      the same however many starts are cut into arrays and threads, if each part knows the whole.
  void stop_times(std::span<const double> u0, std::span<const double> v0, std::span<double> tau, unsigned threads = 1,
                  std::size_t whole = 0) const;

  /// The share of the polynomials that failed their proof: of so many starts, those there are computed one by one,
  /// which is slow. 0 where stop_times uses none.
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

}  // namespace contensou::reduction
