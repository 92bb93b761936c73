#include "route_curve.hpp"

#include "contensou/reduction/quadrature_curve.hpp"

namespace contensou::program {

std::shared_ptr<const reduction::SimilarityCurve> route_curve(const reduction::ReducedSystem& system,
                                                              reduction::Route route) {
  if (route == reduction::Route::closed) return system.law().closed_curve(system.r());
  if (route == reduction::Route::quadrature) {
    return std::make_shared<reduction::QuadratureCurve>(system.law(), system.r());
  }
  return nullptr;
}

}  // namespace contensou::program
