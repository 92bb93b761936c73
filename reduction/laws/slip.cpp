#include "contensou/reduction/slip.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::reduction {

Slip slip_of_ratio(double k) {
  if (!(k >= 0)) {
    throw std::domain_error(fmt::format("slip_of_ratio: the ratio k = sliding/pivoting must be >= 0, got {}", k));
  }
  return k <= 1 ? Slip{k, 1} : Slip{1, 1 / k};
}

void require_slip(const char* law, Slip slip) {
  const bool speeds =
      std::isfinite(slip.sliding) && std::isfinite(slip.pivoting) && slip.sliding >= 0 && slip.pivoting >= 0;
  if (!speeds) {
    throw std::domain_error(fmt::format("{}: sliding and pivoting must be finite and >= 0, got {} and {}", law,
                                        slip.sliding, slip.pivoting));
  }
  if (slip.sliding == 0 && slip.pivoting == 0) {
    throw std::domain_error(
        fmt::format("{}: sliding and pivoting are both 0; friction has no limit at rest (Zh98, remark 3)", law));
  }
}

}  // namespace contensou::reduction
