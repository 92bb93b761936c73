#pragma once

#include <string>
#include <vector>

#include "contensou/reduction/reduced_system.hpp"
#include "contensou/reduction/similarity_solution.hpp"

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
/// @param closed  what is held against quadrature: the closed form of the system's law, or a solution of your own;
///                empty where there is none
/// @throws std::domain_error  if start is not a state or is at rest, the law has no solution by quadrature
///                            (QuadratureCurve), or r < 1e-100
std::vector<Check> verify(const ReducedSystem& system, State start, const SimilaritySolution& closed);

/// With the closed form that the library has for the system's law, if it has one.
std::vector<Check> verify(const ReducedSystem& system, State start);

/// The same over several starts of one system: each row the worst of them.
std::vector<Check> verify(const ReducedSystem& system, const std::vector<State>& starts,
                          const SimilaritySolution& closed);
std::vector<Check> verify(const ReducedSystem& system, const std::vector<State>& starts);

}  // namespace contensou::reduction
