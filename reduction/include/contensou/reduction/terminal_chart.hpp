#pragma once

#include <limits>

namespace contensou::reduction {

/// A coordinate xi of k = v/(mu |u|) between two neighbouring invariant ratios: the terminal ratio k*, which is the
/// limit of k at the stop, and k_far, from which k comes. Each of the two is 0, the k of an invariant ray, or infinity.
///
/// xi is the argument of every SimilarityCurve (README (R25)). It falls to -infinity at the stop and grows to infinity
/// at k_far.
///   from above:  xi = ln[(k - k*)/(1 - k/k_far)]          (k* = 0, k_far = infinity: ln k)
///   from below:  xi = ln[(1/k - 1/k*)/(1 - k_far/k)]      (k* = infinity, k_far = 0: -ln k)
/// Next to k* and k_far the double k has lost the digits of its distance from k* or k_far; xi keeps these digits.
class TerminalChart {
 public:
  enum class Side { above, below };

  /// Makes the chart with the farthest k_far on this side of k*: infinity above k*, 0 below k*.
  /// @param ln_k_star  ln of the terminal ratio: -infinity is only reached from above, +infinity only from below
  /// @throws std::domain_error  if ln_k_star is not a number; +infinity with Side::above, -infinity with Side::below
  TerminalChart(Side side, double ln_k_star);

  /// Makes the chart from k_far, above or below k*, to k*.
  /// @throws std::domain_error  if the two are equal or not numbers
  static TerminalChart between(double ln_k_star, double ln_k_far);

  /// Returns the chart from infinity to 0, in which xi is ln k.
  static TerminalChart to_zero();

  Side side() const { return sign_ > 0 ? Side::above : Side::below; }

  /// Returns ln k*.
  double log_terminal_ratio() const { return sign_ * end_; }

  /// Returns ln k_far.
  double log_far_ratio() const { return sign_ * far_; }

  /// Returns true if k lies between k* and k_far or equals one of them.
  bool reaches(double ln_k) const { return sign_ * ln_k >= end_ && sign_ * ln_k <= far_; }

  /// Returns xi of a k between k* and k_far. Let y be ln k (from below -ln k). At k* the result is y(k*) +
  /// min_coordinate, and at k_far it is y(k_far) - min_coordinate.
  double coordinate(double ln_k) const;

  /// Returns ln k.
  double log_ratio(double xi) const;

  /// Returns d ln k/d xi: positive from above, negative from below. It is 0 at an end, unless the end is 0 or infinity.
  double log_ratio_rate(double xi) const;

  /// Difference xi - ln k* (from below xi + ln k*) at which exp(xi) is negligible compared with k* (from below 1/k*).
  static constexpr double min_coordinate = -745;

 private:
  TerminalChart(double sign, double end, double far);

  double sign_;  ///< 1 or -1, the sign of d ln k/d xi
  double end_;   ///< sign_ ln k*; exp(xi) = (exp(y) - exp(end_))/(1 - exp(y - far_)) on both sides, y = sign_ ln k
  double far_;   ///< sign_ ln k_far
};

}  // namespace contensou::reduction
