#include "contensou/reduction/detail/similarity_solution.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "contensou/reduction/detail/infinity.hpp"
#include "contensou/reduction/laws.hpp"
#include "similarity/curves.hpp"
#include "similarity/regular_solution.hpp"

namespace contensou::reduction {

namespace {

/// Returns ln(1 - exp(-x)), x > 0.
double log_one_minus_exp(double x) { return x < 1 ? std::log(-std::expm1(-x)) : std::log1p(-std::exp(-x)); }

}  // namespace

TerminalChart::TerminalChart(double sign, double end, double far) : sign_(sign), end_(end), far_(far) {
  if (!(end < far)) {
    throw std::domain_error(fmt::format(
        "TerminalChart: there is nothing {} a terminal ratio with ln k* = {} on the way from one with ln k = {}",
        sign > 0 ? "above" : "below", sign * end, sign * far));
  }
}

TerminalChart::TerminalChart(Side side, double ln_k_star)
    : TerminalChart(side == Side::above ? 1 : -1, side == Side::above ? ln_k_star : -ln_k_star, infinity) {}

TerminalChart TerminalChart::between(double ln_k_star, double ln_k_far) {
  const double sign = ln_k_far < ln_k_star ? -1 : 1;
  return {sign, sign * ln_k_star, sign * ln_k_far};
}

TerminalChart TerminalChart::to_zero() { return {Side::above, -infinity}; }

double TerminalChart::coordinate(double ln_k) const {
  const double y = sign_ * ln_k;
  if (!(y > end_)) return end_ == -infinity ? y : end_ + min_coordinate;
  if (!(y < far_)) return far_ == infinity ? y : far_ - min_coordinate;
  const double near_end = end_ == -infinity ? 0 : log_one_minus_exp(y - end_);
  const double near_far = far_ == infinity ? 0 : log_one_minus_exp(far_ - y);
  return y + near_end - near_far;
}

double TerminalChart::log_ratio(double xi) const {
  const double from_end = std::log1p(std::exp(xi > end_ ? end_ - xi : xi - end_));
  if (xi > far_) return sign_ * (far_ + from_end - std::log1p(std::exp(far_ - xi)));
  const double from_far = far_ == infinity ? 0 : std::log1p(std::exp(xi - far_));
  return sign_ * (std::max(xi, end_) + from_end - from_far);
}

double TerminalChart::log_ratio_rate(double xi) const {
  // For a chart from above the rate is (1 - k*/k) (1 - k/k_far)/(1 - k*/k_far).
  const double from_end = 1 / (1 + std::exp(end_ - xi));
  if (far_ == infinity) return sign_ * from_end;
  return sign_ * from_end * (-std::expm1(end_ - far_) / (1 + std::exp(xi - far_)));
}

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
