#include "contensou/reduction/tangent.hpp"

#include "contensou/reduction/elliptic_law.hpp"
#include "contensou/reduction/hertz_law.hpp"

namespace contensou::reduction {

namespace {

/// Returns the tangent by second-order differences in the ratio of the smaller speed to the larger, one-sided beside 0.
Tangent by_differences(const Law& law, Slip slip) {
  constexpr double step = 6e-6;  // rounding and the third derivative give about the same error
  const bool pivots = slip.sliding <= slip.pivoting;
  const double ratio = pivots ? slip.sliding / slip.pivoting : slip.pivoting / slip.sliding;
  const auto at = [&](double x) { return law(pivots ? Slip{x, 1} : Slip{1, x}); };
  const bool beside_0 = ratio < step;
  const Resistance here = at(ratio);
  const Resistance next = at(ratio + step);
  const Resistance third = at(beside_0 ? ratio + 2 * step : ratio - step);
  const auto slope = [&](double Resistance::*part) {
    const double change = beside_0 ? 4 * next.*part - 3 * here.*part - third.*part : next.*part - third.*part;
    return change / (2 * step);
  };
  const double sign = pivots ? 1 : -1;
  return {here, sign * slope(&Resistance::force), -sign * slope(&Resistance::moment)};
}

}  // namespace

Tangent Tangent::of_potential(Resistance resistance, Slip slip, double curvature) {
  if (slip.sliding <= slip.pivoting) return {resistance, curvature, curvature * (slip.sliding / slip.pivoting)};
  return {resistance, curvature * (slip.pivoting / slip.sliding), curvature};
}

std::function<Tangent(Slip)> tangent_of(const Law& law) {
  const auto closed = [](const auto& of_type) { return [of_type](Slip slip) { return tangent(of_type, slip); }; };
  if (const auto* hertz = law.as<HertzLaw>()) return closed(*hertz);
  if (const auto* elliptic = law.as<EllipticLaw>()) return closed(*elliptic);
  return [law](Slip slip) { return by_differences(law, slip); };
}

double tangent_error(const Law& law) {
  return law.as<HertzLaw>() != nullptr || law.as<EllipticLaw>() != nullptr ? 0 : 1e-9;
}

}  // namespace contensou::reduction
