#pragma once

#include <numbers>

namespace contensou::reduction {

/// Returns dtau/dbeta, the weight of the regularised equations (2.7) and (2.8), at scaled speeds w = mu |u| and v.
inline double regularising_weight(double w, double v) {
  using std::numbers::pi;
  return (16 * w + 15 * pi * v) * (8 * w + 3 * pi * v);
}

}  // namespace contensou::reduction
