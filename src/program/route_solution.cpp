#include "route_solution.hpp"

namespace contensou::program {

reduction::SimilaritySolution route_solution(const reduction::ReducedSystem& system, reduction::Route route) {
  if (route == reduction::Route::closed) return system.law().closed_solution(system.r());
  if (route == reduction::Route::quadrature) return reduction::quadrature_solution(system.law(), system.r());
  return {};
}

}  // namespace contensou::program
