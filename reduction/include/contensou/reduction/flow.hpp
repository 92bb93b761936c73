#pragma once

#include <memory>
#include <span>

#include "contensou/reduction/orbit.hpp"
#include "contensou/reduction/reduced_system.hpp"
#include "contensou/reduction/similarity_solution.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "contensou/reduction/terminal_ratio.hpp"

namespace contensou::reduction {

class StopTimeTable;

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
/// Cost  1 ms for a law without closed form; the first call of stop_times 3 ms more.
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

  /// The motion from this start.
  /// @throws std::domain_error  if start is not a state, or if r > 1e250
  Orbit orbit(State start) const;

  /// ln |u| - ln w(k), the first integral of (2.6) and (2.7): constant along every orbit, different on different ones,
  /// and shifted by ln c under (u, v) -> (c u, c v). Its constant is another one on either side of a ray.
  ///
  /// For the Pade law it is ln [ |u| k^(-a) (A + B k)^b ] up to a constant (README (R8)).
  ///
  /// @param ln_v  in place of v, which underflows near the stop
  /// @throws std::domain_error  unless u and ln_v are finite and u is not 0: on the axes it has no value
  ///
  /// Accuracy  absolute, a few eps of |ln u| and of the curve's |ln w|.
  double log_first_integral(double u, double ln_v) const;

  /// Stop times of starts (u0[i], v0[i]), by a table that the first call makes: see StopTimeTable::evaluate.
  void stop_times(std::span<const double> u0, std::span<const double> v0, std::span<double> tau,
                  unsigned threads = 1) const;

  /// That table.
  const StopTimeTable& table() const;

 private:
  struct Solved;
  struct Arrays;
  explicit Flow(Solved solved);

  std::shared_ptr<const Solved> solved_;
  std::shared_ptr<Arrays> arrays_;
};

}  // namespace contensou::reduction
