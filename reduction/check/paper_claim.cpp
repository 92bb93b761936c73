#include "contensou/reduction/paper_claim.hpp"

#include <algorithm>
#include <cmath>

namespace contensou::reduction {

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::slip:
      return "slip";
    case Verdict::not_true:
      break;
  }
  return "false";
}

Verdict Evidence::verdict() const {
  const auto agrees = [&](double value) {
    if (at_least) return computed >= value;
    return value == computed || std::abs(value - computed) <= allowed * std::max(1.0, std::abs(computed));
  };
  if (agrees(printed)) return Verdict::holds;
  return corrected && agrees(*corrected) ? Verdict::slip : Verdict::not_true;
}

}  // namespace contensou::reduction
