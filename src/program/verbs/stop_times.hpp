#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "contensou/reduction/stop_time_table.hpp"
#include "contensou/reduction/stop_times_of_mu.hpp"
#include "options/route_option.hpp"

namespace contensou::program {

/// Stop times of many starts of one body under one law. What depends on mu alone is computed once for each mu, by the
/// first thread that needs it, and kept for as many of them as take a bounded memory. Threads may share it.
class StopTimes {
 public:
  /// Those of one mu. Threads may share it.
  struct AtMu {
    std::optional<reduction::StopTimeTable> table;
    std::function<double(reduction::State)> one;  ///< start by start, where there is no table; throws as stop_time

    /// The stop times of (u0[i], v0).
    /// @param taus  as many as u0
    void row(std::span<const double> u0, double v0, std::span<double> taus) const;
  };

  /// By a route.
  StopTimes(const reduction::Law& law, reduction::Inertia body, const RouteOption& route)
      : law_(law), body_(body), route_(route) {}

  /// By the best route, for so many starts of each mu and so many mu: by a table where they pay for it.
  StopTimes(const reduction::Law& law, reduction::Inertia body, long starts, long mus);

  /// @throws  as RouteOption::read and the making of the solution
  std::shared_ptr<const AtMu> at(double mu);

  /// By what serves every mu, where no route was asked for and so many rows have been before: they may each have a mu of
  /// their own, and a curve would be made for each.
  /// @param row  how many were before this one; what they were does not matter to the bits of the answer
  /// @throws     as at and stop_time
  double operator()(double mu, reduction::State start, long row);

 private:
  AtMu made(double mu);
  const reduction::StopTimesOfMu& of_every_mu();

  reduction::Law law_;
  reduction::Inertia body_;
  RouteOption route_;
  bool by_table_ = false;
  bool many_mus_ = false;
  std::once_flag of_every_mu_made_;
  std::optional<reduction::StopTimesOfMu> of_every_mu_;
  std::atomic<bool> told_ = false;  ///< that a table is not whole
  std::mutex guard_;
  std::map<double, std::shared_future<std::shared_ptr<const AtMu>>> known_;
};

/// Says on standard error if some starts are computed one by one because the table's panels there fail their proof.
void tell_if_not_proved(const reduction::StopTimeTable& table);

}  // namespace contensou::program
