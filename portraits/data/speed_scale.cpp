#include "contensou/portraits/speed_scale.hpp"

#include <algorithm>
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
  if (linear()) return std::log(top) + std::log(height);
  // Newton's method in l = ln x^s, from above. The height is convex in l, so each step decreases l and none overshoots.
  const double twice = std::log(2 * height);
  double l = std::min(twice, exponent * twice);
  for (int i = 0; i < 60; ++i) {
    const double x = std::exp(l / exponent), power = std::exp(l);
    const double step = (x + power - 2 * height) / (x / exponent + power);
    l -= step;
    if (!(step > 1e-15)) break;
  }
  return std::log(top) + l / exponent;
}

}  // namespace contensou::portraits
