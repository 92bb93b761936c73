#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "contensou/reduction/friction_law.hpp"

namespace contensou::reduction {

/// What k = v/(mu |u|) tends to as a body that slides and pivots comes to rest.
///
/// u and v vanish at one instant whatever the regime is (README (R39)): k says which of them is then the smaller.
enum class TerminalRegime {
  zero,      ///< k -> 0: v is the smaller in the end, by any factor
  ray,       ///< k tends to that of an invariant ray
  infinity,  ///< k -> infinity: u is the smaller in the end
};

/// The same in words.
constexpr std::string_view meaning(TerminalRegime regime) {
  return regime == TerminalRegime::zero  ? "u and v vanish together, v faster"
         : regime == TerminalRegime::ray ? "u and v vanish together, in the ratio of an invariant ray"
                                         : "u and v vanish together, u faster";
}

/// One end of motions, and which motions end there.
struct TerminalRatio {
  TerminalRegime regime;
  double k;     ///< 0, that of the ray, or infinity
  double from;  ///< every start with from < k < to goes there; both are invariant themselves, but for 0 with a drive
  double to;
};

/// A ray v = k mu |u| that motions keep to: Phi = r k Psi.
struct InvariantRay {
  double k;
  bool attracts_above;  ///< starts with a somewhat larger k go to it; otherwise they leave it
  bool attracts_below;  ///< starts with a somewhat smaller k do. Only one of the two where Phi/(k Psi) touches r
  double accuracy;      ///< relative error of k: rounding of the law, over the slope of Phi/(k Psi)

  bool attracts() const { return attracts_above && attracts_below; }
};

/// The zeros of Phi - r k Psi beside k = 0 and k = infinity, and where k goes between them.
///
/// k falls where Phi > r k Psi and grows where it is less (README (R2)), so that between two neighbours of 0, the rays
/// and infinity every motion leaves the one and tends to the other. Under the pressures that have a name and under the
/// Pade law Phi/(k Psi) grows with k: there is one ray for low < r < high, it attracts, and there is one end. Under a
/// pressure given as a table there may be several. For r <= 1/2 no pressure on a disc has a ray (README (R40)).
struct TerminalRatios {
  double low;                       ///< Phi/(k Psi) at k = 0, Phi'(0)/Psi(0)
  double high;                      ///< (Phi - rho)/(k Psi) at k = infinity
  std::vector<InvariantRay> rays;   ///< by growing k
  std::vector<TerminalRatio> ends;  ///< by growing k; never empty

  /// The end of the motions with this k; an axis and a ray end on themselves.
  /// @param k  from 0 to infinity
  /// @throws std::domain_error  if k is negative or not a number
  TerminalRatio end_of(double k) const;

  /// Where Phi/(k Psi) differs from r by less than this fraction of r it counts as r: two rays with no more between them
  /// are one, and one with no more between it and an axis is none.
  static constexpr double tolerance = 512 * std::numeric_limits<double>::epsilon();
};

/// Finds every k with Phi(k) = rho + r k Psi(k): d ln k/ds vanishes there.
///
/// @param r      gamma mu^2/chi, > 0
/// @param drive  rho of ReducedSystem. With one, k = 0 is no invariant ratio: starts at k = 0 go where those next to it do.
/// @throws std::domain_error   if r is not positive and finite
/// @throws std::runtime_error  if a drive next to 1 leaves less of friction than decides whether there is a ray next to
///                             infinity, under a law that does not state its force_deficit
///
/// Accuracy  InvariantRay::accuracy: 2e-15 where Phi/(k Psi) is steep.
/// Cost      700 evaluations of the law, at distances of 1/16 in ln k. Between two of them there may be two rays, if
///           Phi/(k Psi) has no more than one extremum there.
TerminalRatios terminal_ratios(const Law& law, double r, double drive = 0);

/// With a drive, a motion from v = 0 and one from this ln k are the same to the last bit: ln k of one that has just begun
/// to creep.
double least_log_ratio(const Law& law, double r, double drive);

}  // namespace contensou::reduction
