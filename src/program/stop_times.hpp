#pragma once

#include <map>

#include "contensou/reduction/stop_time.hpp"
#include "route_option.hpp"

namespace contensou::program {

/// Stop times of many starts under one law. What depends on mu alone is computed once for each mu.
class StopTimes {
 public:
  StopTimes(reduction::Law law, const RouteOption& route) : law_(std::move(law)), route_(route) {}

  /// @throws  as RouteOption::read and reduction::stop_time
  double operator()(double mu, reduction::State start);

 private:
  struct OfPatch {
    reduction::ReducedSystem system;
    reduction::Route route;
    std::shared_ptr<const reduction::SimilarityCurve> curve;  ///< null for the steppers
  };

  const OfPatch& of_patch(double mu);

  reduction::Law law_;
  const RouteOption& route_;
  std::map<double, OfPatch> patches_;
};

}  // namespace contensou::program
