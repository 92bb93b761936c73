#pragma once

#include <memory>
#include <optional>

#include "contensou/reduction/flow.hpp"
#include "fit/film_orbit.hpp"

namespace contensou::fit {

/// The flow of a body with a patch, and those with patches next to it, which are solved when they are asked for.
class FlowsOfPatch {
 public:
  explicit FlowsOfPatch(const reduction::ReducedSystem& system) : here(system) {}

  const reduction::Flow here;
  const reduction::Flow& larger() const;
  const reduction::Flow& smaller() const;

 private:
  mutable std::optional<reduction::Flow> larger_, smaller_;
};

/// The orbit of any body, one that lies flat, say, whose slip and spin end together on an invariant ray. The library's own,
/// which knows all of it at once; its derivatives are by friction and by the scale of the start exact, by ln mu and by the
/// ratio of the start those of central differences, to 1e-8.
class FlowOrbit final : public FilmOrbit {
 public:
  FlowOrbit(std::shared_ptr<const FlowsOfPatch> flows, reduction::State start);

  void reach(double /*T*/) override {}
  Moment at(double T, std::size_t& cell) const override;
  Speeds speeds_at(double T, std::size_t& cell) const override;
  Stop stop() const override;

 private:
  reduction::Orbit orbit_of(const reduction::Flow& flow, double ln_ratio) const;
  Speeds speeds_of(const reduction::Orbit& orbit, double T) const;

  std::shared_ptr<const FlowsOfPatch> flows_;
  reduction::State start_;  ///< v >= 0
  double side_;             ///< sign of the start's v
  bool on_axis_;
  reduction::Orbit orbit_;
  /// With a larger and a smaller v/|u| at the start; on an axis with a little of the speed that is 0.
  mutable std::optional<reduction::Orbit> more_, less_;
  mutable std::optional<reduction::Orbit> larger_, smaller_;  ///< patch
  void solve_neighbours() const;
};

}  // namespace contensou::fit
