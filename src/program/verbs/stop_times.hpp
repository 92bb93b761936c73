#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "contensou/reduction/similarity_solution.hpp"
#include "contensou/reduction/stop_time.hpp"
#include "options/route_option.hpp"

namespace contensou::program {

/// Stop times of many starts that share law and mu. Threads may share it.
class PatchStopTimes {
 public:
  /// @throws  as RouteOption::read and the making of the solution
  PatchStopTimes(const reduction::ReducedSystem& system, const RouteOption& route);

  double mu() const { return system_.mu(); }

  /// @throws  as reduction::stop_time
  double operator()(reduction::State start) const;

 private:
  reduction::ReducedSystem system_;
  reduction::Route route_;
  reduction::SimilaritySolution solution_;  ///< empty where each start is by itself
};

/// Stop times of many starts of one body under one law. What depends on mu alone is computed once for each mu, and kept
/// for as many of them as take a bounded memory. Threads may share it.
class StopTimes {
 public:
  StopTimes(reduction::Law law, reduction::Inertia body, const RouteOption& route)
      : law_(std::move(law)), body_(body), route_(route) {}

  /// @throws  as PatchStopTimes
  std::shared_ptr<const PatchStopTimes> of_patch(double mu);

 private:
  reduction::Law law_;
  reduction::Inertia body_;
  const RouteOption& route_;
  std::mutex guard_;
  std::map<double, std::shared_ptr<const PatchStopTimes>> patches_;
};

}  // namespace contensou::program
