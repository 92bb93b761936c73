#pragma once

namespace contensou::reduction {

/// How k = v/(mu |u|) tends to its terminal ratio k*: from which side, and how near it is.
///
/// The nearness is the coordinate xi of every SimilarityCurve (README (R25)); it falls to -infinity at the stop.
///   from above:  xi = ln(k - k*)        (k* = 0: ln k)
///   from below:  xi = ln(1/k - 1/k*)    (k* = infinity: -ln k)
/// Next to k* a double k says little about k - k*, and xi all of it.
class Approach {
 public:
  enum class Side { above, below };

  /// @param ln_k_star  ln of the terminal ratio: -infinity is only reached from above, +infinity only from below
  /// @throws std::domain_error  if ln_k_star is not a number, or at infinity on the other side
  Approach(Side side, double ln_k_star);

  /// k -> 0: xi is ln k.
  static Approach to_zero();

  Side side() const { return sign_ > 0 ? Side::above : Side::below; }

  /// ln k*.
  double log_terminal_ratio() const { return sign_ * end_; }

  /// Whether k is on this side of k*, or k* itself.
  bool reaches(double ln_k) const { return sign_ * ln_k >= end_; }

  /// xi of a k on this side; k* itself, and what is nearer than a double tells, as lowest_nearness below it.
  double coordinate(double ln_k) const;

  /// ln k.
  double log_ratio(double xi) const;

  /// d ln k/d xi: positive from above, negative from below, 0 at a k* that is neither 0 nor infinity.
  double log_ratio_rate(double xi) const;

  /// Where exp(xi) is 0 beside any k*.
  static constexpr double lowest_nearness = -745;

 private:
  double sign_;  ///< of d ln k/d xi
  double end_;   ///< sign_ ln k*: both sides are one in y = sign_ ln k, exp(y) = exp(end_) + exp(xi)
};

}  // namespace contensou::reduction
