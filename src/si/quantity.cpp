#include "contensou/si/quantity.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::si {

namespace {

bool allows(Quantity::Range range, double value) {
  switch (range) {
    case Quantity::Range::any:
      return true;
    case Quantity::Range::not_negative:
      return value >= 0;
    case Quantity::Range::positive:
      return value > 0;
    case Quantity::Range::poisson_ratio:
      return value > -1 && value <= 0.5;
  }
  return false;
}

std::string_view sentence(Quantity::Range range) {
  switch (range) {
    case Quantity::Range::any:
      return "finite";
    case Quantity::Range::not_negative:
      return "finite and >= 0";
    case Quantity::Range::positive:
      return "finite and > 0";
    case Quantity::Range::poisson_ratio:
      return "above -1 and at most 0.5";
  }
  return "";
}

}  // namespace

void require(const Quantity& quantity, double value) {
  if (std::isfinite(value) && allows(quantity.range, value)) return;
  throw std::domain_error(fmt::format("{} must be {}{}{}, got {}", quantity.name, sentence(quantity.range),
                                      quantity.unit.empty() ? "" : ", in ", quantity.unit, value));
}

}  // namespace contensou::si
