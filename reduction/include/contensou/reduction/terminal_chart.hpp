#pragma once

#include <limits>

namespace contensou::reduction {

/// How k = v/(mu |u|) goes from one invariant ratio, k_far, to the next, its terminal ratio k*: from which side, and
/// how near it is. Each of the two is 0, that of an invariant ray, or infinity.
///
/// The nearness is the coordinate xi of every SimilarityCurve (README (R25)); it falls to -infinity at the stop and
/// grows to infinity at k_far.
///   from above:  xi = ln[(k - k*)/(1 - k/k_far)]          (k* = 0, k_far = infinity: ln k)
///   from below:  xi = ln[(1/k - 1/k*)/(1 - k_far/k)]      (k* = infinity, k_far = 0: -ln k)
/// Next to k* and k_far a double k says little about its distance to them, and xi all of it.
class TerminalChart {
 public:
  enum class Side { above, below };

  /// From as far as there is on this side: infinity above, 0 below.
  /// @param ln_k_star  ln of the terminal ratio: -infinity is only reached from above, +infinity only from below
  /// @throws std::domain_error  if ln_k_star is not a number, or at infinity on the other side
  TerminalChart(Side side, double ln_k_star);

  /// From k_far, above k* or below it.
  /// @throws std::domain_error  if they are equal or not numbers
  static TerminalChart between(double ln_k_star, double ln_k_far);

  /// k -> 0 from infinity: xi is ln k.
  static TerminalChart to_zero();

  Side side() const { return sign_ > 0 ? Side::above : Side::below; }

  /// ln k*.
  double log_terminal_ratio() const { return sign_ * end_; }

  /// ln k_far.
  double log_far_ratio() const { return sign_ * far_; }

  /// Whether k is between k* and k_far, or one of them.
  bool reaches(double ln_k) const { return sign_ * ln_k >= end_ && sign_ * ln_k <= far_; }

  /// xi of a k between them; k* itself, and what is nearer than a double tells, as min_coordinate below it, and k_far
  /// as much above.
  double coordinate(double ln_k) const;

  /// ln k.
  double log_ratio(double xi) const;

  /// d ln k/d xi: positive from above, negative from below, 0 at a k* or k_far that is neither 0 nor infinity.
  double log_ratio_rate(double xi) const;

  /// Where exp(xi) is 0 beside any k*.
  static constexpr double min_coordinate = -745;

 private:
  TerminalChart(double sign, double end, double far);

  double sign_;  ///< of d ln k/d xi
  double
      end_;  ///< sign_ ln k*: both sides are one in y = sign_ ln k, exp(xi) = (exp(y) - exp(end_))/(1 - exp(y - far_))
  double far_;  ///< sign_ ln k_far
};

}  // namespace contensou::reduction
