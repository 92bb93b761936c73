#include "options/route_solution.hpp"

namespace contensou::program {

reduction::SimilaritySolution route_solution(const reduction::ReducedSystem& system, reduction::Route route) {
  // A law may have its stop time in closed form where its orbits are quadratures.
  if (route == reduction::Route::closed) return similarity_solution(system.law(), system.r());
  if (route == reduction::Route::quadrature) return reduction::quadrature_solution(system.law(), system.r());
  return {};
}

}  // namespace contensou::program
