#pragma once

#include <functional>

namespace contensou::reduction {

/// The root of a function between two places at which it has, to rounding, values of different signs: to the last bits,
/// by TOMS 748 (G. Alefeld, F. Potra, Y. Shi, doi:10.1145/210089.210111). Where the signs are equal, the place of the
/// smaller value.
double root_between(const std::function<double(double)>& function, double low, double high, double at_low,
                    double at_high);

/// The same, where the values at both places are still to be had.
inline double root_between(const std::function<double(double)>& function, double low, double high) {
  return root_between(function, low, high, function(low), function(high));
}

/// The last place on the way from one where a condition holds to one where it does not, by so many halvings.
template <class Holds>
double last_where(Holds holds, double from, double to, int halvings = 50) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = from + (to - from) / 2;
    (holds(middle) ? from : to) = middle;
  }
  return from;
}

}  // namespace contensou::reduction
