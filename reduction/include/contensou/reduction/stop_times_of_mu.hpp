#pragma once

#include <memory>

#include "contensou/reduction/reduced_system.hpp"
#include "contensou/reduction/stop_time_gradient.hpp"

namespace contensou::reduction {

/// The stop times of one law, one body and one drive for starts that each have their own mu (patch radius divided by R).
///
/// At a fixed k the stop time and its gradient are smooth in r = gamma mu^2/chi. The systems at Chebyshev's points of an
/// interval of r are solved when the first start needs the interval; all others are interpolated (numerics.md, "A mu of
/// its own"). A start is solved alone, by a Flow of its mu, if r > max_r, if the last terms of its Chebyshev series in r are
/// too large, or if its speeds are beyond 2^+-300. A stop time in closed form is computed at once.
///
/// Threads may share the object. Copies share the solutions.
///
/// Accuracy  stop times 6 eps relative, with a drive 8 eps/(1 - drive), plus the error of the law's curve; derivatives
///           as Flow::stop_time_gradient
/// Cost      of an interval 17 solutions of a Flow, 5 ms for the exact law; then 1 us a start, with gradient 4 us
/// Bits      depend on the start and mu alone
/// Source    README (R18), (R19), (R58); barycentric interpolation
class StopTimesOfMu {
 public:
  /// Largest r of the intervals, which every homogeneous ball with mu <= 1 satisfies.
  static constexpr double max_r = 5.0 / 7;

  /// @param drive  rho, as in ReducedSystem
  /// @throws std::domain_error  if chi or gamma is not positive and finite, or drive is not allowed
  StopTimesOfMu(const Law& law, Inertia body, double drive = 0);

  /// Returns the stop time of a start under the patch ratio mu.
  /// @throws std::domain_error  if mu is not positive and finite, or start is not a state (finite, v >= 0)
  double operator()(double mu, State start) const;

  /// Returns the stop time and its gradient, as Flow::stop_time_gradient.
  /// @throws std::domain_error  likewise, and at rest
  StopTimeGradient gradient(double mu, State start) const;

  /// Returns true if a start is solved alone.
  /// @param gradient  true to ask for the gradient, false for the stop time
  bool solves_alone(double mu, State start, bool gradient) const;

 private:
  struct Tables;
  std::shared_ptr<const Tables> tables_;
};

}  // namespace contensou::reduction
