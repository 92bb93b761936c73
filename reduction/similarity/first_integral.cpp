#include "contensou/reduction/first_integral.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace contensou::reduction {

double log_first_integral(const ReducedSystem& system, const SimilaritySolution& solution, State state) {
  require_state("log_first_integral", state);
  if (state.u == 0 || state.v == 0) {
    throw std::domain_error(
        fmt::format("log_first_integral: it has no value on the axes, got u = {}, v = {}", state.u, state.v));
  }
  const double ln_u = std::log(std::abs(state.u));
  const double ln_k = std::log(state.v) - std::log(system.mu()) - ln_u;
  const SimilarityCurve& curve = *solution.through(ln_k);
  return ln_u - curve.log_rim(curve.approach().coordinate(ln_k));
}

}  // namespace contensou::reduction
