#include "contensou/reduction/detail/tangent.hpp"

#include <algorithm>

#include "contensou/reduction/laws.hpp"

namespace contensou::reduction {

/// Uses second-order differences in the ratio smaller/larger speed; next to a ratio of 0 the differences are one-sided.
kernel::Friction<double> ByDifferences::operator()(const kernel::Slip<double>& slip) const {
  constexpr double step = 6e-6;  // with this step, rounding and third derivative give about equal errors
  const bool pivots = slip.p <= slip.r;
  const double ratio = pivots ? slip.p : slip.r;
  const auto at = [&](double x) { return law(pivots ? Slip{x, 1} : Slip{1, x}); };
  const bool beside_0 = ratio < step;
  const Resistance here = at(ratio);
  const Resistance next = at(ratio + step);
  const Resistance third = at(beside_0 ? ratio + 2 * step : ratio - step);
  const auto slope = [&](double Resistance::*part) {
    const double change = beside_0 ? 4 * next.*part - 3 * here.*part - third.*part : next.*part - third.*part;
    return change / (2 * step) * (pivots ? 1 : -1);
  };
  const double force_slope = slope(&Resistance::force), moment_slope = -slope(&Resistance::moment);
  constexpr double least = 1e-300;  // for a smaller p or r, the quotient equals its limit
  return {slip.p > least ? here.force / slip.p : force_slope, slip.r > least ? here.moment / slip.r : moment_slope,
          force_slope, moment_slope};
}

SlopedLaw with_slopes(const Law& law) {
  if (law.as<HertzLaw>() != nullptr) return kernel::Exact{};
  if (const auto* pressure = law.as<PressureLaw>(); pressure != nullptr && pressure->p() == 0) return kernel::Uniform{};
  if (const auto* elliptic = law.as<EllipticLaw>()) return kernel::Elliptic{elliptic->moment()};
  if (law.as<PadeLaw>() != nullptr) return kernel::Pade{};
  return ByDifferences{law};
}

std::function<kernel::Friction<double>(Slip)> tangent_of(const Law& law) {
  const auto function = [](const auto& sloped) -> std::function<kernel::Friction<double>(Slip)> {
    return [sloped](Slip slip) {
      require_slip("tangent_of", slip);
      const double larger = std::max(slip.sliding, slip.pivoting);
      const double p = slip.sliding / larger, r = slip.pivoting / larger, smaller = std::min(p, r);
      const double gap = (1 - smaller) * (1 + smaller);
      return sloped(kernel::Slip<double>{p, p, r, gap, gap});
    };
  };
  return std::visit(function, with_slopes(law));
}

double tangent_error(const Law& law) { return std::holds_alternative<ByDifferences>(with_slopes(law)) ? 1e-9 : 0; }

}  // namespace contensou::reduction
