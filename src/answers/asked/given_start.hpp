#pragma once

#include <optional>
#include <vector>

#include "contensou/reduction/reduced_system.hpp"
#include "contensou/si/resisted_motion.hpp"

namespace contensou::answers {

/// The start that is asked for, and under which law.
struct GivenStart {
  reduction::ReducedSystem system;
  reduction::State state;
  std::optional<si::Experiment> experiment;  ///< where it came from, if it is a ball in SI units
  std::optional<si::ResistedMotion> resisted =
      {};  ///< with rolling friction or on a slope: of the first piece is system

  /// The orbits of a ball with rolling friction or on a slope.
  std::vector<si::ReducedPiece> pieces() const {
    return resisted ? resisted->pieces() : std::vector<si::ReducedPiece>();
  }

  bool at_rest() const { return state.u == 0 && state.v == 0; }
  bool slides_and_spins() const { return state.u != 0 && state.v != 0; }
};

}  // namespace contensou::answers
