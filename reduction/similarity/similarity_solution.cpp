#include "contensou/reduction/detail/similarity_solution.hpp"

#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/detail/pade_curve.hpp"
#include "contensou/reduction/detail/quadrature_curve.hpp"
#include "contensou/reduction/laws.hpp"
#include "similarity/regular_solution.hpp"

namespace contensou::reduction {

const SimilaritySolution::Curve& SimilaritySolution::through(double ln_k) const {
  for (const Curve& curve : curves_) {
    if (curve->chart().reaches(ln_k)) return curve;
  }
  throw std::domain_error(fmt::format("SimilaritySolution: no curve through ln k = {}", ln_k));
}

SimilaritySolution quadrature_solution(const Law& law, double r, const TerminalRatios& ratios, double drive) {
  std::vector<SimilaritySolution::Curve> curves;
  for (const TerminalChart& chart : charts_of(ratios)) {
    try {
      curves.push_back(std::make_shared<QuadratureCurve>(law, r, chart, drive));
    } catch (const std::domain_error& unexpected) {
      // Phi/(k Psi) changes too fast for terminal_ratios. This is no error of the caller.
      throw std::runtime_error(unexpected.what());
    }
  }
  return SimilaritySolution(std::move(curves));
}

SimilaritySolution closed_solution(const Law& law, double r, double drive) {
  if (drive == 0 && law.as<PadeLaw>() && r <= PadeCurve::max_r) return std::make_shared<PadeCurve>(r);
  return {};
}

}  // namespace contensou::reduction
