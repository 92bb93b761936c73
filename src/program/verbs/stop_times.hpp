#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "contensou/reduction/detail/stop_times_of_mu.hpp"
#include "contensou/reduction/flow.hpp"
#include "contensou/si/experiment.hpp"
#include "options/route_option.hpp"

namespace contensou::program {

/// Stop times of many starts of one body under one law and one drive. The first thread that needs a mu computes the
/// solution for this mu. Solutions are kept for a limited number of mu. Threads may share the object.
class StopTimes {
 public:
  /// The stop times of one mu. Threads may share the object.
  struct AtMu {
    std::optional<reduction::Flow> flow;
    std::function<double(reduction::State)> one;  ///< computes a single start without a Flow; throws as stop_time
    std::size_t starts = 0;                       ///< number of all starts with this mu

    double operator()(reduction::State start) const { return flow ? flow->stop_time(start).tau : one(start); }

    /// Computes the stop times of (u0[i], v0).
    /// @param taus  receives the stop times; as long as u0
    void row(std::span<const double> u0, double v0, std::span<double> taus) const;
  };

  /// Prepares stop times by a route.
  StopTimes(const reduction::Law& law, reduction::Inertia body, double drive, const RouteOption& route)
      : law_(law), body_(body), drive_(drive), route_(route) {}

  /// Prepares stop times by the best route, for `mus` values of mu with `starts` starts each.
  StopTimes(const reduction::Law& law, reduction::Inertia body, double drive, long starts, long mus);

  /// Switches to a ball with rolling friction. Its motions consist of several orbits, so each start is computed alone.
  /// @throws BadInput  if a route was given
  void resist(const si::Experiment& ball);

  /// Returns the stop times of one mu.
  /// @throws  as RouteOption::read and the computation of the solution
  std::shared_ptr<const AtMu> at(double mu);

  /// Returns the stop time of one row of a table, whose rows may all have different mu. After many rows, a solution for
  /// every mu replaces the curves of single mu, unless a route is given.
  /// @param row  number of rows before this one; the bits of the result depend on this number, not on those rows
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
  std::size_t starts_ = 0;  ///< number of starts for each mu of a grid
  bool many_mus_ = false;
  std::optional<reduction::StopTimesOfMu> of_every_mu_;
  std::atomic<bool> told_ = false;  ///< true if the message on slow starts was printed
  std::mutex guard_;
  std::map<double, std::shared_future<std::shared_ptr<const AtMu>>> known_;
};

/// Prints a message on standard error if Flow::stop_times must compute some of these starts one by one.
void tell_if_refused(const reduction::Flow& flow, std::size_t starts);

}  // namespace contensou::program
