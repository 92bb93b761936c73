#pragma once

#include <memory>

#include "contensou/reduction/reduced_system.hpp"
#include "contensou/reduction/similarity_curve.hpp"
#include "contensou/reduction/stop_time.hpp"

namespace contensou::program {

/// The similarity curve that a route computes orbits from; null for the steppers, which need none.
std::shared_ptr<const reduction::SimilarityCurve> route_curve(const reduction::ReducedSystem& system,
                                                              reduction::Route route);

}  // namespace contensou::program
