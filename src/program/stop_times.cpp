#include "stop_times.hpp"

#include "contensou/reduction/orbit.hpp"
#include "route_curve.hpp"

namespace contensou::program {

namespace {

/// More different mu than this are not remembered: a table in which each row has its own gains nothing.
constexpr std::size_t most_patches = 1000;

}  // namespace

double StopTimes::operator()(double mu, reduction::State start) {
  const OfPatch& patch = of_patch(mu);
  if (!patch.curve) return reduction::stop_time(patch.system, start, patch.route).tau;
  return reduction::Orbit(patch.system, start, patch.curve).stop_time();
}

const StopTimes::OfPatch& StopTimes::of_patch(double mu) {
  if (const auto known = patches_.find(mu); known != patches_.end()) return known->second;
  const reduction::ReducedSystem system(law_, mu);
  const reduction::Route route = route_.read(system);
  if (patches_.size() == most_patches) patches_.clear();
  return patches_.emplace(mu, OfPatch{system, route, route_curve(system, route)}).first->second;
}

}  // namespace contensou::program
