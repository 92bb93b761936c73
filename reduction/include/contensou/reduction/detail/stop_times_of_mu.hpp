#pragma once

#include <memory>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// Stop times under one law, of one body under one drive. Each start has its own mu (patch radius divided by the radius
/// R of the body).
///
/// At a fixed k the stop time and its gradient are smooth in r = gamma mu^2/chi. The first start with an r in an
/// interval solves the systems at Chebyshev's points of this interval. All starts are then interpolated between these
/// points (numerics.md, "A mu of its own"). A Flow solves a start alone in three cases: r exceeds max_r, the last terms
/// of the start's Chebyshev series are too large, or its speeds lie outside 2^-300 to 2^300. Closed forms need no
/// interval.
///
/// Threads may share the object. Copies share the solutions.
///
/// Accuracy  stop times 6 eps relative, with a drive 8 eps/(1 - drive), plus the error of the law's curve; derivatives
///           as Flow::stop_time_gradient
/// Cost      8 ms for an interval of the exact law; then 1.2 us a start, with the gradient 7 us
/// Bits      depend on the start and mu alone
/// Source    theory.md and numerics.md (R5), (R7), (R35); barycentric interpolation
class StopTimesOfMu {
 public:
  /// Largest r of the intervals. Every homogeneous ball with mu <= 1 has an r up to this number.
  static constexpr double max_r = 5.0 / 7;

  /// @param drive  rho, as in ReducedSystem
  /// @throws std::domain_error  if chi or gamma is not positive and finite, or drive is not allowed
  StopTimesOfMu(const Law& law, Inertia body, double drive = 0);

  /// Returns the stop time of a start under the patch ratio mu.
  /// @throws std::domain_error  if mu is not positive and finite, or start is not a state (finite, v >= 0)
  double operator()(double mu, State start) const;

  /// Returns the stop time and its gradient, as Flow::stop_time_gradient.
  /// @throws std::domain_error  as operator(), and at u = v = 0
  StopTimeGradient gradient(double mu, State start) const;

  /// Returns true if a start is solved alone.
  /// @param gradient  true for the gradient, false for the stop time
  bool solves_alone(double mu, State start, bool gradient) const;

 private:
  struct Tables;
  std::shared_ptr<const Tables> tables_;
};

}  // namespace contensou::reduction
