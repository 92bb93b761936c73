#pragma once

#include <functional>

namespace contensou::reduction {

/// Finds a function's root between two arguments, by TOMS 748 (G. Alefeld, F. Potra, Y. Shi,
/// doi:10.1145/210089.210111).
/// @param at_low, at_high  the function's values at low and high, of different signs up to rounding
/// @return the root; for values of equal signs, the argument with the value nearer to 0
double root_between(const std::function<double(double)>& function, double low, double high, double at_low,
                    double at_high);

/// Computes the function's values at both ends, then finds the root.
inline double root_between(const std::function<double(double)>& function, double low, double high) {
  return root_between(function, low, high, function(low), function(high));
}

/// Finds, by bisection, the last point at which a condition holds on the way from `from` to `to`. The condition holds
/// at `from` and does not hold at `to`.
template <class Holds>
double last_where(Holds holds, double from, double to, int halvings = 50) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = from + (to - from) / 2;
    (holds(middle) ? from : to) = middle;
  }
  return from;
}

}  // namespace contensou::reduction
