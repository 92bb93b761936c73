#include "contensou/reduction/paper_system.hpp"

#include <cmath>
#include <numbers>

namespace contensou::reduction::paper {

using std::numbers::pi;

Rate field(double mu, State state) {
  const auto [u, v] = state;
  return {-5 * mu * mu * u / (16 * mu * std::abs(u) + 15 * pi * v), -7 * v / (8 * mu * std::abs(u) + 3 * pi * v)};
}

Rate regularised_field(double mu, State state) {
  const auto [u, v] = state;
  return {-5 * mu * mu * u * (8 * mu * std::abs(u) + 3 * pi * v), -7 * v * (16 * mu * std::abs(u) + 15 * pi * v)};
}

double regularising_weight(double mu, State state) {
  const auto [u, v] = state;
  return (16 * mu * std::abs(u) + 15 * pi * v) * (8 * mu * std::abs(u) + 3 * pi * v);
}

double slope(double mu, State state) {
  const auto [u, v] = state;
  return 7 * v * (16 * mu * std::abs(u) + 15 * pi * v) / (5 * mu * mu * u * (8 * mu * std::abs(u) + 3 * pi * v));
}

}  // namespace contensou::reduction::paper
