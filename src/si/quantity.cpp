#include "contensou/si/quantity.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace contensou::si {

void require(const Quantity& quantity, double value) {
  using enum Quantity::Range;
  const auto [allowed, sentence] = [&]() -> std::pair<bool, std::string_view> {
    switch (quantity.range) {
      case any:
        return {true, "finite"};
      case not_negative:
        return {value >= 0, "finite and >= 0"};
      case positive:
        return {value > 0, "finite and > 0"};
      case poisson_ratio:
        break;
    }
    return {value > -1 && value <= 0.5, "above -1 and at most 0.5"};
  }();
  if (std::isfinite(value) && allowed) return;
  throw std::domain_error(fmt::format("{} must be {}{}{}, got {}", quantity.name, sentence,
                                      quantity.unit.empty() ? "" : ", in ", quantity.unit, value));
}

}  // namespace contensou::si
