#pragma once

#include <optional>
#include <vector>

#include "contensou/si/motion.hpp"

namespace contensou::answers {

/// A start that a user gives, and the reduced system (body, mu and law) of this start.
struct GivenStart {
  reduction::ReducedSystem system;
  reduction::State state;
  std::optional<si::Experiment> experiment;  ///< source of the start, if the start is that of a ball in SI units
  std::optional<si::Motion> motion = {};     ///< motion of a ball; `system` is that of the first piece of this motion

  /// Returns the pieces of `motion`, each one orbit, in the order of time; empty without a ball.
  std::vector<si::ReducedPiece> pieces() const { return motion ? motion->pieces() : std::vector<si::ReducedPiece>(); }
  bool is_in_pieces() const { return pieces().size() > 1; }

  /// Returns the solution of `system`.
  /// @param by_quadrature  true: by quadrature even if the law has a closed form
  reduction::Flow flow(bool by_quadrature = false) const {
    const auto all = pieces();
    const reduction::Flow best = all.empty() ? reduction::Flow(system) : all.front().flow;
    return by_quadrature && !best.is_by_quadrature() ? reduction::Flow::by_quadrature(system) : best;
  }

  bool at_rest() const { return state.u == 0 && state.v == 0; }
  bool slides_and_spins() const { return state.u != 0 && state.v != 0; }
};

}  // namespace contensou::answers
