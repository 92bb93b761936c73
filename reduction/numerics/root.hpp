#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include <boost/math/tools/toms748_solve.hpp>

namespace contensou::reduction {

/// The root of a function between two places at which it has, to rounding, values of different signs: to the last bits,
/// by Boost's TOMS 748.
template <class Function>
double root_between(Function function, double low, double high, double at_low, double at_high) {
  if (at_low == 0 || (at_low < 0) == (at_high < 0)) return std::abs(at_low) <= std::abs(at_high) ? low : high;
  constexpr int digits = std::numeric_limits<double>::digits - 2;
  std::uintmax_t most = 200;
  const auto [left, right] = boost::math::tools::toms748_solve(function, low, high, at_low, at_high,
                                                               boost::math::tools::eps_tolerance<double>(digits), most);
  return left + (right - left) / 2;
}

}  // namespace contensou::reduction
