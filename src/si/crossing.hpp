#pragma once

#include <cstdint>

#include <boost/math/tools/toms748_solve.hpp>

namespace contensou::si {

/// A root of a function of time that has different signs at both ends, to 50 bits, by Boost's TOMS 748.
template <class Function>
double crossing(Function function, double low, double high) {
  const double at_low = function(low), at_high = function(high);
  if (at_low == 0) return low;
  if (at_high == 0) return high;
  std::uintmax_t most = 200;
  const auto [left, right] = boost::math::tools::toms748_solve(function, low, high, at_low, at_high,
                                                               boost::math::tools::eps_tolerance<double>(50), most);
  return left + (right - left) / 2;
}

}  // namespace contensou::si
