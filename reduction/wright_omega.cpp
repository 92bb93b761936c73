#include "contensou/reduction/wright_omega.hpp"

#include <cmath>
#include <stdexcept>

#include <boost/math/special_functions/lambert_w.hpp>

namespace contensou::reduction {

double wright_omega(double x) {
  if (std::isnan(x)) throw std::domain_error("wright_omega: x must be a number, got nan");
  constexpr double negligible = -40;  // W(z) = z (1 - z + ...): beyond this, z to the last bit
  constexpr double large = 500;       // exp(x) is still far from the end of the double range
  if (x < negligible) return std::exp(x);
  if (x < large) return boost::math::lambert_w0(std::exp(x));
  if (std::isinf(x)) return x;
  // One step of Newton from w = x - ln x squares its relative error, which is below ln(x)/x^2 = 3e-5 here: the second
  // leaves (3e-5)^4.
  double w = x - std::log(x);
  for (int step = 0; step < 2; ++step) w -= (w - x + std::log(w)) * (w / (1 + w));
  return w;
}

}  // namespace contensou::reduction
