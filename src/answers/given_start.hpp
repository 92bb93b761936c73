#pragma once

#include <optional>

#include "contensou/reduction/reduced_system.hpp"
#include "contensou/si/experiment.hpp"

namespace contensou::answers {

/// The start that is asked for, and under which law.
struct GivenStart {
  reduction::ReducedSystem system;
  reduction::State state;
  std::optional<si::Experiment> experiment;  ///< where it came from, if it is a ball in SI units

  bool at_rest() const { return state.u == 0 && state.v == 0; }
  bool slides_and_spins() const { return state.u != 0 && state.v != 0; }
};

}  // namespace contensou::answers
