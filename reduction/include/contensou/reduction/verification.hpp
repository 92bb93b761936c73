#pragma once

#include <string>
#include <vector>

#include "contensou/reduction/flow.hpp"

namespace contensou::reduction {

/// One statement that must hold, and how well it does.
struct Check {
  std::string name;
  double measured;  ///< the worst case; not a number counts as failed
  double allowed;
  bool passed() const { return measured <= allowed; }
};

/// Everything the theory says about one motion, each as a number that must be small: the routes against each other, the
/// scaling generator on (2.6), (2.7) and dv/du, the separated equation, the first integral, beta against (2.8), both
/// limits, the law's own bounds, and for the exact law its elementary orbit inside k = 1.
///
/// @param flow  what is examined: a closed form, also one of your own, is held against quadrature
/// @throws std::domain_error  if start is not a state or is at rest, or r < 1e-100
std::vector<Check> verify(const Flow& flow, State start);

/// The same over several starts of one system: each row the worst of them.
std::vector<Check> verify(const Flow& flow, const std::vector<State>& starts);

}  // namespace contensou::reduction
