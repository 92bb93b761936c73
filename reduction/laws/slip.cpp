#include "contensou/reduction/friction_law.hpp"

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

namespace {

/// Throws. It is a separate function to keep the test in require_slip short, which runs in every call of a law.
[[noreturn, gnu::noinline]] void reject(const char* law, Slip slip) {
  if (slip.sliding == 0 && slip.pivoting == 0) {
    throw std::domain_error(
        fmt::format("{}: sliding and pivoting are both 0; friction has no limit at rest (Zh98, remark 3)", law));
  }
  throw std::domain_error(
      fmt::format("{}: sliding and pivoting must be finite and >= 0, got {} and {}", law, slip.sliding, slip.pivoting));
}

}  // namespace

void require_slip(const char* law, Slip slip) {
  const auto is_speed = [](double x) { return x >= 0 && std::isfinite(x); };
  if (!is_speed(slip.sliding) || !is_speed(slip.pivoting) || (slip.sliding == 0 && slip.pivoting == 0))
    reject(law, slip);
}

}  // namespace contensou::reduction
