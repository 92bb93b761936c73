#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "contensou/reduction/orbit.hpp"

namespace contensou::reduction {

/// Many orbits of one system as columns, from one sampling of the curve that they are scaled copies of.
///
/// The instants are not equidistant: half of them follow k, evenly in xi, until its limit holds to the last bit; the
/// others are evenly spread over the time that is then left. Orbits that end on one terminal ratio from one side have
/// the same k in the rows that they share.
///
/// Accuracy  as Orbit; tau to eps of the stop time, a speed at least to 1e-290 of the start's.
/// Cost      some 150 ns for each instant of the sampling, once; then some 5 ns for each row.
class OrbitFamily {
 public:
  /// @param starts  on each side of the ray one at least as far from the terminal ratio as any orbit asked for
  /// @param count   instants of the sampling, 4 or more
  /// @throws std::domain_error  for fewer, and as Orbit
  OrbitFamily(const ReducedSystem& system, std::span<const State> starts, Eigen::Index count);

  /// With a solution made before.
  OrbitFamily(const ReducedSystem& system, const SimilaritySolution& solution, std::span<const State> starts,
              Eigen::Index count);

  /// The orbit from one start to rest, by growing tau: the start, the instants of the sampling after it, and the stop.
  /// On an axis the start and the stop alone: between them speeds are linear in tau.
  /// @throws std::domain_error  as Orbit
  OrbitColumns orbit(State start) const;

 private:
  struct Sampling;

  std::shared_ptr<const Sampling> sampling(const SimilaritySolution::Curve& curve, double highest) const;

  ReducedSystem system_;
  SimilaritySolution solution_;
  Eigen::Index count_;
  std::vector<std::shared_ptr<const Sampling>> samplings_;  ///< of the curves that starts are on: one or two
};

}  // namespace contensou::reduction
