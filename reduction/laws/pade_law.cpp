#include "contensou/reduction/laws.hpp"

#include <numbers>

namespace contensou::reduction {

using std::numbers::pi;

Resistance PadeLaw::operator()(Slip slip) const {
  require_slip("PadeLaw", slip);
  if (slip.sliding <= slip.pivoting) {
    const double k = slip.sliding / slip.pivoting;
    return {3 * pi * k / (8 + 3 * pi * k), 3 * pi / (16 + 15 * pi * k)};
  }
  const double inverse_k = slip.pivoting / slip.sliding;
  return {3 * pi / (8 * inverse_k + 3 * pi), 3 * pi * inverse_k / (16 * inverse_k + 15 * pi)};
}

double PadeLaw::moment_deficit(Slip slip) const {
  if (slip.sliding <= slip.pivoting) {
    const double k = slip.sliding / slip.pivoting;
    return 15 * pi * k / (16 + 15 * pi * k);
  }
  return 15 * pi / (16 * (slip.pivoting / slip.sliding) + 15 * pi);
}

double PadeLaw::force_deficit(Slip slip) const {
  if (slip.sliding <= slip.pivoting) return 8 / (8 + 3 * pi * (slip.sliding / slip.pivoting));
  const double inverse_k = slip.pivoting / slip.sliding;
  return 8 * inverse_k / (8 * inverse_k + 3 * pi);
}

}  // namespace contensou::reduction
