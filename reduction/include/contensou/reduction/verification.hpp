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

/// Computes every statement of the theory about one motion as a number that must be small. It compares the routes, and
/// tests the scaling generator on (2.6), (2.7) and dv/du, the separated equation, the first integral, beta against
/// (2.8), both limits, the law's bounds, and for the exact law its elementary orbit inside k = 1.
///
/// @param flow  motions to examine; a closed form, also one of the caller, is compared with quadrature
/// @throws std::domain_error  if start is not a state or is at rest, or r < 1e-100
std::vector<Check> verify(const Flow& flow, State start);

/// Computes the same statements over several starts of one system; each row is the worst of them.
std::vector<Check> verify(const Flow& flow, const std::vector<State>& starts);

}  // namespace contensou::reduction
