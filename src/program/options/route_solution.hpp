#pragma once

#include "contensou/reduction/reduced_system.hpp"
#include "contensou/reduction/similarity_solution.hpp"
#include "contensou/reduction/stop_time.hpp"

namespace contensou::program {

/// The similarity solution that a route computes orbits from; empty for the steppers, which need none.
reduction::SimilaritySolution route_solution(const reduction::ReducedSystem& system, reduction::Route route);

}  // namespace contensou::program
