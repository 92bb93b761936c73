#include "verbs/stop_times.hpp"

#include "contensou/reduction/orbit.hpp"
#include "options/route_solution.hpp"

namespace contensou::program {

namespace {

/// A curve by quadrature takes some 300 kB. A table in which each row has its own mu gains nothing.
constexpr std::size_t most_patches = 256;

}  // namespace

PatchStopTimes::PatchStopTimes(const reduction::ReducedSystem& system, const RouteOption& route)
    : system_(system), route_(route.read(system_)) {
  if (route_ != reduction::Route::closed) solution_ = route_solution(system_, route_);
}

double PatchStopTimes::operator()(reduction::State start) const {
  if (!solution_) return reduction::stop_time(system_, start, route_).tau;
  return reduction::Orbit(system_, start, solution_).stop_time();
}

std::shared_ptr<const PatchStopTimes> StopTimes::of_patch(double mu) {
  {
    const std::lock_guard lock(guard_);
    if (const auto known = patches_.find(mu); known != patches_.end()) return known->second;
  }
  // Not under the lock: two threads that meet a new mu at once both make it, and the same.
  const auto patch = std::make_shared<const PatchStopTimes>(reduction::ReducedSystem(law_, mu, body_), route_);
  const std::lock_guard lock(guard_);
  if (patches_.size() == most_patches) patches_.clear();
  return patches_.emplace(mu, patch).first->second;
}

}  // namespace contensou::program
