#include "contensou/portraits/speed_scale.hpp"

#include <cmath>

namespace contensou::portraits {

double SpeedScale::height(double ln_v) const {
  const double ln_x = ln_v - std::log(top);
  return (std::exp(ln_x) + std::exp(exponent * ln_x)) / 2;
}

double SpeedScale::slope(double ln_v) const {
  const double ln_x = ln_v - std::log(top);
  return (std::exp(ln_x) + exponent * std::exp(exponent * ln_x)) / 2;
}

double SpeedScale::ln_v(double height) const {
  // x^s is between h and 2h, or less where h > 1/2; halved in ln x^s.
  double low = std::log(height) - 1, high = std::log(2 * height);
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    ((std::exp(middle / exponent) + std::exp(middle)) / 2 < height ? low : high) = middle;
  }
  return std::log(top) + (low + high) / 2 / exponent;
}

}  // namespace contensou::portraits
