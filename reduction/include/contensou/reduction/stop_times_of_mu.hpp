#pragma once

#include <memory>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The stop times of one law and one body for starts that each have their own mu (patch radius divided by R).
///
/// The stop time is tau* = P + m S (README (R18)), where m depends on k = v/(mu |u|) and on r = gamma mu^2/chi and is
/// smooth in r. m is stored as the tables of sixteen systems, at Chebyshev's points of 0 < r < 5/7, and interpolated
/// between them. A Flow computes the other starts: r > 5/7, speeds that are not normal numbers, and panels that fail
/// their test.
///
/// Source    README (R18), (R20); barycentric interpolation in r.
/// Accuracy  6 eps relative, plus the error of the law's curve; each panel is tested at three r between the points.
/// Cost      about 0.1 s for the tables; then 0.1 us a start, compared with 150 us by a Flow.
/// Bits      the result depends on the start and mu alone.
class StopTimesOfMu {
 public:
  /// Largest r of the tables. Every homogeneous ball with mu <= 1 has a smaller or equal r.
  static constexpr double max_r = 5.0 / 7;

  /// Makes the tables.
  /// @throws std::domain_error  if chi or gamma is not positive and finite
  StopTimesOfMu(const Law& law, Inertia body);

  /// Returns the stop time of a start under the patch ratio mu.
  /// @throws std::domain_error  if mu is not positive and finite, or start is not a state (finite, v >= 0)
  double operator()(double mu, State start) const;

  /// Returns the share of the panels that failed their test; half for ring and punch, whose m is too steep at r = 5/7.
  double refused() const;

 private:
  struct Stored;
  std::shared_ptr<const Stored> stored_;
};

}  // namespace contensou::reduction
