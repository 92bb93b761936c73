#pragma once

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// What k = v/(mu |u|) tends to as a body that slides and pivots comes to rest.
enum class TerminalRegime {
  zero,      ///< sliding dies out first: k -> 0
  ray,       ///< both die out together: k tends to that of an invariant ray
  infinity,  ///< pivoting dies out first: k -> infinity
};

/// The end of every motion under a law and an r = gamma mu^2/chi, whatever its start (the axes excepted).
struct TerminalRatio {
  TerminalRegime regime;
  double k;     ///< 0, that of the ray, or infinity
  double low;   ///< the ray exists for low < r < high: Phi'(0)/Psi(0)
  double high;  ///< 1/(k Psi) as k -> infinity
};

/// Solves Phi(k) = r k Psi(k): d ln k/ds vanishes there (README (R2)).
///
/// @param r  gamma mu^2/chi, > 0
/// @throws std::domain_error  if r is not positive and finite, or if there are several such k (potential8 just below
///                            r = 2): where k goes then depends on the start
///
/// Accuracy  k to 1e-14 relative, unless r is so close to low or high that Phi/(k Psi) hardly changes.
TerminalRatio terminal_ratio(const Law& law, double r);

}  // namespace contensou::reduction
