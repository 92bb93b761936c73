#include "contensou/reduction/similarity_solution.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/pade_curve.hpp"
#include "contensou/reduction/pade_law.hpp"
#include "contensou/reduction/quadrature_curve.hpp"
#include "contensou/reduction/terminal_ratio.hpp"

namespace contensou::reduction {

const SimilaritySolution::Curve& SimilaritySolution::through(double ln_k) const {
  for (const Curve* curve : {&above_, &below_}) {
    if (*curve && (*curve)->approach().reaches(ln_k)) return *curve;
  }
  throw std::domain_error(fmt::format("SimilaritySolution: no curve through ln k = {}", ln_k));
}

SimilaritySolution quadrature_solution(const Law& law, double r) {
  using Side = Approach::Side;
  const TerminalRatio terminal = terminal_ratio(law, r);
  const auto curve = [&](Side side, double k) {
    return std::make_shared<QuadratureCurve>(law, r, Approach(side, std::log(k)));
  };
  // Nearer to an edge of the ray's domain, rounding decides which way k goes beyond the ray, and how slowly: as good as
  // not at all. The ray itself is then as good as the axis.
  constexpr double told_apart = 1e-12;
  if (r <= terminal.low * (1 + told_apart)) return curve(Side::above, 0);
  if (r >= terminal.high * (1 - told_apart)) return curve(Side::below, std::numeric_limits<double>::infinity());
  return {curve(Side::above, terminal.k), curve(Side::below, terminal.k)};
}

SimilaritySolution closed_solution(const Law& law, double r) {
  if (law.as<PadeLaw>() && r <= PadeCurve::largest_r) return std::make_shared<PadeCurve>(r);
  return {};
}

SimilaritySolution similarity_solution(const Law& law, double r) {
  if (auto closed = closed_solution(law, r)) return closed;
  return quadrature_solution(law, r);
}

}  // namespace contensou::reduction
