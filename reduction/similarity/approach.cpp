#include "contensou/reduction/approach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::reduction {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

Approach::Approach(Side side, double ln_k_star) : sign_(side == Side::above ? 1 : -1), end_(sign_ * ln_k_star) {
  if (std::isnan(ln_k_star) || end_ == infinity) {
    throw std::domain_error(fmt::format("Approach: nothing is {} a terminal ratio with ln k* = {}",
                                        side == Side::above ? "above" : "below", ln_k_star));
  }
}

Approach Approach::to_zero() { return {Side::above, -infinity}; }

double Approach::coordinate(double ln_k) const {
  const double y = sign_ * ln_k;
  if (end_ == -infinity) return y;
  const double distance = y - end_;
  if (!(distance > 0)) return end_ + lowest_nearness;
  return std::max(distance < 1 ? end_ + std::log(std::expm1(distance)) : y + std::log1p(-std::exp(-distance)),
                  end_ + lowest_nearness);
}

double Approach::log_ratio(double xi) const {
  return sign_ * (xi > end_ ? xi + std::log1p(std::exp(end_ - xi)) : end_ + std::log1p(std::exp(xi - end_)));
}

double Approach::log_ratio_rate(double xi) const {
  // 1 - k*/k, or -(1 - k/k*).
  return sign_ / (1 + std::exp(end_ - xi));
}

}  // namespace contensou::reduction
