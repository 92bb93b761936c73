#include "contensou/reduction/pade_law.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include "contensou/reduction/pade_curve.hpp"
#include "contensou/reduction/pade_stop_time.hpp"
#include "numerics/dilogarithm.hpp"

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

double PadeLaw::small_mu_share(int order, double r, double ln_k) const {
  // z = B k/A of (R8); order 1 is the limit r -> 0.
  const double r_kept = order == 1 ? 0 : r;
  const double ln_z = ln_k + std::log(3 * pi * (5 - r_kept) / (8 * (2 - r_kept)));
  const double z = std::exp(ln_z);
  if (z == 0) return 2.5;
  const double log_1p = ln_z > 0 ? ln_z + std::log1p(1 / z) : std::log1p(z);
  const double bracket = log_1p + r_kept / 2 * dilogarithm_of_minus_exp(ln_z) + 3 * r_kept / 20 * log_1p * log_1p;
  return 1 + 1.5 * (2 / (2 - r_kept)) * bracket / z;
}

SimilaritySolution PadeLaw::closed_solution(double r) const {
  if (r > PadeCurve::largest_r) return {};
  return std::make_shared<PadeCurve>(r);
}

double PadeLaw::closed_stop_time(double mu, const State& start, const Inertia& inertia) const {
  return pade_stop_time(mu, start, inertia);
}

}  // namespace contensou::reduction
