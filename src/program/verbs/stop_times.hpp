#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "contensou/reduction/flow.hpp"
#include "contensou/reduction/stop_times_of_mu.hpp"
#include "contensou/si/experiment.hpp"
#include "options/route_option.hpp"

namespace contensou::program {

/// Stop times of many starts of one body under one law, and one drive. What depends on mu alone is computed once for each mu, by the
/// first thread that needs it, and kept for as many of them as take a bounded memory. Threads may share it.
class StopTimes {
 public:
  /// The stop times of one mu. Threads may share it.
  struct AtMu {
    std::optional<reduction::Flow> flow;
    std::function<double(reduction::State)> one;  ///< start by start, where there is no flow; throws as stop_time
    std::size_t starts = 0;                       ///< how many there are in all

    double operator()(reduction::State start) const { return flow ? flow->stop_time(start).tau : one(start); }

    /// The stop times of (u0[i], v0).
    /// @param taus  as many as u0
    void row(std::span<const double> u0, double v0, std::span<double> taus) const;
  };

  /// By a route.
  StopTimes(const reduction::Law& law, reduction::Inertia body, double drive, const RouteOption& route)
      : law_(law), body_(body), drive_(drive), route_(route) {}

  /// By the best route, for so many starts of each mu and so many mu.
  StopTimes(const reduction::Law& law, reduction::Inertia body, double drive, long starts, long mus);

  /// From here on those of a ball with rolling friction, which are not of one orbit: each start by itself.
  /// @throws BadInput  if a route was asked for
  void resist(const si::Experiment& ball);

  /// @throws  as RouteOption::read and the making of the solution
  std::shared_ptr<const AtMu> at(double mu);

  /// By what serves every mu, where there is no drive, no route was asked for and so many rows have been before: they may each have a mu of
  /// their own, and a curve would be made for each.
  /// @param row  how many were before this one; what they were does not matter to the bits of the answer
  /// @throws     as at and stop_time
  double operator()(double mu, reduction::State start, long row);

 private:
  AtMu made(double mu);
  const reduction::StopTimesOfMu& of_every_mu();

  reduction::Law law_;
  reduction::Inertia body_;
  double drive_;
  RouteOption route_;
  std::optional<si::Experiment> resisted_;
  std::size_t starts_ = 0;  ///< of each mu of a grid
  bool many_mus_ = false;
  std::once_flag of_every_mu_made_;
  std::optional<reduction::StopTimesOfMu> of_every_mu_;
  std::atomic<bool> told_ = false;  ///< that some starts are slow
  std::mutex guard_;
  std::map<double, std::shared_future<std::shared_ptr<const AtMu>>> known_;
};

/// Says on standard error if Flow::stop_times computes some of so many starts one by one.
void tell_if_refused(const reduction::Flow& flow, std::size_t starts);

}  // namespace contensou::program
