#include "contensou/reduction/detail/root.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

#include <boost/math/tools/toms748_solve.hpp>

namespace contensou::reduction {

double root_between(const std::function<double(double)>& function, double low, double high, double at_low,
                    double at_high) {
  if (at_low == 0 || (at_low < 0) == (at_high < 0)) return std::abs(at_low) <= std::abs(at_high) ? low : high;
  constexpr int digits = std::numeric_limits<double>::digits - 2;
  std::uintmax_t most = 200;
  const auto [left, right] = boost::math::tools::toms748_solve(function, low, high, at_low, at_high,
                                                               boost::math::tools::eps_tolerance<double>(digits), most);
  return left + (right - left) / 2;
}

}  // namespace contensou::reduction
