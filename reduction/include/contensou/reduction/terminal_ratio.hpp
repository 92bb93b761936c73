#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// The limit of k = v/(mu |u|) as a body that slides and pivots comes to rest. u and v always vanish at the same time
/// (README (R39)). The limit of k shows whether u or v vanishes faster.
enum class TerminalRegime {
  zero,      ///< k -> 0: v vanishes faster
  ray,       ///< k tends to the k of an invariant ray
  infinity,  ///< k -> infinity: u vanishes faster
};

/// Returns a regime in words.
constexpr std::string_view meaning(TerminalRegime regime) {
  return regime == TerminalRegime::zero  ? "u and v vanish together, v faster"
         : regime == TerminalRegime::ray ? "u and v vanish together, in the ratio of an invariant ray"
                                         : "u and v vanish together, u faster";
}

/// A limit of k, with the starts whose motions have this limit.
struct TerminalRatio {
  TerminalRegime regime;
  double k;     ///< 0, the k of a ray, or infinity
  double from;  ///< starts with a ratio in (from, to) have this limit; both are invariant, except 0 with a drive
  double to;
};

/// An orbit along a ray v = k mu |u|, on which k stays constant: Phi = r k Psi.
struct InvariantRay {
  double k;
  bool attracts_above;  ///< starts with a slightly larger k tend to the ray; if false, they leave the ray
  bool attracts_below;  ///< likewise for a slightly smaller k; if Phi/(k Psi) touches r there, one side only attracts
  double accuracy;      ///< relative error of k: rounding of the law divided by the slope of Phi/(k Psi)

  bool attracts() const { return attracts_above && attracts_below; }
};

/// The zeros of Phi - r k Psi for 0 < k < infinity, and the limits of k between them.
///
/// k falls if Phi > r k Psi and grows if Phi < r k Psi (README (R2)). Therefore every motion between two neighbours
/// among 0, the rays and infinity moves away from one neighbour and tends to the other. For the named pressures and the
/// Pade law Phi/(k Psi) grows with k. Then, for low < r < high, there is one ray; it attracts and is the only limit. A
/// tabulated pressure can have several rays. For r <= 1/2 no pressure on a disc has a ray (README (R40)).
struct TerminalRatios {
  double low;                       ///< Phi/(k Psi) at k = 0, that is Phi'(0)/Psi(0)
  double high;                      ///< (Phi - rho)/(k Psi) at k = infinity
  std::vector<InvariantRay> rays;   ///< increasing in k
  std::vector<TerminalRatio> ends;  ///< increasing in k; never empty

  /// Returns the limit of k of the motions with this k. The k of an axis or a ray is its own limit.
  /// @param k  from 0 to infinity
  /// @throws std::domain_error  if k is negative or not a number
  TerminalRatio end_of(double k) const;

  /// If the relative difference of Phi/(k Psi) and r is at most this number, it counts as 0. Two rays count as one if
  /// the difference stays that small between them. A ray is left out if the difference stays so up to an axis.
  static constexpr double tolerance = 512 * std::numeric_limits<double>::epsilon();
};

/// Finds every k with Phi(k) = rho + r k Psi(k), at which k stays constant: d ln k/ds = 0 in the scaled time s.
///
/// @param r      gamma mu^2/chi, > 0
/// @param drive  rho of ReducedSystem. Under a drive k = 0 is not invariant, and motions from k = 0 have the limit of
///               neighbouring motions
/// @throws std::domain_error   if r is not positive and finite
/// @throws std::runtime_error  if a ray next to infinity can be neither found nor excluded, because a drive next to 1
///                             nearly cancels the friction and the law does not state its force_deficit
///
/// Accuracy  as InvariantRay::accuracy: 2e-15 if Phi/(k Psi) is steep.
/// Cost      700 calls of the law, at distances of 1/16 in ln k. Two rays between neighbouring calls are found if
///           Phi/(k Psi) has no more than one extremum between these calls.
TerminalRatios terminal_ratios(const Law& law, double r, double drive = 0);

/// Returns the smallest ln k under a drive. A motion from v = 0 has this k just after it has begun to creep.
double least_log_ratio(const Law& law, double r, double drive);

}  // namespace contensou::reduction
