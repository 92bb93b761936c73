#pragma once

#include <memory>

#include "contensou/reduction/reduced_system.hpp"

namespace contensou::reduction {

/// The stop times of one law and one body for starts that each have a mu of their own.
///
/// m of tau* = P + m S (README (R18)) is a function of k and r = gamma mu^2/chi that is smooth in r: it is kept as the
/// tables of sixteen systems, at Chebyshev's points of 0 < r < 5/7, and interpolated between them. What the interpolation
/// does not give is computed by a Flow: r > 5/7, speeds that are no ordinary numbers, a panel that fails its proof.
///
/// Source    README (R18), (R20); barycentric interpolation in r.
/// Accuracy  6 eps relative, and what the law's curve misses by: each panel is proved at three r between the points.
/// Cost      made in some 0.1 s; then 0.1 us a start, where a Flow takes 150 us.
/// Bits      depend on the start and mu alone.
class StopTimesOfMu {
 public:
  /// Every homogeneous ball with mu <= 1.
  static constexpr double max_r = 5.0 / 7;

  /// @throws std::domain_error  if chi or gamma is not positive and finite
  StopTimesOfMu(const Law& law, Inertia body);

  /// @throws std::domain_error  if mu is not positive and finite, or start is not a state (finite, v >= 0)
  double operator()(double mu, State start) const;

  /// The panels that failed their proof, over all: half of them under the laws ring and punch, for which m changes too
  /// fast towards r = 5/7.
  double refused() const;

 private:
  struct Stored;
  std::shared_ptr<const Stored> stored_;
};

}  // namespace contensou::reduction
