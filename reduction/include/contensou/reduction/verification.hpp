#pragma once

#include <string>
#include <vector>

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// One statement that must hold, with its measured error.
struct Check {
  std::string name;
  double measured;  ///< largest error; NaN counts as failed
  double allowed;
  bool passed() const { return measured <= allowed; }
};

/// Computes every statement of the theory about one motion as a number that must be small. It compares the routes to
/// the stop time with each other. It tests the scaling generator on the equations of motion (2.6), the regularised
/// equations (2.7) and dv/du. It tests the separated equation, the first integral, the time beta against its definition
/// (2.8), the limits on both axes and the law's bounds; for the exact law also the elementary orbit for k <= 1.
///
/// @param flow  motions to examine; its closed form, also one that the caller gave, is compared with quadrature
/// @throws std::domain_error  if start is not a state or is at rest, or r < 1e-100
std::vector<Check> verify(const Flow& flow, State start);

/// Computes the same statements over several starts of one system; each row is the worst result over the starts.
std::vector<Check> verify(const Flow& flow, const std::vector<State>& starts);

}  // namespace contensou::reduction
